//! Integrals of three real spherical harmonics, for tables.

use std::f64::consts::PI;

use crate::quadrature::gauss_legendre;
use crate::{Basis, count, index};

/// The z-parts of the basis at Gauss–Legendre nodes enough for products of three.
pub(crate) struct Gaunt {
    /// Weight of a node and its Y_lm at φ = 0, m ≥ 0.
    nodes: Vec<(f64, Vec<f64>)>,
}

impl Gaunt {
    /// For products of functions of `bands` bands each.
    pub(crate) fn new(bands: usize) -> Self {
        let basis = Basis::<f64>::new(bands);
        // Degree 3 (bands − 1) in z at most, and 2 nodes − 1 is exact.
        let nodes = gauss_legendre(3 * bands / 2 + 1)
            .into_iter()
            .map(|(z, weight)| {
                let mut values = vec![0.0; count(bands)];
                basis.evaluate([((1.0 - z) * (1.0 + z)).sqrt(), 0.0, z], &mut values);
                (weight, values)
            })
            .collect();
        Self { nodes }
    }

    /// ∫ Y_i Y_j Y_k dω, `None` where symmetry makes it zero.
    pub(crate) fn integral(&self, indices: [usize; 3]) -> Option<f64> {
        let degrees = indices.map(|i| {
            let l = i.isqrt();
            (l, i as isize - (l * (l + 1)) as isize)
        });
        let [l1, l2, l3] = degrees.map(|(l, _)| l);
        let triangle = l1.abs_diff(l2) <= l3 && l3 <= l1 + l2;
        if !triangle || (l1 + l2 + l3) % 2 == 1 {
            return None;
        }
        let turn = turn_integral(degrees.map(|(_, m)| m));
        if turn == 0.0 {
            return None;
        }
        let [a, b, c] = degrees.map(|(l, m)| index(l, m.abs()));
        let sum: f64 = self.nodes.iter().map(|(weight, y)| weight * y[a] * y[b] * y[c]).sum();
        // Some vanish beyond these rules; they come out as rounding.
        (sum.abs() > 1e-14).then_some(turn * sum)
    }
}

/// ∫ over φ of three factors cos mφ (m ≥ 0) or sin |m|φ (m < 0).
fn turn_integral(m: [isize; 3]) -> f64 {
    let [a, b, c] = {
        let mut sorted = m;
        sorted.sort_unstable();
        sorted
    };
    let hits = |conditions: &[bool]| conditions.iter().filter(|&&hit| hit).count() as f64;
    match m.iter().filter(|&&m| m < 0).count() {
        0 => 0.5 * PI * hits(&[a + b == c, a + c == b, b + c == a, a + b + c == 0]),
        2 => {
            let (a, b) = (-a, -b);
            0.5 * PI * (hits(&[a + c == b, b + c == a]) - hits(&[a + b == c]))
        }
        _ => 0.0,
    }
}
