//! Several pictures in one OpenEXR file.

use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, Vec2, WritableImage,
};

use crate::exr_file::layer_attributes;
use crate::file::write_atomically;
use crate::{Error, RadianceImage};

/// Writes pictures of one size as layers: channels `NAME.R`, `NAME.G`, `NAME.B` of one part, which is
/// how tev, Blender and Nuke know layers. 32-bit floats, losslessly compressed, with text attributes as
/// those of [`RadianceImage::write_exr`]. The file appears complete or not at all.
///
/// # Errors
/// One line where there is no picture, sizes differ, the file cannot be written or the name of an
/// attribute is not OpenEXR's.
pub fn write_exr_layers(
    path: &Path,
    layers: &[(&str, &RadianceImage)],
    attributes: &[(String, String)],
) -> Result<(), Error> {
    let Some((_, first)) = layers.first() else {
        return Err(Error::write(path, "there is no layer"));
    };
    for (name, image) in layers {
        image.check_shape()?;
        if (image.width, image.height) != (first.width, first.height) {
            return Err(Error::write(path, format!("layer {name} differs in size")));
        }
    }
    let channels = layers.iter().flat_map(|(name, image)| {
        ["R", "G", "B"].into_iter().enumerate().map(move |(component, letter)| {
            let samples = image.pixels.iter().map(|pixel| pixel[component]).collect();
            AnyChannel::new(format!("{name}.{letter}").as_str(), FlatSamples::F32(samples))
        })
    });
    let layer = Layer::new(
        Vec2(first.width as usize, first.height as usize),
        layer_attributes(path, attributes)?,
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(channels.collect()),
    );
    write_atomically(path, |writer| {
        Image::from_layer(layer).write().to_buffered(writer).map_err(|error| error.to_string())
    })
}
