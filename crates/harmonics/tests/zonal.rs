//! Zonal functions against quadrature and differences, in f64.

use crate::common;
use crate::common::{derivative, difference, dot, turn};
use manylights_harmonics::zonal::{self, Cap, Sighting};
use manylights_harmonics::{Basis, MAX_BANDS, count, index, quadrature};
use proptest::prelude::*;

type Form = fn(Cap<f64>, &mut [f64]);
type RateForm = fn(Cap<f64>, f64, &mut [f64]);

/// ∫ of P_l over the cap, by Gauss–Legendre nodes enough for every band.
fn scales_by_quadrature(cap: Cap<f64>, bands: usize) -> Vec<f64> {
    let basis = Basis::<f64>::new(bands);
    let mut values = vec![0.0; count(bands)];
    let mut sums = vec![0.0; bands];
    for l in 0..bands {
        let norm = (4.0 * std::f64::consts::PI / (2 * l + 1) as f64).sqrt();
        sums[l] = norm
            * quadrature::sphere(bands, [cap.cosine, 1.0], |direction| {
                basis.evaluate(direction, &mut values);
                values[index(l, 0)]
            });
    }
    sums
}

#[test]
fn every_cap_form_is_the_integral_over_the_cap() {
    let forms: [(Form, usize); 3] = [
        (zonal::cap_sloan, zonal::CLOSED_FORM_BANDS),
        (zonal::cap_thesis, MAX_BANDS),
        (zonal::cap_stable, MAX_BANDS),
    ];
    for ratio in [1.0, 0.9, 0.5, 0.1, 0.01] {
        let cap = Cap::of_sphere(ratio, 1.0);
        let truth = scales_by_quadrature(cap, MAX_BANDS);
        for (form, bands) in forms {
            for bands in 1..=bands {
                let mut scales = vec![0.0; bands];
                form(cap, &mut scales);
                let error = difference(&scales, &truth[..bands]);
                assert!(error < 1e-12, "{ratio}, {bands} bands: {error}");
            }
        }
    }
}

#[test]
fn every_rate_form_is_the_derivative_of_the_scales() {
    let forms: [(RateForm, usize); 3] = [
        (zonal::cap_rate_sloan, zonal::CLOSED_FORM_BANDS),
        (zonal::cap_rate_thesis, MAX_BANDS),
        (zonal::cap_rate_stable, MAX_BANDS),
    ];
    type See = fn([f64; 3], f64) -> Option<Sighting<f64>>;
    let mut worst = 0.0_f64;
    for see in [Sighting::of_sphere as See, Sighting::of_disk] {
        for distance in [1.2, 2.0, 7.0] {
            let at = |distance: f64| see([0.0, 0.0, distance], 1.0).expect("a direction");
            let sighting = at(distance);
            for (form, bands) in forms {
                let mut rates = vec![0.0; bands];
                form(sighting.cap, sighting.cosine_rate, &mut rates);
                for (l, &rate) in rates.iter().enumerate() {
                    let mut scales = vec![0.0; bands];
                    let slope = derivative(distance, 0.02, |distance| {
                        zonal::cap_stable(at(distance).cap, &mut scales);
                        scales[l]
                    });
                    worst = worst.max((rate - slope).abs());
                }
            }
        }
    }
    // Extrapolated differences are good to some 1e-12 here.
    println!("worst rate {worst:.1e}");
    assert!(worst < 1e-11, "{worst:e}");
}

