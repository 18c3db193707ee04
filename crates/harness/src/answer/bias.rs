//! Bias and variance: what of a method's error more work would not remove, and what chance adds.
//!
//! Over seeds s the picture X_s of a pixel has a mean and a variance, and its expected squared error
//! against the truth r splits into bias² + variance (Wackerly et al., "Mathematical Statistics",
//! 8.2). With n seeds the variance is estimated with n − 1, and (mean − r)² exceeds bias² by
//! variance/n and by the variance of the reference itself, both of which are subtracted. Where another
//! method is the reference, the truth r_s changes with the seed: then it is X_s − r_s that is split, and
//! the reference has no variance of its own.
//!
//! Intervals are the jackknife's (Efron and Tibshirani, "An Introduction to the Bootstrap", 11): both estimates
//! again without each seed. To that of the bias the reference adds its own ([`Sample::reference_variance`]).

use std::collections::BTreeMap;
use std::path::Path;

use manylights_metrics::RadianceImage;

use crate::answer::significance::{Estimate, Sample, jackknife};
use crate::error::Failure;
use crate::measurement::cell::{Cell, Outcome};
use crate::measurement::pictures::image_path;
use crate::measurement::reference::SceneReference;
use crate::measurement::scene_cells::SceneCells;
use crate::question::plan::Turn;

/// The two parts of a squared error, as means over all components of all pixels, of sRGB values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Split {
    /// The squared bias; below zero by chance.
    pub(crate) squared_bias: Estimate,
    /// The variance over seeds.
    pub(crate) variance: Estimate,
}

/// Splits the error of a variant by name of the reference; nothing below two seeds.
///
/// # Errors
/// One line where a picture cannot be read.
pub(crate) fn of_cells(
    cells: &[&(Turn, Cell)],
    samples: &BTreeMap<String, Sample>,
    scene: &SceneCells,
    out: &Path,
) -> Result<BTreeMap<String, Split>, Failure> {
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
        let noise = samples.get(&reference.name).and_then(Sample::reference_variance);
        (reference.name.clone(), split(&pairs, reference.display_floor, noise))
    };
    Ok(scene.references.iter().map(split).collect())
}

/// Of pictures, each with its truth. `noise` is what the reference adds to the variance of a squared error, with its
/// degrees of freedom.
pub(super) fn split(
    pairs: &[(&RadianceImage, &RadianceImage)],
    floor: f64,
    noise: Option<(f64, usize)>,
) -> Split {
    let count = pairs.len();
    let components = pairs[0].0.pixels.as_flattened().len();
    // Both parts of all seeds, then without each of them.
    let (mut all, mut without) = ([0.0; 2], vec![[0.0; 2]; count]);
    let mut errors = vec![0.0; count];
    for index in 0..components {
        let value = |image: &RadianceImage| f64::from(image.pixels.as_flattened()[index]);
        for (error, (picture, truth)) in errors.iter_mut().zip(pairs) {
            *error = value(picture) - value(truth);
        }
        add(&mut all, &errors, None);
        if count > 2 {
            (0..count).for_each(|seed| add(&mut without[seed], &errors, Some(seed)));
        }
    }
    let scale = 1.0 / components as f64;
    let [squared_bias, variance] = [0, 1].map(|part| {
        let value = all[part] * scale;
        if count < 3 {
            // One seed of two is no sample.
            return Estimate { value, half: f64::INFINITY };
        }
        let seeds: Vec<_> = without.iter().map(|parts| parts[part] * scale).collect();
        let mut spread = vec![jackknife(&seeds)];
        spread.extend(noise.filter(|_| part == 0));
        Estimate::new(value, &spread)
    });
    let squared_bias = Estimate { value: squared_bias.value - floor.powi(2), ..squared_bias };
    Split { squared_bias, variance }
}

/// Adds the squared bias and the variance of a component over seeds, but for one of them.
fn add(parts: &mut [f64; 2], errors: &[f64], but: Option<usize>) {
    let rest = || errors.iter().enumerate().filter(|(seed, _)| Some(*seed) != but);
    let count = rest().count() as f64;
    let mean = rest().map(|(_, error)| error).sum::<f64>() / count;
    let spread: f64 = rest().map(|(_, error)| (error - mean).powi(2)).sum();
    let variance = spread / (count - 1.0);
    parts[0] += mean.powi(2) - variance / count;
    parts[1] += variance;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::statistics::mean;

    fn squared_error(picture: &RadianceImage, truth: &RadianceImage) -> f64 {
        let [picture, truth] = [picture, truth].map(|image| image.pixels.as_flattened());
        let squares = picture.iter().zip(truth).map(|(x, r)| f64::from(x - r).powi(2));
        mean(squares.collect::<Vec<_>>().into_iter())
    }

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
            let Split { squared_bias, variance } = split(&pairs, floor.into(), None);
            let [[bias, ..], [deviation, ..]] = [squared_bias, variance].map(|part| part.roots());
            // 4096 pixels of 8 seeds: both are known to about 1 %.
            assert!((bias - 0.1).abs() < 0.01, "{bias} beside {floor}");
            assert!((deviation - 0.2).abs() < 0.01, "{deviation} beside {floor}");
            let squared = pairs.iter().map(|(picture, truth)| squared_error(picture, truth));
            let whole = mean(squared) - f64::from(floor).powi(2);
            let sum = squared_bias.value + variance.value;
            assert!((sum - whole).abs() < 1e-9, "{sum} of {whole}");
        }
        // Against itself, seed by seed, nothing is left, whatever the noise.
        let own: Vec<_> = pictures.iter().map(|picture| (picture, picture)).collect();
        let nothing = Estimate { value: 0.0, half: 0.0 };
        assert_eq!(split(&own, 0.0, None), Split { squared_bias: nothing, variance: nothing });
    }
}
