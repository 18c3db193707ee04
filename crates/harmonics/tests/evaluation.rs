//! Values and gradients against truth: derivatives, addition theorem, poles.

use crate::common::{evaluate, limits};
use manylights_harmonics::{Basis, MAX_BANDS, count, index};
use proptest::prelude::*;

fn values(basis: &Basis<f64>, p: [f64; 3]) -> Vec<f64> {
    let length = p.iter().map(|c| c * c).sum::<f64>().sqrt();
    let mut values = vec![0.0; count(basis.bands())];
    basis.evaluate(p.map(|c| c / length), &mut values);
    values
}

/// Random unit vectors, and some on and beside the axes.
fn directions() -> impl Strategy<Value = [f64; 3]> {
    let random = (-1.0..1.0_f64, 0.0..std::f64::consts::TAU).prop_map(|(z, angle)| {
        let radius = (1.0 - z * z).sqrt();
        [radius * angle.cos(), radius * angle.sin(), z]
    });
    let beside = (0..3_usize, any::<bool>(), -12.0..0.0_f64, 0.0..std::f64::consts::TAU).prop_map(
        |(axis, negative, exponent, angle)| {
            let sine = 0.5 * 10.0_f64.powf(exponent);
            let mut p = [0.0; 3];
            p[axis] = (1.0 - sine * sine).sqrt() * if negative { -1.0 } else { 1.0 };
            p[(axis + 1) % 3] = sine * angle.cos();
            p[(axis + 2) % 3] = sine * angle.sin();
            p
        },
    );
    prop_oneof![random, beside]
}

/// Eighth-order central difference of Y(p/|p|) along an axis.
fn difference(basis: &Basis<f64>, p: [f64; 3], axis: usize) -> Vec<f64> {
    let h = 5e-3;
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let mut sum = vec![0.0; count(basis.bands())];
    for (k, weight) in weights.iter().enumerate() {
        for sign in [1.0, -1.0] {
            let mut q = p;
            q[axis] += sign * (k + 1) as f64 * h;
            for (sum, value) in sum.iter_mut().zip(values(basis, q)) {
                *sum += sign * weight * value / h;
            }
        }
    }
    sum
}

proptest! {
    #[test]
    fn gradient_is_the_difference(p in directions(), bands in 1..=6_usize) {
        let basis = Basis::<f64>::new(bands);
        let found = evaluate(&basis, p);
        for axis in 0..3 {
            for (found, truth) in found.iter().zip(difference(&basis, p, axis)) {
                // The truncation h⁸ l⁹/630 and the rounding ε/h are below 1e-12 in 6 bands.
                prop_assert!((found[axis + 1] - truth).abs() < 1e-12, "{axis}: {found:?} {truth}");
            }
        }
    }

    #[test]
    fn addition_theorem(p in directions(), q in directions()) {
        let basis = Basis::<f64>::new(MAX_BANDS);
        let (at_p, at_q) = (evaluate(&basis, p), evaluate(&basis, q));
        let cosine = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
        let (mut before, mut legendre) = (0.0, 1.0);
        for l in 0..MAX_BANDS {
            let band = index(l, 0) - l..=index(l, 0) + l;
            let factor = (2 * l + 1) as f64 / (4.0 * std::f64::consts::PI);
            let sum: f64 = band.clone().map(|i| at_p[i][0] * at_q[i][0]).sum();
            // ε times the slope l(l + 1)/2 of P_l: unit vectors are rounded too.
            prop_assert!((sum / factor - legendre).abs() < 1e-12, "band {l}: {sum}");
            let slopes: f64 = band.map(|i| (1..4).map(|c| at_p[i][c].powi(2)).sum::<f64>()).sum();
            let truth = factor * (l * (l + 1)) as f64;
            prop_assert!((slopes - truth).abs() <= 1e-12 * truth, "band {l}: {slopes}");
            let next = l as f64 + 1.0;
            (before, legendre) =
                (legendre, ((2.0 * next - 1.0) * cosine * legendre - (next - 1.0) * before) / next);
        }
    }

    #[test]
    fn single_precision_is_right_at_every_direction(p in directions()) {
        let rounded = p.map(|c| c as f32);
        let found = evaluate(&Basis::<f32>::new(MAX_BANDS), rounded);
        let truth = evaluate(&Basis::<f64>::new(MAX_BANDS), rounded.map(f64::from));
        for l in 0..MAX_BANDS {
            for i in index(l, 0) - l..=index(l, 0) + l {
                for (c, limit) in limits(l).into_iter().enumerate() {
                    let error = (found[i][c] - truth[i][c]).abs();
                    prop_assert!(error <= 1e-5 * limit, "l {l}, {i}, {c}: {error} of {limit}");
                }
            }
        }
    }

    #[test]
    fn gradient_is_tangential(p in directions()) {
        for [_, x, y, z] in evaluate(&Basis::<f64>::new(MAX_BANDS), p) {
            // Gradients are up to 90 here.
            prop_assert!((p[0] * x + p[1] * y + p[2] * z).abs() < 1e-12);
        }
    }
}

#[test]
fn a_point_whose_square_is_no_normal_number_panics() {
    let basis = Basis::<f32>::new(2);
    let gradient_at = |length: f32| {
        let (mut values, mut gradients) = ([0.0; 4], [[0.0; 4]; 3]);
        let slices = gradients.each_mut().map(|axis| &mut axis[..]);
        basis.evaluate_with_gradient_at([0.6 * length, 0.0, -0.8 * length], &mut values, slices);
        gradients[2][index(1, 0)] * length
    };
    for length in [0.0, 1e-20, 1e20, f32::NAN] {
        assert!(std::panic::catch_unwind(|| gradient_at(length)).is_err(), "{length}");
    }
    // ∂z of √(3/4π) z/|p| is √(3/4π) (x² + y²)/|p|³.
    let truth = (0.75 / std::f32::consts::PI).sqrt() * 0.36;
    for length in [1e-18, 1.0, 1e18] {
        let error = (gradient_at(length) - truth).abs();
        assert!(error < 1e-6 * truth, "{length}: {error:e}");
    }
}
