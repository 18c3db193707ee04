//! Quadrature over the hemisphere, for tests of hemispherical harmonics.

use std::f64::consts::TAU;

use manylights_harmonics::hemispherical::HemisphericalBasis;
use manylights_harmonics::projection::scalar_product;
use manylights_harmonics::quadrature::gauss_legendre;
use manylights_harmonics::{Basis, count};

/// H_lm of a direction.
pub(crate) fn above(bands: usize, direction: [f64; 3]) -> Vec<f64> {
    let mut values = vec![0.0; count(bands)];
    HemisphericalBasis::new(bands).evaluate(direction, &mut values);
    values
}

/// Nodes over the hemisphere, dense towards the horizon, where HSH are analytic in √z only.
pub(crate) fn graded(count: usize) -> Vec<([f64; 3], f64)> {
    let turns = 2 * count;
    let rings = gauss_legendre(count).into_iter().map(|(node, weight)| {
        let root = 0.5 * (1.0 + node);
        (root * root, weight * root)
    });
    rings
        .flat_map(|(z, weight)| {
            let r = (1.0 - z * z).sqrt();
            (0..turns).map(move |k| {
                let (s, c) = (TAU * k as f64 / turns as f64).sin_cos();
                ([r * c, r * s, z], weight * TAU / turns as f64)
            })
        })
        .collect()
}

/// Coefficients in −1 … 1 that look random.
pub(crate) fn pseudo_random(size: usize) -> Vec<f64> {
    (0..size).map(|i| (12.9898 * (i + 1) as f64).sin() * (4.1 * i as f64).cos()).collect()
}

/// Coefficients of a function on the hemisphere.
pub(crate) fn project(basis: &HemisphericalBasis<f64>, f: impl FnMut([f64; 3]) -> f64) -> Vec<f64> {
    let mut coefficients = vec![0.0; count(basis.bands())];
    let evaluate = |d, values: &mut [f64]| basis.evaluate(d, values);
    scalar_product(graded(40), evaluate, f, &mut coefficients.clone(), &mut coefficients);
    coefficients
}

/// The value of an SH expansion.
pub(crate) fn expand(basis: &Basis<f64>, coefficients: &[f64], direction: [f64; 3]) -> f64 {
    let mut values = vec![0.0; coefficients.len()];
    basis.evaluate(direction, &mut values);
    values.iter().zip(coefficients).map(|(y, c)| y * c).sum()
}
