//! Errors of a picture against a reference.

use serde::{Deserialize, Serialize};

use crate::{Error, RadianceImage, flip, ssim};

/// How far a picture x is from its reference r, as means over all components of all pixels (SSIM:
/// of the valid region). [`METRICS`](crate::METRICS) has the formulas in words for people.
///
/// All sums are in f64 and in one fixed order, row by row: the same pictures give the same digits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Root of the mean squared error, `√mse`, in the unit of the values.
    pub rmse: f64,
    /// Mean squared error, `mean((x − r)²)`.
    pub mse: f64,
    /// Mean absolute error, `mean(|x − r|)`, in the unit of the values.
    pub mae: f64,
    /// Peak signal-to-noise ratio, `10 log₁₀(range² / mse)`, in dB. Identical pictures have infinity,
    /// which JSON cannot say: it is serialised as null.
    #[serde(with = "decibels")]
    pub psnr: f64,
    /// Structural similarity after Wang, Bovik, Sheikh and Simoncelli (2004), equations 13 to 16:
    /// Gaussian window of 11×11 pixels with σ = 1.5, K₁ = 0.01, K₂ = 0.03, per component, then the
    /// mean over the pixels whose window lies in the picture. 1 for identical pictures.
    pub ssim: f64,
    /// Relative mean squared error, `mean((x − r)² / (r² + 0.01))`: the form and ε of Rousselle,
    /// Knaus and Zwicker (2011). The ε is in squared units of the values: pictures much darker than
    /// 0.1 fall back to a scaled `mse`.
    pub rel_mse: f64,
    /// Symmetric mean absolute relative error, `mean(|x − r| / (|x| + |r|))` with 0/0 = 0, in
    /// `[0, 1]`. Without an ε, so that it does not depend on the scale.
    pub smape: f64,
    /// 99.9th percentile (nearest rank) of `|x − r| / √(r² + 0.01)`, the root of the terms of
    /// `rel_mse`: what spikes do, which means hardly show.
    pub rel_p999: f64,
    /// `rel_mse` without the largest 0.1 % of its terms, those above the percentile of `rel_p999`: what a few
    /// spikes do not decide. Unknown of pictures compared before there was this metric.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rel_mse_trimmed: Option<f64>,
    /// Mean ꟻLIP difference (Andersson et al. 2020), in `[0, 1]`, as an observer sees it who has 67 pixels a
    /// degree. It is defined on what a display shows: unknown of linear values, and of pictures compared before
    /// there was this metric.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flip: Option<f64>,
}

/// ε of [`Errors::rel_mse`] and [`Errors::rel_p999`].
const RELATIVE_EPSILON: f64 = 0.01;
/// Share of the components that [`Errors::rel_p999`] and [`Errors::rel_mse_trimmed`] are of.
const RELATIVE_SHARE: f64 = 0.999;

/// Compares the values as they are. `range` is the peak of [`Errors::psnr`] and the dynamic range L
/// of [`Errors::ssim`], in the unit of the values.
///
/// # Errors
/// One line where the sizes differ, are smaller than 11×11 or do not match the number of pixels,
/// where a pixel of either is not finite (how many, and the first), and where `range` is not finite
/// and above zero.
pub fn compare(
    image: &RadianceImage,
    reference: &RadianceImage,
    range: f64,
) -> Result<Errors, Error> {
    check(image, reference)?;
    if !(range.is_finite() && range > 0.0) {
        return Err(Error::Range(range));
    }
    let sums = Sums::over(image, reference);
    let count = components(image);
    let mse = sums.squared / count;
    let (rel_p999, rel_mse_trimmed) = without_spikes(image, reference);
    Ok(Errors {
        rmse: mse.sqrt(),
        mse,
        mae: sums.absolute / count,
        psnr: 20.0 * range.log10() - 10.0 * mse.log10(),
        ssim: ssim::mean(image, reference, range),
        rel_mse: sums.relative_squared / count,
        smape: sums.symmetric / count,
        rel_p999,
        rel_mse_trimmed: Some(rel_mse_trimmed),
        flip: None,
    })
}

/// Compares linear Rec. 709 radiance in W·m⁻²·sr⁻¹; the range is the largest component of the
/// reference.
///
/// # Errors
/// As [`compare`]; a black reference has no range.
pub fn compare_linear(image: &RadianceImage, reference: &RadianceImage) -> Result<Errors, Error> {
    check(image, reference)?;
    let range = reference.pixels.iter().flatten().fold(0.0_f32, |largest, &c| largest.max(c));
    compare(image, reference, f64::from(range))
}

