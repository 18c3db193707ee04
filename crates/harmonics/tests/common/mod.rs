//! What several test files share.

use manylights_harmonics::rotation::Matrix;
use manylights_harmonics::{Basis, Real, count};
use proptest::prelude::*;

/// Unit vectors, uniform.
pub(crate) fn direction() -> impl Strategy<Value = [f64; 3]> {
    (-1.0..1.0_f64, 0.0..std::f64::consts::TAU).prop_map(|(z, angle)| {
        let sine = (1.0 - z * z).sqrt();
        [sine * angle.cos(), sine * angle.sin(), z]
    })
}

/// Rotations, from unit quaternions.
pub(crate) fn rotation() -> impl Strategy<Value = Matrix<f64>> {
    (direction(), 0.0..std::f64::consts::TAU).prop_map(|(axis, angle)| about(axis, angle))
}

/// The rotation about a unit axis (Rodrigues).
pub(crate) fn about([x, y, z]: [f64; 3], angle: f64) -> Matrix<f64> {
    let (s, c) = angle.sin_cos();
    let t = 1.0 - c;
    [
        [t * x * x + c, t * x * y - s * z, t * x * z + s * y],
        [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
        [t * x * z - s * y, t * y * z + s * x, t * z * z + c],
    ]
}

/// Q ω.
pub(crate) fn turn(q: &Matrix<f64>, w: [f64; 3]) -> [f64; 3] {
    q.map(|row| dot(&row, &w))
}

/// Σ a_i b_i.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Coefficients in −1 … 1 that look random and are the same in every run.
pub(crate) fn coefficients(count: usize, seed: usize) -> Vec<f64> {
    (0..count).map(|i| ((i * i + 7 * seed) as f64 * 0.754_877_666 + seed as f64).sin()).collect()
}

/// The largest magnitude.
pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| value.abs().max(most))
}

/// The largest difference of two slices.
pub(crate) fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |most, (a, b)| {
        assert!(a.is_finite() && b.is_finite(), "{a} against {b}");
        (a - b).abs().max(most)
    })
}

/// df/dt at `t` by Richardson's extrapolation of central differences, step `h` and its halves.
pub(crate) fn derivative(t: f64, h: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    const LEVELS: usize = 5;
    let mut table = [0.0; LEVELS];
    for level in 0..LEVELS {
        let step = h / f64::from(1 << level);
        let mut value = (f(t + step) - f(t - step)) / (2.0 * step);
        let mut power = 1.0;
        for entry in &mut table[..level] {
            power *= 4.0;
            let better = value + (value - *entry) / (power - 1.0);
            *entry = value;
            value = better;
        }
        table[level] = value;
    }
    table[LEVELS - 1]
}

/// Values and gradients at a direction, [Y, ∂x, ∂y, ∂z] by coefficient.
pub(crate) fn evaluate<R: Real>(basis: &Basis<R>, direction: [R; 3]) -> Vec<[f64; 4]> {
    let zero = || vec![R::zero(); count(basis.bands())];
    let (mut values, mut gx, mut gy, mut gz) = (zero(), zero(), zero(), zero());
    basis.evaluate_with_gradient(direction, &mut values, [&mut gx, &mut gy, &mut gz]);
    (0..values.len()).map(|i| [values[i], gx[i], gy[i], gz[i]].map(Real::to_f64)).collect()
}

/// The largest value and gradient of band `l` anywhere, by the addition theorem.
pub(crate) fn limits(l: usize) -> [f64; 4] {
    let value = ((2 * l + 1) as f64 / (4.0 * std::f64::consts::PI)).sqrt();
    let gradient = value * ((l * (l + 1)) as f64 / 2.0).sqrt();
    [value, gradient, gradient, gradient]
}
