//! Rotation of expansions: about z, by zxzxz, and by exact block matrices.
//!
//! A rotation is a 3 × 3 matrix Q of rows with Q ω the turned direction. The turned function is
//! ω ↦ f(Q⁻¹ ω): what f has at ω, it has at Q ω.

mod blocks;
mod zxzxz;

pub use blocks::Blocks;
pub use zxzxz::Zxzxz;

use crate::{Real, index};

/// A rotation as rows of a 3 × 3 matrix.
pub type Matrix<R> = [[R; 3]; 3];

/// Turns a function about z by the angle of these sine and cosine, in place.
///
/// Thesis 2.74, 2.75: (l, m) and (l, −m) turn into each other by m times the angle. Deviation: the
/// multiples come from the product of complex numbers, whose f32 error grows more slowly than that
/// of the three-term recurrence 2.75.
pub fn rotate_z<R: Real>(bands: usize, [sine, cosine]: [R; 2], coefficients: &mut [R]) {
    assert_eq!(coefficients.len(), bands * bands, "bands² coefficients");
    let (mut s, mut c) = (sine, cosine);
    for m in 1..bands {
        let signed = m as isize;
        for l in m..bands {
            let (up, down) = (index(l, signed), index(l, -signed));
            let (even, odd) = (coefficients[up], coefficients[down]);
            coefficients[up] = c * even - s * odd;
            coefficients[down] = s * even + c * odd;
        }
        (s, c) = (s * cosine + c * sine, c * cosine - s * sine);
    }
}
