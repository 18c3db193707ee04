//! The weakest window that stops the ringing, on profiles and on the sphere.

use crate::common;
use crate::common::{coefficients, turn};
use manylights_harmonics::convolution::convolve;
use manylights_harmonics::dering::{Profile, Sphere};
use manylights_harmonics::rotation::Blocks;
use manylights_harmonics::window::Window;
use manylights_harmonics::zonal::{self, Cap};
use manylights_harmonics::{Basis, clamped_cosine, count};
use proptest::prelude::*;

/// A cap, and a delta function.
fn ringing(bands: usize, sine: f64) -> [Vec<f64>; 2] {
    let mut cap = vec![0.0; bands];
    zonal::cap_stable(Cap::of_sphere(sine, 1.0), &mut cap);
    [cap, vec![1.0; bands]]
}

/// The lowest of the windowed profile at 20 001 angles.
fn lowest(scales: &[f64], weights: &[f64]) -> f64 {
    let damped: Vec<f64> = scales.iter().zip(weights).map(|(c, w)| c * w).collect();
    let angles = (0..=20_000).map(|i| f64::from(i) * std::f64::consts::PI / 20_000.0);
    angles.map(|angle| zonal::evaluate(&damped, angle.cos())).fold(f64::INFINITY, f64::min)
}

fn about(scales: &[f64], direction: [f64; 3]) -> Vec<f64> {
    let basis = Basis::new(scales.len());
    let mut coefficients = vec![0.0; count(scales.len())];
    zonal::rotate(&basis, scales, direction, &mut coefficients);
    coefficients
}

#[test]
fn caps_and_deltas_ring_before_and_not_after_and_no_weaker_window_does() {
    for window in [Window::SincFourth, Window::Hann, Window::Lanczos] {
        for bands in [3, 5, 9, 20, 30] {
            let mut search = Profile::new(bands);
            let mut weights = vec![0.0; bands];
            for scales in ringing(bands, 0.3) {
                let ones = vec![1.0; bands];
                let tolerance = 1e-3 * zonal::evaluate(&scales, 1.0);
                assert!(lowest(&scales, &ones) < -5.0 * tolerance);
                let strength = search.search(window, &scales, tolerance, &mut weights);
                let strength = strength.expect("the mean is positive");
                let after = lowest(&scales, &weights);
                // The margin is rounding: tolerance 1e-3 of the largest value, so 1e-12 of it.
                assert!(after >= -tolerance * (1.0 + 1e-9), "{window:?}, {bands}: {after}");
                window.weights(1.0 / (strength - 1e-6), &mut weights);
                assert!(lowest(&scales, &weights) < -tolerance, "{window:?}, {bands}: {strength}");
            }
        }
    }
}

/// Between strengths 0.04 and 0.3 it rings again: halving the whole range would end there.
#[test]
fn the_weaker_of_two_windows_is_found() {
    let mut scales = [0.0; 20];
    clamped_cosine::scales(&mut scales);
    let (mut weights, mean) = ([0.0; 20], scales[0] / (4.0 * std::f64::consts::PI));
    let search = &mut Profile::new(20);
    let strength = search.search(Window::SincFourth, &scales, 0.01 * mean, &mut weights);
    assert!((0.01..0.03).contains(&strength.expect("the mean is positive")), "{strength:?}");
}

#[test]
fn what_does_not_ring_is_left_alone() {
    let scales = [1.0, 0.3, 0.05, 0.01];
    let mut weights = [0.0; 4];
    let strength = Profile::new(4).search(Window::SincFourth, &scales, 0.0, &mut weights);
    assert_eq!((strength, weights), (Some(0.0), [1.0; 4]));
    let function = about(&scales, [0.48, -0.6, 0.64]);
    let strength = Sphere::new(4).search(Window::SincFourth, &function, 0.0, &mut weights);
    assert_eq!((strength, weights), (Some(0.0), [1.0; 4]));
}

