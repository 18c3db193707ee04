//! Pictures as OpenEXR.

use std::fs::File;
use std::io::BufReader;
use std::panic::catch_unwind;
use std::path::Path;

use exr::block::reader::Reader;
use exr::meta::BlockDescription;
use exr::meta::attribute::Text;
use exr::meta::header::Header;
use exr::prelude::{
    AttributeValue, Compression, Encoding, Image, Layer, LayerAttributes, ReadChannels, ReadLayers,
    ReadSpecificChannel, SpecificChannels, Vec2, WritableImage,
};

use crate::exr_window::check_colors;
use crate::file::write_atomically;
use crate::{Error, RadianceImage, Window};

/// 8192 × 8192: 805 MB. A header can claim 2⁶⁰.
const MAX_PIXELS: usize = 1 << 26;
/// Bytes of one block of scan lines or one tile, all channels: 4096 × 4096 pixels of four floats.
const MAX_BLOCK_BYTES: usize = 1 << 28;
/// Bytes of picture for a byte of file. Deflate, the strongest, gives 1032; this leaves room.
const MAX_COMPRESSION: u64 = 2048;

impl RadianceImage {
    /// Reads the channels `R`, `G` and `B` (half, float or unsigned integer) of the first layer that
    /// has them, at full resolution; other channels and layers are skipped, as is the position of
    /// the data window (not so by [`read_exr_pair`]). A pixel that a damaged file never sets is NaN.
    ///
    /// The size that the header claims is checked against the length of the file before anything is
    /// allocated.
    ///
    /// # Errors
    /// One line where the file cannot be read, is damaged, has no such layer, is deep, subsampled or
    /// DWA-compressed, has more than 2²⁶ pixels, or says that its primaries are not those of Rec. 709.
    pub fn read_exr(path: &Path) -> Result<Self, Error> {
        read(path).map(|(image, _)| image)
    }

    /// Writes 32-bit floats, losslessly compressed, with each `(name, text)` of `attributes` as a
    /// text attribute of the layer (UTF-8). The file appears complete or not at all.
    ///
    /// # Errors
    /// One line where the file cannot be written, or where the name of an attribute is empty, longer
    /// than 255 bytes or taken by OpenEXR.
    pub fn write_exr(&self, path: &Path, attributes: &[(String, String)]) -> Result<(), Error> {
        self.check_shape()?;
        let layer_attributes = layer_attributes(path, attributes)?;
        let size = Vec2(self.width as usize, self.height as usize);
        let channels = SpecificChannels::rgb(|Vec2(x, y)| {
            let [r, g, b] = self.pixels[y * size.width() + x];
            (r, g, b)
        });
        let layer = Layer::new(size, layer_attributes, Encoding::SMALL_LOSSLESS, channels);
        write_atomically(path, |writer| {
            Image::from_layer(layer).write().to_buffered(writer).map_err(|error| error.to_string())
        })
    }
}

/// Reads a picture and what it is to be compared with, as [`RadianceImage::read_exr`] does.
///
/// # Errors
/// Also where both have one size but lie in different places of their frames, or in different frames.
/// (Pictures of different sizes are read: comparing them is refused.)
pub fn read_exr_pair(image: &Path, reference: &Path) -> Result<[RadianceImage; 2], Error> {
    let [(image, at), (reference, reference_at)] = [read(image)?, read(reference)?];
    let same_size = (image.width, image.height) == (reference.width, reference.height);
    if same_size && at != reference_at {
        return Err(Error::Windows { image: at, reference: reference_at });
    }
    Ok([image, reference])
}

fn read(path: &Path) -> Result<(RadianceImage, Window), Error> {
    let read = || -> exr::error::Result<_> {
        let file = File::open(path)?;
        let length = file.metadata()?.len();
        let chunks = exr::block::read(BufReader::new(file), false)?;
        let header = shown(chunks.headers())?;
        check_colors(header)?;
        let window = Window::of(header);
        chunks.headers().iter().try_for_each(|header| check_size(header, length))?;
        Ok((decode(chunks)?, window))
    };
    // exr 1.74 panics on some damaged files, such as a short block of B44.
    match catch_unwind(read) {
        Ok(result) => result.map_err(|error| Error::read(path, error)),
        Err(_) => Err(Error::read(path, "the file is damaged")),
    }
}

/// The attributes of a layer, all of them text.
pub(crate) fn layer_attributes(
    path: &Path,
    attributes: &[(String, String)],
) -> Result<LayerAttributes, Error> {
    let mut layer_attributes = LayerAttributes::default();
    for (name, value) in attributes {
        if name.contains('\0') {
            return Err(Error::write(path, format!("attribute name {name:?} holds a NUL")));
        }
        let value = AttributeValue::Text(Text::from_slice_unchecked(value.as_bytes()));
        layer_attributes.other.insert(Text::from_slice_unchecked(name.as_bytes()), value);
    }
    Ok(layer_attributes)
}

/// The header of the layer that [`decode`] reads: the first with the channels of a picture.
fn shown(headers: &[Header]) -> exr::error::Result<&Header> {
    let has =
        |header: &Header, name: &str| header.channels.find_index_of_channel(&name.into()).is_some();
    let shows = |header: &&Header| ["R", "G", "B"].iter().all(|name| has(header, name));
    let missing = || exr::error::Error::Invalid("no layer has the channels R, G and B".into());
    headers.iter().find(shows).ok_or_else(missing)
}

/// Refuses a layer that is larger than its file of `length` bytes could fill, or than we allow.
fn check_size(header: &Header, length: u64) -> exr::error::Result<()> {
    let refuse = |reason: String| Err(exr::error::Error::Invalid(reason.into()));
    // The decoder of exr 1.74 allocates what such a block claims to need.
    if matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_)) {
        return refuse("DWA compression is not read: save it without loss (ZIP, PIZ)".into());
    }
    let Vec2(width, height) = header.layer_size;
    let pixels = width.checked_mul(height).filter(|&pixels| (1..=MAX_PIXELS).contains(&pixels));
    let Some(pixels) = pixels else {
        return refuse(format!("{width}×{height} pixels: at most {MAX_PIXELS} are read"));
    };
    let Vec2(block_width, block_height) = match header.blocks {
        BlockDescription::ScanLines => Vec2(width, header.compression.scan_lines_per_block()),
        BlockDescription::Tiles(tiles) => tiles.tile_size,
    };
    let bytes = |pixels: usize| pixels.checked_mul(header.channels.bytes_per_pixel);
    let block = block_width.checked_mul(block_height).and_then(bytes);
    if block.is_none_or(|bytes| bytes > MAX_BLOCK_BYTES) {
        return refuse(format!("blocks of {block_width}×{block_height} pixels are too large"));
    }
    let most = length.saturating_mul(MAX_COMPRESSION);
    if bytes(pixels).is_none_or(|bytes| bytes as u64 > most) {
        return refuse(format!("{width}×{height} pixels cannot be in a file of {length} bytes"));
    }
    Ok(())
}

fn decode(chunks: Reader<BufReader<File>>) -> exr::error::Result<RadianceImage> {
    let layers = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required("R")
        .required("G")
        .required("B")
        .collect_pixels(
            |Vec2(width, height), _| RadianceImage {
                width: width as u32,
                height: height as u32,
                pixels: vec![[f32::NAN; 3]; width * height],
            },
            |image: &mut RadianceImage, Vec2(x, y), (r, g, b): (f32, f32, f32)| {
                image.pixels[y * image.width as usize + x] = [r, g, b];
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel(); // a panic in one of its threads would end the process
    Ok(layers.from_chunks(chunks)?.layer_data.channel_data.pixels)
}