#[test]
fn a_light_that_holds_the_point_is_the_whole_hemisphere_and_the_edge_is_continuous() {
    let bands = MAX_BANDS;
    let mut inside = vec![0.0; bands];
    let offset = [0.0, 0.3, 0.4];
    let sighting = Sighting::of_sphere(offset, 0.6).expect("a direction");
    assert_eq!(sighting.cap, Cap { sine: 1.0, cosine: 0.0 });
    assert_eq!(sighting.cosine_rate, 0.0);
    zonal::cap_stable(sighting.cap, &mut inside);
    let hemisphere = scales_by_quadrature(sighting.cap, bands);
    assert!(difference(&inside, &hemisphere) < 1e-12);
    let mut outside = vec![0.0; bands];
    let edge = Sighting::of_sphere(offset, 0.5 * (1.0 - 1e-14)).expect("a direction");
    zonal::cap_stable(edge.cap, &mut outside);
    assert!(edge.cosine_rate.is_finite());
    // The cap's edge opens with the root of the gap: α = √(2e-14).
    assert!(difference(&inside, &outside) < 2.0 * std::f64::consts::PI * 1.5e-7);
    assert_eq!(Sighting::of_sphere([0.0; 3], 1.0), None);
    for [none, some] in [[1e-20_f32, 1e-18], [1e20, 1e18]] {
        assert_eq!(Sighting::of_sphere([0.0, none, 0.0], 1.0), None);
        assert!(Sighting::of_sphere([0.0, some, 0.0], 1.0).is_some());
    }
    assert_eq!(Sighting::of_disk([f64::NAN, 0.0, 1.0], 1.0), None);
    assert_eq!(Sighting::of_disk([1.0, 0.0, 1.0], f64::INFINITY), None);
}

#[test]
fn scales_from_coefficients_of_a_polynomial() {
    // z² = 2√π/3 Y_00 + (4/3)√(π/5) Y_20.
    let pi = std::f64::consts::PI;
    let mut scales = [2.0 * pi.sqrt() / 3.0, 0.0, 4.0 / 3.0 * (pi / 5.0).sqrt()];
    zonal::from_coefficients(&mut scales);
    for z in [-1.0, -0.2, 0.7] {
        assert!((zonal::evaluate(&scales, z) - z * z).abs() < 1e-15);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    #[test]
    fn a_turned_cap_is_the_integral_over_the_turned_cap(
        q in common::rotation(),
        sine in 0.01..1.0_f64,
        bands in 1..9_usize,
    ) {
        let basis = Basis::<f64>::new(bands);
        let cap = Cap { sine, cosine: ((1.0 - sine) * (1.0 + sine)).sqrt() };
        let [mut scales, mut coefficients] = [vec![0.0; bands], vec![0.0; count(bands)]];
        zonal::cap_stable(cap, &mut scales);
        zonal::rotate(&basis, &scales, turn(&q, [0.0, 0.0, 1.0]), &mut coefficients);
        let mut values = vec![0.0; count(bands)];
        for (i, &coefficient) in coefficients.iter().enumerate() {
            let truth = quadrature::sphere(bands, [cap.cosine, 1.0], |direction| {
                basis.evaluate(turn(&q, direction), &mut values);
                values[i]
            });
            prop_assert!((coefficient - truth).abs() < 1e-12, "{i}: {coefficient} {truth}");
        }
    }

    #[test]
    fn the_short_sums_are_the_long_ones(
        a in common::direction(),
        b in common::direction(),
        sines in [0.01..1.0_f64, 0.01..1.0_f64],
        bands in 1..=MAX_BANDS,
    ) {
        let basis = Basis::<f64>::new(bands);
        let [f, g] = sines.map(|sine| {
            let mut scales = vec![0.0; bands];
            zonal::cap_stable(Cap::of_sphere(sine, 1.0), &mut scales);
            scales
        });
        let [mut about_a, mut about_b] = [vec![0.0; count(bands)], vec![0.0; count(bands)]];
        zonal::rotate(&basis, &f, a, &mut about_a);
        zonal::rotate(&basis, &g, b, &mut about_b);
        let cosine = dot(&a, &b);
        let short = zonal::dot(&f, &g, cosine);
        prop_assert!((short - dot(&about_a, &about_b)).abs() < 1e-12);
        let mut values = vec![0.0; count(bands)];
        basis.evaluate(b, &mut values);
        prop_assert!((zonal::evaluate(&f, cosine) - dot(&about_a, &values)).abs() < 1e-12);
    }
}
