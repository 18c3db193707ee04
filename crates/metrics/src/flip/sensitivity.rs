//! What contrast the observer sees, by filters for each channel of Y_y, c_x, c_z with the paper's constants.

use std::f64::consts::PI;

use super::plane::{PIXELS_PER_DEGREE, Plane, Taps};

/// Amplitude and, in degrees squared, scale of a Gaussian of the sensitivity.
type Term = [f64; 2];

const ACHROMATIC: &[Term] = &[[1.0, 0.0047]];
const RED_GREEN: &[Term] = &[[1.0, 0.0053]];
const BLUE_YELLOW: &[Term] = &[[34.1, 0.04], [13.5, 0.025]];
/// Of the widest of them.
const WIDEST: f64 = 0.04;

/// Y_y, c_x and c_z as they arrive.
pub(super) fn filtered(channels: &[Plane; 3]) -> [Plane; 3] {
    let [luminance, red_green, blue_yellow] = channels;
    [filter(luminance, ACHROMATIC), filter(red_green, RED_GREEN), filter(blue_yellow, BLUE_YELLOW)]
}

/// A sum of Gaussians a √(π/b) exp(−π² d² / b) at distances d in degrees, over their sum.
fn filter(channel: &Plane, terms: &[Term]) -> Plane {
    // Three standard deviations of the widest.
    let radius = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as usize;
    let gaussians: Vec<(f64, Taps)> = terms
        .iter()
        .map(|&[amplitude, scale]| {
            let taps = Taps::new(radius, |distance| {
                let degrees = distance / PIXELS_PER_DEGREE;
                (-(PI * degrees).powi(2) / scale).exp()
            });
            (amplitude * (PI / scale).sqrt() * taps.sum().powi(2), taps.normalized())
        })
        .collect();
    let total: f64 = gaussians.iter().map(|(weight, _)| weight).sum();
    let mut values = vec![0.0; channel.values.len()];
    for (weight, taps) in &gaussians {
        let part = channel.filtered_across(taps).filtered_down(taps);
        for (sum, value) in values.iter_mut().zip(part.values) {
            *sum += weight / total * value;
        }
    }
    Plane { values, ..*channel }
}
