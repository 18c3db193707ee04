//! Hemispherical harmonics against quadrature and against their definition.

use std::f64::consts::TAU;

use crate::hemisphere::{above, expand, graded, project, pseudo_random};
use manylights_harmonics::hemispherical::{HemisphericalBasis, Transfer};
use manylights_harmonics::projection::scalar_product;
use manylights_harmonics::quadrature::sphere_nodes;
use manylights_harmonics::{Basis, count, index};
use proptest::prelude::*;

#[test]
fn they_are_orthonormal() {
    let bands = 10;
    let mut gram = vec![0.0; count(bands).pow(2)];
    for (direction, weight) in sphere_nodes(bands + 1, [0.0, 1.0]) {
        let h = above(bands, direction);
        for (i, row) in gram.chunks_mut(count(bands)).enumerate() {
            for (entry, value) in row.iter_mut().zip(&h) {
                *entry += weight * h[i] * value;
            }
        }
    }
    for (at, entry) in gram.iter().enumerate() {
        let expected = f64::from(u8::from(at % count(bands) == at / count(bands)));
        assert!((entry - expected).abs() < 1e-12, "{at}: {entry}");
    }
}

/// P_l^m without the Condon–Shortley phase, by the textbook recurrence.
fn legendre(l: usize, m: usize, x: f64) -> f64 {
    let mut value = (1..=m).map(|k| (2 * k - 1) as f64 * (1.0 - x * x).sqrt()).product::<f64>();
    let mut before = 0.0;
    for degree in m + 1..=l {
        let (n, m) = (degree as f64, m as f64);
        (before, value) = (value, ((2.0 * n - 1.0) * x * value - (n + m - 1.0) * before) / (n - m));
    }
    value
}

/// Thesis 2.33 with the mended m = 0.
fn definition(l: usize, m: isize, theta: f64, phi: f64) -> f64 {
    let order = m.unsigned_abs();
    let ratio: f64 = (l - order + 1..=l + order).map(|k| 1.0 / k as f64).product();
    let norm = ((2 * l + 1) as f64 / TAU * ratio).sqrt();
    let p = norm * legendre(l, order, 2.0 * theta.cos() - 1.0);
    let angle = order as f64 * phi;
    match m {
        0 => p,
        1.. => 2.0_f64.sqrt() * p * angle.cos(),
        _ => 2.0_f64.sqrt() * p * angle.sin(),
    }
}

proptest! {
    #[test]
    fn they_are_those_of_the_papers(theta in 0.0..1.57_f64, phi in 0.0..TAU) {
        let bands = 8;
        let direction = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
        let h = above(bands, direction);
        for l in 0..bands {
            for m in -(l as isize)..=l as isize {
                let expected = definition(l, m, theta, phi);
                // √z of a rounded cosine near the horizon costs three digits.
                prop_assert!((h[index(l, m)] - expected).abs() < 1e-11, "{l}, {m}");
            }
        }
    }
}

/// Against differences of order 8, which are good to 1e-10 at this step; the normal included.
#[test]
fn gradients_are_those_of_the_values() {
    let (bands, step) = (6, 2e-3);
    let basis = HemisphericalBasis::<f64>::new(bands);
    for direction in [[0.0, 0.0, 1.0], [1e-9, 0.0, 1.0], [0.6, 0.0, 0.8], [-0.48, 0.64, 0.6]] {
        let mut values = vec![0.0; count(bands)];
        let mut gradients = [0; 3].map(|_| vec![0.0; count(bands)]);
        let slices = gradients.each_mut().map(|axis| &mut axis[..]);
        basis.evaluate_with_gradient(direction, &mut values, slices);
        assert_eq!(values, above(bands, direction));
        for (axis, gradient) in gradients.iter().enumerate() {
            let mut slope = vec![0.0; count(bands)];
            for (steps, weight) in [(1, 0.8), (2, -0.2), (3, 4.0 / 105.0), (4, -1.0 / 280.0)] {
                for sign in [1.0, -1.0] {
                    let mut p = direction;
                    p[axis] += sign * f64::from(steps) * step;
                    let length = p.iter().map(|c| c * c).sum::<f64>().sqrt();
                    for (slope, h) in slope.iter_mut().zip(above(bands, p.map(|c| c / length))) {
                        *slope += sign * weight * h / step;
                    }
                }
            }
            for (given, difference) in gradient.iter().zip(&slope) {
                assert!((given - difference).abs() < 1e-9, "{direction:?} {given} {difference}");
            }
        }
    }
}

#[test]
fn only_m_0_is_left_at_the_horizon() {
    let h = above(6, [0.6, -0.8, 0.0]);
    for l in 0..6 {
        for m in -(l as isize)..=l as isize {
            assert_eq!(h[index(l, m)] == 0.0, m != 0);
        }
    }
}

#[test]
fn transfer_is_the_projection_in_both_ways() {
    let (hemispherical, spherical) = (6, 5);
    let transfer = Transfer::<f64>::new(hemispherical, spherical);
    let (h_basis, y_basis) = (HemisphericalBasis::new(hemispherical), Basis::new(spherical));
    let given = pseudo_random(count(spherical));
    let mut result = vec![0.0; count(hemispherical)];
    transfer.to_hemispherical(&given, &mut result);
    let truth = project(&h_basis, |direction| expand(&y_basis, &given, direction));
    assert!(result.iter().zip(&truth).all(|(a, b)| (a - b).abs() < 1e-12));

    let given = pseudo_random(count(hemispherical));
    let mut result = vec![0.0; count(spherical)];
    let (mut truth, mut scratch) = (result.clone(), result.clone());
    transfer.to_spherical(&given, &mut result);
    let f =
        |direction| above(hemispherical, direction).iter().zip(&given).map(|(h, c)| h * c).sum();
    let evaluate = |d, values: &mut [f64]| y_basis.evaluate(d, values);
    scalar_product(graded(40), evaluate, f, &mut scratch, &mut truth);
    assert!(result.iter().zip(&truth).all(|(a, b)| (a - b).abs() < 1e-12));
}
