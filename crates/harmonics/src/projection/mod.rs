//! Projection of a function that is known by its values: scalar products over samples (thesis 2.2.3)
//! and least squares (2.2.4, 5.3.1).

pub(crate) mod jacobi;
mod least_squares;

pub use least_squares::{Filter, LeastSquares};

use crate::Real;

/// `count` directions with their equal weights, in steradians, on the part of the sphere with `low` ≤
/// z ≤ `high`: the spherical Fibonacci points (Keinert et al. 2015), spread evenly for any count.
pub fn fibonacci<R: Real>(
    count: usize,
    [low, high]: [f64; 2],
) -> impl ExactSizeIterator<Item = ([R; 3], R)> + Clone {
    let (area, golden) = (std::f64::consts::TAU * (high - low), 0.5 * (5.0_f64.sqrt() - 1.0));
    (0..count).map(move |i| {
        let z = high - (high - low) * (i as f64 + 0.5) / count as f64;
        let sine = ((1.0 - z) * (1.0 + z)).sqrt();
        let (s, c) = (std::f64::consts::TAU * (i as f64 * golden).fract()).sin_cos();
        ([sine * c, sine * s, z].map(R::of), R::of(area / count as f64))
    })
}

/// Writes Σ w f(ω) B(ω) over the nodes (ω, w) to `coefficients`: the scalar products of f with the
/// functions of a basis, of which `evaluate` writes the values at a direction.
///
/// The basis is [`crate::Basis`] or [`crate::hemispherical::HemisphericalBasis`]; the nodes are those
/// of [`fibonacci`] or, for a truth, of [`crate::quadrature::sphere_nodes`]. `scratch` is as long as
/// `coefficients` and is overwritten.
pub fn scalar_product<R: Real>(
    nodes: impl IntoIterator<Item = ([R; 3], R)>,
    evaluate: impl Fn([R; 3], &mut [R]),
    mut f: impl FnMut([R; 3]) -> R,
    scratch: &mut [R],
    coefficients: &mut [R],
) {
    assert_eq!(scratch.len(), coefficients.len(), "as much scratch as coefficients");
    coefficients.fill(R::zero());
    for (direction, weight) in nodes {
        evaluate(direction, scratch);
        let weighted = weight * f(direction);
        for (sum, value) in coefficients.iter_mut().zip(&*scratch) {
            *sum += weighted * *value;
        }
    }
}