#[test]
fn a_negative_mean_and_what_is_no_number_have_no_window() {
    let mut weights = [0.0; 2];
    for scales in [[-2.0, 0.5], [1.0, f64::NAN], [f64::INFINITY, 1.0]] {
        let found = Profile::new(2).search(Window::SincFourth, &scales, 0.1, &mut weights);
        assert_eq!(found, None, "{scales:?}");
        let function = [scales[0], 0.0, scales[1], 0.0];
        let found = Sphere::new(2).search(Window::SincFourth, &function, 0.1, &mut weights);
        assert_eq!(found, None, "{scales:?}");
    }
}

#[test]
fn a_larger_tolerance_needs_no_stronger_window() {
    let mut search = Profile::new(9);
    let mut weights = [0.0; 9];
    for scales in ringing(9, 0.3) {
        let strengths = [0.0, 1e-4, 1e-3, 1e-2, 1e-1]
            .map(|tolerance| search.search(Window::SincFourth, &scales, tolerance, &mut weights));
        assert!(strengths.is_sorted_by(|weak, strong| weak >= strong), "{strengths:?}");
        assert!(strengths[0] > strengths[4], "{strengths:?}");
    }
}

#[test]
fn single_precision_finds_the_same_window() {
    let (mut single, mut double) = (Sphere::<f32>::new(9), Sphere::<f64>::new(9));
    let (mut weights32, mut weights) = ([0.0; 9], [0.0; 9]);
    for scales in ringing(9, 0.3) {
        let function = about(&scales, [0.48, -0.6, 0.64]);
        let rounded: Vec<f32> = function.iter().map(|&f| f as f32).collect();
        let tolerance = 1e-3 * zonal::evaluate(&scales, 1.0);
        let truth = double.search(Window::SincFourth, &function, tolerance, &mut weights);
        let found = single.search(Window::SincFourth, &rounded, tolerance as f32, &mut weights32);
        let (found, truth) = (found.expect("a window"), truth.expect("a window"));
        // Rounding of 1e-7 of the maximum in a minimum of 1e-3 of it.
        assert!((f64::from(found) - truth).abs() < 1e-4, "{found} {truth}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, ..ProptestConfig::default() })]

    /// The search on the sphere has no preferred direction, and is as exact as that on the profile.
    #[test]
    fn the_sphere_finds_what_the_profile_finds(
        axis in common::direction(),
        sine in 0.05..1.0_f64,
        bands in 2..=8_usize,
    ) {
        let (mut profile, mut sphere) = (Profile::new(bands), Sphere::new(bands));
        let mut weights = vec![0.0; bands];
        for scales in ringing(bands, sine) {
            let tolerance = 1e-3 * zonal::evaluate(&scales, 1.0);
            let truth = profile.search(Window::SincFourth, &scales, tolerance, &mut weights);
            let function = about(&scales, axis);
            let found = sphere.search(Window::SincFourth, &function, tolerance, &mut weights);
            let (truth, found) = (truth.expect("a window"), found.expect("a window"));
            prop_assert!((truth - found).abs() < 1e-6, "{truth} {found}");
        }
    }

    #[test]
    fn a_turned_function_has_the_same_window_and_does_not_ring(
        q in common::rotation(),
        directions in proptest::collection::vec(common::direction(), 200),
        bands in 2..=6_usize,
        seed in 0..100_usize,
    ) {
        let mut function = coefficients(count(bands), seed);
        function[0] = 2.0;
        let mut turned = function.clone();
        let mut blocks = Blocks::new(bands);
        blocks.set(q);
        blocks.apply(&function, &mut turned);
        let mut search = Sphere::new(bands);
        let mut weights = vec![0.0; bands];
        let found = search.search(Window::SincFourth, &turned, 0.01, &mut weights);
        let truth = search.search(Window::SincFourth, &function, 0.01, &mut weights);
        let (truth, found) = (truth.expect("a window"), found.expect("a window"));
        prop_assert!((truth - found).abs() < 1e-6, "{truth} {found}");
        convolve(&weights, &mut function);
        let basis = Basis::new(bands);
        let mut values = vec![0.0; count(bands)];
        for direction in directions {
            basis.evaluate(turn(&q, direction), &mut values);
            let value = common::dot(&values, &function);
            prop_assert!(value >= -0.01 * (1.0 + 1e-9), "{direction:?}: {value}");
        }
    }
}
