//! Images: PNG and JPEG, decoded when the first material uses them.

use std::collections::HashMap;
use std::io::Cursor;

use ::gltf as gltf_crate;
use glam::{DVec3, U8Vec3, Vec3};
use gltf_crate::texture::{MagFilter, MinFilter, Sampler, WrappingMode};
use image::error::{ImageError, LimitErrorKind};
use image::{ImageReader, Limits};

use super::buffers;
use super::fault::broken;
use super::notes::Notes;
use super::source::Source;
use crate::{LoadError, Scene, Texture};

/// Largest width and height, and most bytes that decoding may take: refused before any allocation.
const MAX_SIDE: u32 = 16_384;
const MAX_BYTES: u64 = 1 << 30;

/// Images of the file that are in the scene already.
#[derive(Default)]
pub(super) struct Textures {
    indices: HashMap<usize, u32>,
}

impl Textures {
    /// The index of a texture's image in the scene; `None` where the file has it only in the format
    /// of an extension.
    ///
    /// # Errors
    /// Images that are missing, malformed or too large.
    pub(super) fn index(
        &mut self,
        texture: &gltf_crate::Texture,
        source: Source,
        scene: &mut Scene,
        notes: &mut Notes,
    ) -> Result<Option<u32>, LoadError> {
        let Some(image) = image_of(texture, source, notes) else { return Ok(None) };
        let sampler = texture.sampler();
        let repeats = [sampler.wrap_s(), sampler.wrap_t()] == [WrappingMode::Repeat; 2];
        notes.count("textures repeated against their sampler", u64::from(!repeats));
        notes.count(
            "textures filtered bilinearly against their sampler",
            is_nearest(&sampler).into(),
        );
        if let Some(&index) = self.indices.get(&image) {
            return Ok(Some(index));
        }
        let index = scene.textures.len() as u32;
        scene.textures.push(decode(image, source)?);
        self.indices.insert(image, index);
        Ok(Some(index))
    }
}

/// Whether a texel is to be seen as a square, near or far. That there are no mip levels is what the
/// specification allows.
fn is_nearest(sampler: &Sampler) -> bool {
    use MinFilter::{Nearest, NearestMipmapLinear, NearestMipmapNearest};
    sampler.mag_filter() == Some(MagFilter::Nearest)
        || matches!(
            sampler.min_filter(),
            Some(Nearest | NearestMipmapNearest | NearestMipmapLinear)
        )
}

/// The mean of a texture's channels, in [0, 1], without a transfer function; white where the file has
/// it only in the format of an extension.
///
/// # Errors
/// Images that are missing, malformed or too large.
pub(super) fn mean(
    texture: &gltf_crate::Texture,
    source: Source,
    notes: &mut Notes,
) -> Result<Vec3, LoadError> {
    let Some(image) = image_of(texture, source, notes) else { return Ok(Vec3::ONE) };
    let texels = decode(image, source)?.texels;
    let sum: DVec3 = texels.iter().map(|&[r, g, b, _]| U8Vec3::new(r, g, b).as_dvec3()).sum();
    Ok((sum / (255.0 * texels.len() as f64)).as_vec3())
}

/// The index of a texture's image.
fn image_of(texture: &gltf_crate::Texture, source: Source, notes: &mut Notes) -> Option<usize> {
    let root = source.document.as_json();
    let image = root.textures[texture.index()].source.value();
    if image < root.images.len() {
        return Some(image);
    }
    notes.count("textures without a PNG or JPEG image, left out", 1);
    None
}

fn decode(image: usize, source: Source) -> Result<Texture, LoadError> {
    read(image, source)
        .and_then(|bytes| decode_bytes(&bytes))
        .map_err(|error| error.within(format!("images[{image}]")))
}

fn read(image: usize, source: Source) -> Result<Vec<u8>, LoadError> {
    let root = source.document.as_json();
    let image = &root.images[image];
    match (image.buffer_view, &image.uri) {
        (Some(view), _) => {
            // Its range has been checked against the buffer.
            let view = &root.buffer_views[view.value()];
            let start = view.byte_offset.map_or(0, |offset| offset.0) as usize;
            let bytes = &source.buffers.get(view.buffer.value())[start..];
            Ok(bytes[..view.byte_length.0 as usize].to_vec())
        }
        (None, Some(uri)) => buffers::resolve(uri, source.folder, MAX_BYTES),
        (None, None) => Err(broken("uri", "is missing, and there is no buffer view")),
    }
}

fn decode_bytes(bytes: &[u8]) -> Result<Texture, LoadError> {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_BYTES);
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| broken("data", error))?;
    reader.limits(limits);
    let image = reader.decode().map_err(refuse)?.to_rgba8();
    let (width, height) = image.dimensions();
    let texels = image.pixels().map(|pixel| pixel.0).collect();
    Ok(Texture { width, height, texels })
}

fn refuse(error: ImageError) -> LoadError {
    let limit = format!("make it at most {MAX_SIDE} texels wide and high");
    match &error {
        ImageError::Limits(limits) if limits.kind() == LimitErrorKind::DimensionError => {
            LoadError::new("data", "is too large an image", limit)
        }
        ImageError::Limits(_) => LoadError::new("data", "takes too much memory", limit),
        ImageError::Unsupported(_) => LoadError::new("data", &error, "convert it to PNG or JPEG"),
        _ => broken("data", &error),
    }
}
