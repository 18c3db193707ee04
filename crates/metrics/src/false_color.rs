//! Where a picture errs.

use std::f64::consts::PI;

use crate::RadianceImage;

/// The error of each pixel, the mean over its components of |x − r|, as colour: black for none,
/// through violet, red and orange to a light yellow at `scale` (in W·m⁻²·sr⁻¹, above zero) and beyond.
/// Equal steps of error are equal steps of lightness. The result is linear Rec. 709 like any other
/// picture, made to be shown at exposure 1. Pixels that are not finite in either picture are NaN.
///
/// # Panics
/// Where the sizes differ; [`crate::compare()`] reports that as an error.
pub fn false_color(image: &RadianceImage, reference: &RadianceImage, scale: f32) -> RadianceImage {
    let sizes = [image, reference].map(|picture| (picture.width, picture.height));
    assert_eq!(sizes[0], sizes[1], "pictures of one size");
    let color = |(x, r): (&[f32; 3], &[f32; 3])| {
        let difference = |k: usize| f64::from(x[k]) - f64::from(r[k]);
        let error = (0..3).map(|k| difference(k).abs()).sum::<f64>() / 3.0;
        if !error.is_finite() {
            return [f32::NAN; 3];
        }
        ramp((error / f64::from(scale)).min(1.0)).map(|c| c as f32)
    };
    let pixels = image.pixels.iter().zip(&reference.pixels).map(color).collect();
    RadianceImage { pixels, ..*image }
}

/// A path through Oklab (Ottosson, "A perceptual color space for image processing", 2020): lightness
/// in proportion to `t`, hue from violet over red to yellow, chroma within the gamut of Rec. 709.
fn ramp(t: f64) -> [f64; 3] {
    let lightness = 0.97 * t;
    let hue = (-75.0 + 180.0 * t).to_radians();
    let chroma = 0.17 * (0.85 * PI * t).sin();
    linear_rec709(lightness, chroma * hue.cos(), chroma * hue.sin())
}

/// Linear Rec. 709 of a colour in Oklab; the matrices are those of its definition.
fn linear_rec709(lightness: f64, a: f64, b: f64) -> [f64; 3] {
    let l = (lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let m = (lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let s = (lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b).powi(3);
    [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nothing is clipped, so that lightness is what the ramp says.
    #[test]
    fn the_ramp_stays_in_gamut() {
        for step in 0..=1000 {
            let t = f64::from(step) / 1000.0;
            let [r, g, b] = ramp(t);
            // The published matrices have ten digits.
            assert!([r, g, b].iter().all(|c| (-1e-8..=1.0).contains(c)), "{t}: {r} {g} {b}");
        }
    }
}
