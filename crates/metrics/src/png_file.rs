//! Pictures as 8-bit PNG, for people.

use std::io::Write;
use std::path::Path;

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use crate::file::write_atomically;
use crate::image::is_finite;
use crate::{Error, RadianceImage};

/// No renderer makes this colour by chance.
const MAGENTA: [u8; 3] = [255, 0, 255];

impl RadianceImage {
    /// Writes the picture as [`RadianceImage::display`] shows it, rounded to 8 bits of sRGB. The
    /// file appears complete or not at all. Pixels that are not finite are magenta.
    ///
    /// # Errors
    /// One line where the file cannot be written or the exposure is not above zero.
    pub fn write_png(&self, path: &Path, exposure: f32) -> Result<(), Error> {
        let bytes = self.png(exposure)?;
        write_atomically(path, |writer| writer.write_all(&bytes).map_err(|error| error.to_string()))
    }

    /// The same file in memory.
    ///
    /// # Errors
    /// One line where the exposure is not above zero.
    pub fn png(&self, exposure: f32) -> Result<Vec<u8>, Error> {
        self.check_shape()?;
        if !(exposure.is_finite() && exposure > 0.0) {
            return Err(Error::Exposure(exposure));
        }
        let shown = self.display(exposure);
        let bytes: Vec<u8> = shown.pixels.iter().flat_map(quantise).collect();
        let mut file = Vec::new();
        PngEncoder::new(&mut file)
            .write_image(&bytes, self.width, self.height, ExtendedColorType::Rgb8)
            .expect("memory takes any bytes of the right number");
        Ok(file)
    }
}

fn quantise(pixel: &[f32; 3]) -> [u8; 3] {
    if is_finite(pixel) { pixel.map(|c| (c * 255.0).round() as u8) } else { MAGENTA }
}
