//! Windows fall from one, and Hann's at the width of the expansion damps a cap's ringing.

use manylights_harmonics::window::Window;
use manylights_harmonics::zonal::{self, Cap};

#[test]
fn weights_fall_from_one_to_the_value_at_the_width() {
    for (window, last) in Window::ALL.into_iter().zip([0.0, 0.0, 0.08, 0.0]) {
        let mut weights = [0.0; 30];
        window.weights(20.0, &mut weights);
        assert_eq!(weights[0], 1.0, "{window:?}");
        assert!(weights[..20].windows(2).all(|pair| pair[0] > pair[1]), "{window:?}: {weights:?}");
        assert!(weights[20..].iter().all(|&weight| weight == 0.0), "{window:?}");
        // Just inside the width, where each formula ends.
        let end: f64 = window.weight(20, 20.0 * (1.0 + 1e-12));
        assert!((end - last).abs() < 1e-9, "{window:?}: {end}");
    }
    // Halfway: 1/2, 2/π, 0.54, (2/π)⁴.
    let half = Window::ALL.map(|window| window.weight(5, 10.0_f64));
    let sinc = std::f64::consts::FRAC_2_PI;
    for (weight, truth) in half.iter().zip([0.5, sinc, 0.54, sinc.powi(4)]) {
        assert!((weight - truth).abs() < 1e-15);
    }
}

#[test]
fn hann_at_the_number_of_bands_damps_the_ringing_of_a_cap() {
    let bands = 8;
    let lowest = |scales: &[f64]| {
        (0..=200).map(|i| zonal::evaluate(scales, f64::from(i) / 100.0 - 1.0)).fold(1.0, f64::min)
    };
    let mut scales = vec![0.0; bands];
    zonal::cap_stable(Cap::of_sphere(0.6, 1.0), &mut scales);
    let before = lowest(&scales);
    assert!(before < -0.05, "{before}");
    let mut weights = vec![0.0; bands];
    Window::Hann.weights(bands as f64, &mut weights);
    scales.iter_mut().zip(&weights).for_each(|(scale, weight)| *scale *= weight);
    // A window that ignores the function leaves some: what is left is for de-ringing.
    let after = lowest(&scales);
    assert!(after < 0.0 && after > 0.2 * before, "{before} {after}");
}
