//! Gauss–Legendre quadrature: the truth that closed forms are tested against.

use std::f64::consts::PI;

/// Nodes and weights on [−1, 1] that integrate polynomials of degree 2 `count` − 1 exactly.
///
/// Newton's iteration on P_count from Tricomi's start value; weights 2(1 − x²)/(count P_{count−1})².
pub fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    (0..count)
        .map(|i| {
            let mut x = -((i as f64 + 0.75) / (n + 0.5) * PI).cos();
            let mut previous = 1.0;
            for _ in 0..100 {
                let (value, before) = legendre(count, x);
                previous = before;
                let step = value * (1.0 - x * x) / (n * (before - x * value));
                x -= step;
                if step.abs() <= f64::EPSILON {
                    break;
                }
            }
            (x, 2.0 * (1.0 - x * x) / (n * previous).powi(2))
        })
        .collect()
}

/// P_n(x) and P_{n−1}(x).
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for l in 1..=n {
        let l = l as f64;
        (before, value) = (value, ((2.0 * l - 1.0) * x * value - (l - 1.0) * before) / l);
    }
    (value, before)
}

/// ∫ f dω over the part of the sphere with `low` ≤ z ≤ `high`, at [`sphere_nodes`].
pub fn sphere(count: usize, range: [f64; 2], mut f: impl FnMut([f64; 3]) -> f64) -> f64 {
    sphere_nodes(count, range).into_iter().map(|(direction, weight)| weight * f(direction)).sum()
}

/// Directions and weights on the part of the sphere with `low` ≤ z ≤ `high`: `count`
/// Gauss–Legendre nodes in z and 2 `count` equidistant ones in φ. Exact for polynomials in x, y, z of
/// degree 2 `count` − 1 (for even powers of sin θ; all SH products are such).
pub fn sphere_nodes(count: usize, [low, high]: [f64; 2]) -> Vec<([f64; 3], f64)> {
    let turns = 2 * count;
    let mut nodes = Vec::with_capacity(count * turns);
    for (node, weight) in gauss_legendre(count) {
        let z = 0.5 * (low + high) + 0.5 * (high - low) * node;
        let sine = ((1.0 - z) * (1.0 + z)).sqrt();
        let weight = weight * 0.5 * (high - low) * 2.0 * PI / turns as f64;
        nodes.extend((0..turns).map(|k| {
            let (s, c) = (2.0 * PI * (k as f64 + 0.5) / turns as f64).sin_cos();
            ([sine * c, sine * s, z], weight)
        }));
    }
    nodes
}
