//! Edges and points.

use std::f64::consts::SQRT_2;

use super::plane::{PIXELS_PER_DEGREE, Plane, Taps};

/// Width of the lines that the observer detects best, in degrees.
const WIDTH: f64 = 0.082;

/// How much of an edge and of a point a pixel is.
pub(super) struct Features {
    edge: f64,
    point: f64,
}

impl Features {
    /// In `[0, 1]`.
    pub(super) fn difference(&self, other: &Self) -> f64 {
        (self.edge - other.edge).abs().max((self.point - other.point).abs()) / SQRT_2
    }
}

/// Of Y_y, by first and second derivatives of a Gaussian.
pub(super) fn of_achromatic(luminance: &Plane) -> Vec<Features> {
    let relative = luminance.values.iter().map(|value| (value + 16.0) / 116.0).collect();
    let luminance = Plane { values: relative, ..*luminance };
    let deviation = 0.5 * WIDTH * PIXELS_PER_DEGREE;
    let taps = |factor: fn(f64) -> f64| {
        let weight = |distance: f64| {
            let x = distance / deviation;
            factor(x) * (-0.5 * x * x).exp()
        };
        Taps::new((3.0 * deviation).ceil() as usize, weight).normalized()
    };
    let (smooth, first, second) = (taps(|_| 1.0), taps(|x| -x), taps(|x| x * x - 1.0));
    let smoothed = luminance.filtered_across(&smooth);
    let length = |derivative: &Taps| {
        let across = luminance.filtered_across(derivative).filtered_down(&smooth);
        let down = smoothed.filtered_down(derivative);
        let parts = across.values.into_iter().zip(down.values);
        parts.map(|(across, down)| across.hypot(down)).collect::<Vec<_>>()
    };
    let pixels = length(&first).into_iter().zip(length(&second));
    pixels.map(|(edge, point)| Features { edge, point }).collect()
}
