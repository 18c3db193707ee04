//! Errors of a picture by its parts: what says whether the order of two pictures is chance.

use manylights_metrics::RadianceImage;
use serde::{Deserialize, Serialize};

/// Along each side of a picture.
const SIDE: usize = 4;

/// Tiles of a picture, row by row.
pub(crate) const TILES: usize = SIDE * SIDE;

/// Squared errors of sRGB values by tile, each over the number of all components of the picture: their sum is
/// the mean squared error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Tiles {
    /// Against the reference.
    pub(crate) squared: Vec<f32>,
    /// Half of what the error against one half of the reference's samples exceeds that against the other half:
    /// (r₂ − r₁)(2x − r₁ − r₂)/2, which is linear in the picture x and has the variance that the noise of the
    /// whole reference gives its squared error, but for a part that all pictures share. Empty where another method
    /// is the reference, which has no noise.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) imbalance: Vec<f32>,
}

impl Tiles {
    /// Of sRGB values.
    pub(crate) fn new(
        picture: &RadianceImage,
        truth: &RadianceImage,
        halves: Option<&[RadianceImage; 2]>,
    ) -> Self {
        let squared = |truth| by_tile(picture, |index| squared(picture, truth, index));
        let imbalance = halves.map_or(Vec::new(), |[a, b]| {
            let of =
                |index| 0.5 * (self::squared(picture, a, index) - self::squared(picture, b, index));
            by_tile(picture, of)
        });
        Self { squared: squared(truth), imbalance }
    }
}

/// Of a pixel, over all components.
fn squared(picture: &RadianceImage, truth: &RadianceImage, index: usize) -> f64 {
    let [picture, truth] = [picture, truth].map(|image| image.pixels[index]);
    let terms = picture.iter().zip(truth).map(|(&x, r)| (f64::from(x) - f64::from(r)).powi(2));
    terms.sum()
}

fn by_tile(picture: &RadianceImage, of: impl Fn(usize) -> f64) -> Vec<f32> {
    let [width, height] = [picture.width, picture.height].map(|side| side as usize);
    let mut sums = [0.0; TILES];
    for index in 0..picture.pixels.len() {
        let (x, y) = (index % width, index / width);
        sums[y * SIDE / height * SIDE + x * SIDE / width] += of(index);
    }
    let components = (3 * picture.pixels.len()) as f64;
    sums.map(|sum| (sum / components) as f32).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(value: impl Fn(usize) -> f32) -> RadianceImage {
        let pixels = (0..13 * 11).map(|index| [value(index), 0.5, 0.25]).collect();
        RadianceImage { width: 13, height: 11, pixels }
    }

    #[test]
    fn tiles_add_up_to_the_picture() {
        let (picture, truth) = (image(|index| 0.01 * (index % 7) as f32), image(|_| 0.02));
        let halves = [image(|index| 0.02 + 0.001 * (index % 3) as f32), image(|_| 0.019)];
        let tiles = Tiles::new(&picture, &truth, Some(&halves));
        let mean = |truth: &RadianceImage| {
            (0..13 * 11).map(|index| squared(&picture, truth, index)).sum::<f64>()
                / (3.0 * 13.0 * 11.0)
        };
        let sum = |values: &[f32]| values.iter().copied().map(f64::from).sum::<f64>();
        assert_eq!([tiles.squared.len(), tiles.imbalance.len()], [TILES; 2]);
        assert!((sum(&tiles.squared) - mean(&truth)).abs() < 1e-9);
        let [a, b] = halves.each_ref().map(mean);
        assert!((sum(&tiles.imbalance) - 0.5 * (a - b)).abs() < 1e-9);
        assert!(Tiles::new(&picture, &truth, None).imbalance.is_empty());
    }
}