/// Compares both pictures as [`RadianceImage::display`] shows them at one `exposure` (m²·sr·W⁻¹):
/// sRGB values in `[0, 1]`, range 1. Here alone [`Errors::flip`] is known.
///
/// # Errors
/// As [`compare`] for the linear pictures, and where `exposure` is not finite and above zero.
pub fn compare_display(
    image: &RadianceImage,
    reference: &RadianceImage,
    exposure: f32,
) -> Result<Errors, Error> {
    let [image, reference] = displayed(image, reference, exposure)?;
    let errors = compare(&image, &reference, 1.0)?;
    Ok(Errors { flip: Some(flip::mean(&image, &reference)), ..errors })
}

/// [`Errors::rmse`] of [`compare_display`] alone, in much less time.
///
/// # Errors
/// As [`compare_display`].
pub fn display_rmse(
    image: &RadianceImage,
    reference: &RadianceImage,
    exposure: f32,
) -> Result<f64, Error> {
    let [image, reference] = displayed(image, reference, exposure)?;
    Ok((Sums::over(&image, &reference).squared / components(&image)).sqrt())
}

/// Both pictures as they are shown.
fn displayed(
    image: &RadianceImage,
    reference: &RadianceImage,
    exposure: f32,
) -> Result<[RadianceImage; 2], Error> {
    check(image, reference)?;
    if !(exposure.is_finite() && exposure > 0.0) {
        return Err(Error::Exposure(exposure));
    }
    Ok([image, reference].map(|picture| picture.display(exposure)))
}

fn components(image: &RadianceImage) -> f64 {
    (3 * image.pixels.len()) as f64
}

fn check(image: &RadianceImage, reference: &RadianceImage) -> Result<(), Error> {
    image.check_shape()?;
    reference.check_shape()?;
    let sizes = [[image.width, image.height], [reference.width, reference.height]];
    if sizes[0] != sizes[1] {
        return Err(Error::Sizes { image: sizes[0], reference: sizes[1] });
    }
    let [width, height] = sizes[0];
    if width.min(height) < ssim::WINDOW as u32 {
        return Err(Error::TooSmall { width, height });
    }
    image.check_finite("image")?;
    reference.check_finite("reference")
}

/// The smallest relative error that [`RELATIVE_SHARE`] of the components do not exceed, and the mean square of
/// those that share has.
fn without_spikes(image: &RadianceImage, reference: &RadianceImage) -> (f64, f64) {
    let components = image.pixels.as_flattened().iter().zip(reference.pixels.as_flattened());
    let errors: Vec<f64> = components
        .map(|(&x, &r)| (f64::from(x), f64::from(r)))
        .map(|(x, r)| (x - r).abs() / (r * r + RELATIVE_EPSILON).sqrt())
        .collect();
    let kept = ((RELATIVE_SHARE * errors.len() as f64).ceil() as usize).max(1);
    let largest = *errors.clone().select_nth_unstable_by(kept - 1, f64::total_cmp).1;
    // In the order of the pixels, which no way of sorting changes; of equal ones as many as are left to keep.
    let (mut sum, mut smaller) = (0.0, 0);
    for row in errors.chunks_exact(3 * image.width as usize) {
        let below = row.iter().filter(|&&error| error < largest);
        smaller += below.clone().count();
        sum += below.map(|error| error * error).sum::<f64>();
    }
    let equal = (kept - smaller) as f64;
    (largest, (sum + equal * largest * largest) / kept as f64)
}

/// Sums over the components of some pixels.
#[derive(Clone, Copy, Default)]
struct Sums {
    squared: f64,
    absolute: f64,
    relative_squared: f64,
    symmetric: f64,
}

impl Sums {
    /// Row by row: sums of sums lose fewer digits than one long sum.
    fn over(image: &RadianceImage, reference: &RadianceImage) -> Self {
        let width = image.width as usize;
        let rows = image.pixels.chunks_exact(width).zip(reference.pixels.chunks_exact(width));
        rows.fold(Self::default(), |total, (row, reference)| {
            let mut sums = Self::default();
            for (&x, &r) in row.as_flattened().iter().zip(reference.as_flattened()) {
                sums.add(f64::from(x), f64::from(r));
            }
            Self {
                squared: total.squared + sums.squared,
                absolute: total.absolute + sums.absolute,
                relative_squared: total.relative_squared + sums.relative_squared,
                symmetric: total.symmetric + sums.symmetric,
            }
        })
    }

    fn add(&mut self, x: f64, r: f64) {
        let difference = x - r;
        let squared = difference * difference;
        self.squared += squared;
        self.absolute += difference.abs();
        self.relative_squared += squared / (r * r + RELATIVE_EPSILON);
        if difference != 0.0 {
            self.symmetric += difference.abs() / (x.abs() + r.abs());
        }
    }
}

/// Infinity as null.
mod decibels {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        value.is_finite().then_some(value).serialize(serializer)
    }

    pub(super) fn deserialize<'d, D: Deserializer<'d>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }
}
