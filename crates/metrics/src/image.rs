//! A picture of linear radiance.

use crate::Error;

/// Linear Rec. 709 radiance in W·m⁻²·sr⁻¹, row 0 at the top, `pixels.len() == width * height`.
#[derive(Clone, Debug, PartialEq)]
pub struct RadianceImage {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Row-major.
    pub pixels: Vec<[f32; 3]>,
}

impl RadianceImage {
    /// A black picture.
    pub fn black(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![[0.0; 3]; width as usize * height as usize] }
    }

    /// Pixels with a component that is infinite or not a number. Such a picture fails its run.
    pub fn non_finite(&self) -> usize {
        self.pixels.iter().filter(|pixel| !is_finite(pixel)).count()
    }

    /// Refuses a picture whose `pixels` do not fill its size, or that has none.
    pub(crate) fn check_shape(&self) -> Result<(), Error> {
        let Self { width, height, .. } = *self;
        let length = self.pixels.len();
        if length == 0 || length != width as usize * height as usize {
            return Err(Error::Shape { width, height, length });
        }
        Ok(())
    }

    /// Refuses a picture with pixels that are not finite; `which` names the picture.
    pub(crate) fn check_finite(&self, which: &'static str) -> Result<(), Error> {
        let Some(first) = self.pixels.iter().position(|pixel| !is_finite(pixel)) else {
            return Ok(());
        };
        let width = self.width as usize;
        let (column, row) = ((first % width) as u32, (first / width) as u32);
        Err(Error::NonFinite { which, count: self.non_finite(), column, row })
    }
}

/// Whether all three components are finite.
pub(crate) fn is_finite(pixel: &[f32; 3]) -> bool {
    pixel.iter().all(|c| c.is_finite())
}
