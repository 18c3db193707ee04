//! PNG and JPEG files, which nobody vouches for.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use image::error::{ImageError, LimitErrorKind};
use image::{ImageReader, Limits};

use crate::{LoadError, Texture};

/// Largest width and height.
const MAX_SIDE: u32 = 16_384;
/// Most bytes that a file may have and that decoding may take: refused before any allocation.
pub(crate) const MAX_BYTES: u64 = 1 << 30;

/// The texels of a PNG or JPEG file.
///
/// # Errors
/// One line with the file: it cannot be read, or [`decode`] refuses it.
pub(crate) fn load(path: &Path) -> Result<Texture, LoadError> {
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(MAX_BYTES).read_to_end(&mut bytes))
        .map_err(|error| LoadError::new(path.display(), error, "check the path"))?;
    decode(&bytes).map_err(|error| error.within(path.display()))
}

/// The texels of a PNG or JPEG file with these bytes.
///
/// # Errors
/// Images that are malformed, of another format or too large.
pub(crate) fn decode(bytes: &[u8]) -> Result<Texture, LoadError> {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_BYTES);
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(broken)?;
    reader.limits(limits);
    let image = reader.decode().map_err(refuse)?.to_rgba8();
    let (width, height) = image.dimensions();
    let texels = image.pixels().map(|pixel| pixel.0).collect();
    Ok(Texture { width, height, texels })
}

fn broken(error: impl std::fmt::Display) -> LoadError {
    LoadError::new("data", error, "repair the file or export it again")
}

fn refuse(error: ImageError) -> LoadError {
    let limit = format!("make it at most {MAX_SIDE} texels wide and high");
    match &error {
        ImageError::Limits(limits) if limits.kind() == LimitErrorKind::DimensionError => {
            LoadError::new("data", "is too large an image", limit)
        }
        ImageError::Limits(_) => LoadError::new("data", "takes too much memory", limit),
        ImageError::Unsupported(_) => LoadError::new("data", &error, "convert it to PNG or JPEG"),
        _ => broken(&error),
    }
}
