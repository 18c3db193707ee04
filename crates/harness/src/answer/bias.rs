//! Bias and variance: what of a method's error more work would not remove, and what chance adds.
//!
//! Over seeds s the picture X_s of a pixel has a mean and a variance, and its expected squared error
//! against the truth r splits into bias² + variance (Wackerly et al., "Mathematical Statistics",
//! 8.2). With n seeds the variance is estimated with n − 1, and (mean − r)² exceeds bias² by
//! variance/n and by the variance of the reference itself, both of which are subtracted. Where another
//! method is the reference, the truth r_s changes with the seed: then it is X_s − r_s that is split, and
//! the reference has no variance of its own.

use std::collections::BTreeMap;
use std::path::Path;

use manylights_metrics::RadianceImage;

use crate::error::Failure;
use crate::measurement::cell::{Cell, Outcome};
use crate::measurement::pictures::image_path;
use crate::measurement::reference::SceneReference;
use crate::measurement::scene_cells::SceneCells;
use crate::question::plan::Turn;

/// The two parts of an error, as roots of means over all components of all pixels, of sRGB values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bias {
    /// Root of the squared bias; zero where the estimate is not positive.
    pub(crate) bias: f64,
    /// Standard deviation over seeds.
    pub(crate) deviation: f64,
}

/// Splits the error of a variant by name of the reference; nothing below two seeds.
///
/// # Errors
/// One line where a picture cannot be read.
pub(crate) fn of_cells(
    cells: &[&(Turn, Cell)],
    scene: &SceneCells,
    out: &Path,
) -> Result<BTreeMap<String, Bias>, Failure> {
    let pictured = cells
        .iter()
        .filter(|(turn, cell)| turn.repetition == 0 && matches!(cell.outcome, Outcome::Done(_)));
    let read = |(turn, cell): &&(Turn, Cell)| {
        let path = image_path(out, &scene.scene, &cell.key).with_extension("exr");
        let image = RadianceImage::read_exr(&path).map_err(Failure::input)?;
        Ok((turn.seed, image.display(scene.exposure)))
    };
    let pictures: Vec<(u64, RadianceImage)> = pictured.map(read).collect::<Result<_, Failure>>()?;
    if pictures.len() < 2 {
        return Ok(BTreeMap::new());
    }
    let split = |reference: &SceneReference| {
        let truths = pictures.iter().map(|(seed, _)| reference.image_for(*seed));
        let truths: Vec<_> = truths.map(|truth| truth.display(scene.exposure)).collect();
        let pairs: Vec<_> = pictures.iter().map(|(_, picture)| picture).zip(&truths).collect();
        (reference.name.clone(), split(&pairs, reference.display_floor))
    };
    Ok(scene.references.iter().map(split).collect())
}

/// Of pictures, each with its truth.
fn split(pairs: &[(&RadianceImage, &RadianceImage)], floor: f64) -> Bias {
    let n = pairs.len() as f64;
    let components = pairs[0].0.pixels.as_flattened().len();
    let (mut squared, mut variance) = (0.0, 0.0);
    for index in 0..components {
        let value = |image: &RadianceImage| f64::from(image.pixels.as_flattened()[index]);
        let errors = || pairs.iter().map(|(picture, truth)| value(picture) - value(truth));
        let mean = errors().sum::<f64>() / n;
        let spread: f64 = errors().map(|error| (error - mean).powi(2)).sum();
        squared += mean.powi(2);
        variance += spread / (n - 1.0);
    }
    let count = components as f64;
    let (squared, variance) = (squared / count, variance / count);
    Bias {
        bias: (squared - variance / n - floor * floor).max(0.0).sqrt(),
        deviation: variance.sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The finaliser of SplitMix64: bits of neighbouring numbers are independent.
    fn splitmix(number: u64) -> u64 {
        let z = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    #[test]
    fn bias_and_deviation_of_a_known_distribution() {
        // Pixels are 0.5 + 0.1 ± 0.2, the sign a hash of pixel and seed; the truth is 0.5.
        let picture = |seed: u64| RadianceImage {
            width: 64,
            height: 64,
            pixels: (0..64 * 64)
                .map(|index: u64| {
                    [if splitmix(index * 8 + seed) >> 63 == 0 { 0.8 } else { 0.4 }; 3]
                })
                .collect(),
        };
        let pictures: Vec<_> = (0..8).map(picture).collect();
        // A truth of which the noise is known: none, and as much as the bias itself.
        for floor in [0.0_f32, 0.1] {
            let value =
                |index: u64| if splitmix(index * 8 + 9) >> 63 == 0 { floor } else { -floor };
            let pixels = (0..64 * 64).map(|index| [0.5 + value(index); 3]).collect();
            let truth = RadianceImage { width: 64, height: 64, pixels };
            let pairs: Vec<_> = pictures.iter().map(|picture| (picture, &truth)).collect();
            let Bias { bias, deviation } = split(&pairs, floor.into());
            // 4096 pixels of 8 seeds: both are known to about 1 %.
            assert!((bias - 0.1).abs() < 0.01, "{bias} beside {floor}");
            assert!((deviation - 0.2).abs() < 0.01, "{deviation} beside {floor}");
        }
        // Against itself, seed by seed, nothing is left, whatever the noise.
        let own: Vec<_> = pictures.iter().map(|picture| (picture, picture)).collect();
        assert_eq!(split(&own, 0.0), Bias { bias: 0.0, deviation: 0.0 });
    }
}
