//! Tilts of hemispherical harmonics against projections of turned functions.

use crate::common;
use std::f64::consts::FRAC_PI_2;

use crate::hemisphere::{above, expand, project, pseudo_random};
use manylights_harmonics::hemispherical::{HemisphericalBasis, Overlap, TiltTable};
use manylights_harmonics::quadrature::gauss_legendre;
use manylights_harmonics::{Basis, Real, count, index};

#[test]
fn rotations_about_the_normal_are_exact() {
    let bands = 5;
    let table = TiltTable::<f64>::new(bands, Overlap::Mirrored, 0.5, 2);
    let given = pseudo_random(count(bands));
    let mut turned = vec![0.0; count(bands)];
    table.rotate([0.4, 0.0, 0.3], &mut given.clone(), &mut turned);
    let at = |phi: f64| above(bands, [0.6 * phi.cos(), 0.6 * phi.sin(), 0.8]);
    let sum = |h: Vec<f64>, c: &[f64]| h.iter().zip(c).map(|(h, c)| h * c).sum::<f64>();
    let difference = sum(at(1.0), &turned) - sum(at(0.3), &given);
    // R_y(0) is a quadrature, not a constant.
    assert!(difference.abs() < 1e-12, "{difference:e}");
}

/// Smooth radiance seen in a tilted frame: relative L2 errors of the coefficients.
fn tilt_error(overlap: Overlap, degrees: f64) -> f64 {
    let (bands, beta) = (7, degrees.to_radians());
    let smooth = Basis::new(5);
    let mut field: Vec<_> = (0..5)
        .flat_map(|l| vec![1.0 / (1.0 + l as f64).powi(2); 2 * l + 1])
        .zip(pseudo_random(25))
        .map(|(decay, c)| decay * c)
        .collect();
    // Radiance is positive.
    field[0] = 3.0;
    let basis = HemisphericalBasis::new(bands);
    let mut source = project(&basis, |d| expand(&smooth, &field, d));
    let (s, c) = beta.sin_cos();
    let tilted = |[x, y, z]: [f64; 3]| expand(&smooth, &field, [c * x - s * z, y, s * x + c * z]);
    let truth = project(&basis, tilted);
    let table = TiltTable::<f64>::new(bands, overlap, beta, 1);
    let mut result = vec![0.0; count(bands)];
    table.rotate([0.0, beta, 0.0], &mut source, &mut result);
    let norm = |v: &mut dyn Iterator<Item = f64>| v.map(|c| c * c).sum::<f64>().sqrt();
    norm(&mut result.iter().zip(&truth).map(|(a, b)| a - b)) / norm(&mut truth.iter().copied())
}

#[test]
fn the_mirrored_table_loses_less() {
    for degrees in [5.0, 10.0, 20.0] {
        let (exact, mirrored) =
            (tilt_error(Overlap::Exact, degrees), tilt_error(Overlap::Mirrored, degrees));
        println!("{degrees}: exact {exact:.3}, mirrored {mirrored:.3}");
        assert!(mirrored < 0.1 * exact, "{degrees}: exact {exact:.3}, mirrored {mirrored:.3}");
        if degrees == 10.0 {
            // What the documentation of `Overlap` tells, to its digits.
            assert!((exact - 0.20).abs() <= 0.005 && (mirrored - 0.005).abs() <= 0.0005);
        }
    }
}

/// A polynomial that HSH of 7 bands hold and that is even in z, so that mirroring continues it. What
/// they hold at m is (z/(1 + z))^(m/2) Re, Im (x + iy)^m times polynomials in z of degree 6 − m: so
/// z² at m = 2 and at m = 4 is among it.
fn held([x, y, z]: [f64; 3]) -> f64 {
    let (cosine, sine) = (x * x - y * y, 2.0 * x * y);
    0.7 + z * z * (1.0 - 0.4 * z * z + cosine + 0.3 * sine - 0.8 * cosine * sine)
}

