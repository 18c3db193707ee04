//! What single precision leaves of each cap form, r/d from 1 to 1e-6, up to 30 bands.

use manylights_harmonics::MAX_BANDS;
use manylights_harmonics::zonal::{self, Cap, Sighting};

/// Ratios r/d, 200 a decade, with values just below 1.
fn ratios() -> impl Iterator<Item = f32> {
    let grazing = [1.0, 0.999_999_9, 0.999_999, 0.999_9, 0.999];
    let decades = (0..=1200).map(|i| 10.0_f32.powf(-i as f32 / 200.0));
    grazing.into_iter().chain(decades)
}

/// The largest error over the largest true value; ∞ where the form gives no number.
fn error(form: &[f32], truth: &[f64]) -> f64 {
    let largest = truth.iter().fold(0.0_f64, |most, value| value.abs().max(most));
    let errors = form.iter().zip(truth).map(|(&value, truth)| (f64::from(value) - truth).abs());
    errors.fold(0.0, |most, error| if error.is_finite() { error.max(most) } else { f64::INFINITY })
        / largest
}

/// The error of a cap form on `bands` bands.
fn cap_error(form: fn(Cap<f32>, &mut [f32]), bands: usize, ratio: f32) -> f64 {
    let (mut scales, mut truth) = (vec![0.0; bands], vec![0.0; bands]);
    form(Cap::of_sphere(ratio, 1.0), &mut scales);
    zonal::cap_stable(Cap::of_sphere(f64::from(ratio), 1.0), &mut truth);
    error(&scales, &truth)
}

/// The error of a rate form.
fn rate_error(form: fn(Cap<f32>, f32, &mut [f32]), bands: usize, ratio: f32) -> f64 {
    let (mut rates, mut truth) = (vec![0.0; bands], vec![0.0; bands]);
    let single = Sighting::of_sphere([0.0, 0.0, 1.0], ratio).expect("a direction");
    let double = Sighting::of_sphere([0.0, 0.0, 1.0], f64::from(ratio)).expect("a direction");
    form(single.cap, single.cosine_rate, &mut rates);
    zonal::cap_rate_stable(double.cap, double.cosine_rate, &mut truth);
    error(&rates, &truth)
}

#[test]
fn stable_scales_keep_their_digits() {
    let worst = ratios().map(|ratio| cap_error(zonal::cap_stable, MAX_BANDS, ratio));
    let worst = worst.fold(0.0, f64::max);
    println!("worst error of stable scales {worst:.2e}");
    assert!(worst <= 1e-6, "{worst}");
}

#[test]
fn stable_rates_keep_their_digits() {
    let ratios = ratios().filter(|&ratio| ratio < 1.0);
    let worst = ratios.map(|ratio| rate_error(zonal::cap_rate_stable, MAX_BANDS, ratio));
    let worst = worst.fold(0.0, f64::max);
    println!("worst error of stable rates {worst:.2e}");
    assert!(worst <= 2e-6, "{worst}");
}

/// c_l by the three-term recurrence in α: exact, but α near one has lost the digits of the cap.
fn three_term(cap: Cap<f32>, scales: &mut [f32]) {
    let square = cap.sine * cap.sine;
    scales[0] = std::f32::consts::TAU * square / (1.0 + cap.cosine);
    let (mut before, mut slope) = (0.0, 1.0);
    for (l, scale) in scales.iter_mut().enumerate().skip(1) {
        let order = l as f32;
        *scale = std::f32::consts::TAU * square * slope / (order * (order + 1.0));
        let after = ((2.0 * order + 1.0) * cap.cosine * slope - (order + 1.0) * before) / order;
        (before, slope) = (slope, after);
    }
}

#[test]
fn the_papers_forms_lose_theirs() {
    for (form, bands) in [(zonal::cap_thesis as fn(_, &mut [f32]), 10), (zonal::cap_sloan, 10)] {
        let [wide, small, tiny] = [0.5, 1e-3, 1e-4].map(|ratio| cap_error(form, bands, ratio));
        println!("papers' scales: {wide:.1e} {small:.1e} {tiny:.1e}");
        assert!(wide < 2e-6 && small > 1e-2 && tiny > 0.5, "{wide} {small} {tiny}");
    }
    let [wide, small, tiny] =
        [0.5, 1e-3, 1e-4].map(|ratio| rate_error(zonal::cap_rate_thesis, 10, ratio));
    println!("thesis' rates: {wide:.1e} {small:.1e} {tiny:.1e}");
    assert!(wide < 2e-6 && small > 1e-2 && tiny.is_infinite(), "{wide} {small} {tiny}");
    let worst = ratios().map(|ratio| cap_error(three_term, MAX_BANDS, ratio));
    let worst = worst.fold(0.0, f64::max);
    println!("worst error of the three-term recurrence {worst:.2e}");
    assert!(worst > 1e-5, "{worst}");
}