/// `held` by a table, and what it is off by from the turned function's own projection.
fn turned_error<R: Real>(angles: [f64; 3], largest: f64, steps: usize) -> f64 {
    let basis = HemisphericalBasis::new(7);
    let mut source: Vec<_> = project(&basis, held).into_iter().map(R::of).collect();
    let mut turned = source.clone();
    let table = TiltTable::<R>::new(7, Overlap::Mirrored, largest, steps);
    table.rotate(angles.map(R::of), &mut source, &mut turned);
    let [alpha, beta, gamma] = angles;
    // Q⁻¹ = R_z(−γ) R_y(−β) R_z(−α).
    let [first, second, third] = [
        common::about([0.0, 0.0, 1.0], -alpha),
        common::about([0.0, 1.0, 0.0], -beta),
        common::about([0.0, 0.0, 1.0], -gamma),
    ];
    let truth = project(&basis, |direction| {
        held(common::turn(&third, common::turn(&second, common::turn(&first, direction))))
    });
    let turned: Vec<_> = turned.into_iter().map(Real::to_f64).collect();
    common::difference(&turned, &truth)
}

#[test]
fn what_mirroring_continues_turns_exactly() {
    for beta in [0.2, 0.9, FRAC_PI_2] {
        let error = turned_error::<f64>([0.4, beta, -1.3], beta, 1);
        println!("{beta}: {error:.1e}");
        assert!(error < 1e-12, "{beta}: {error:e}");
    }
    // Between two tilts Δ apart the matrix is off by Δ²/8 of its second derivative.
    let [coarse, fine] = [4, 8].map(|steps| turned_error::<f64>([0.4, 0.35, -1.3], 0.8, steps));
    println!("between tilts: {coarse:.1e} {fine:.1e}");
    assert!(fine < 5e-3 && fine < 0.5 * coarse, "{coarse:e} {fine:e}");
}

/// The largest tilt as the scalar has it, which may round above or below the one given.
#[test]
fn the_largest_tilt_is_in_the_table_in_both_precisions() {
    for largest in [0.1, 0.3, 0.7, 1.0, FRAC_PI_2] {
        let error = turned_error::<f32>([0.4, largest, -1.3], largest, 2);
        // 49 products of f32.
        assert!(error < 2e-6, "{largest}: {error:e}");
    }
}

/// A quarter turn leaves the source where x > 0: against Gauss–Legendre nodes there.
#[test]
fn the_exact_overlap_of_a_quarter_turn_is_that_of_the_quadrant() {
    let (bands, quarter) = (5, FRAC_PI_2);
    // Polynomials in the source's z alone: m = 0.
    let mut source = pseudo_random(count(bands));
    let zonal = |i: usize| i == index(i.isqrt(), 0);
    source.iter_mut().enumerate().filter(|(i, _)| !zonal(*i)).for_each(|(_, c)| *c = 0.0);
    let mut truth = vec![0.0; count(bands)];
    for (node, weight) in gauss_legendre(40) {
        // Elevation (π/2) u²: √z and r are analytic in u.
        let u = 0.5 * (1.0 + node);
        let (z, r) = (quarter * u * u).sin_cos();
        for (angle, angle_weight) in gauss_legendre(40) {
            let (s, c) = (quarter * angle).sin_cos();
            let h = above(bands, [-z, r * s, r * c]);
            let seen = common::dot(&h, &source);
            let area = weight * quarter * u * r * quarter * angle_weight;
            for (sum, h) in truth.iter_mut().zip(above(bands, [r * c, r * s, z])) {
                *sum += area * h * seen;
            }
        }
    }
    let mut turned = vec![0.0; count(bands)];
    let table = TiltTable::<f64>::new(bands, Overlap::Exact, quarter, 1);
    table.rotate([0.0, quarter, 0.0], &mut source, &mut turned);
    let error = common::difference(&turned, &truth);
    println!("quadrant: {error:.1e}");
    assert!(error < 1e-12, "{error:e}");
}

#[test]
#[should_panic(expected = "is not in the table")]
fn a_tilt_beyond_the_table_panics() {
    let table = TiltTable::<f32>::new(1, Overlap::Exact, 0.1, 1);
    table.rotate([0.0, 0.1001, 0.0], &mut [1.0], &mut [0.0]);
}

#[test]
#[should_panic(expected = "is not in 0 … π/2")]
fn a_table_of_no_tilt_panics() {
    TiltTable::<f64>::new(1, Overlap::Exact, 0.0, 1);
}
