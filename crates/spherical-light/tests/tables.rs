//! The tabulated coefficients.

use std::f64::consts::PI;

use manylights_harmonics::zonal::{Cap, cap_stable};
use manylights_spherical_light::cap_table::CapTable;

/// Largest error of any band over all caps, over the largest coefficient of the cap.
fn worst(bands: usize) -> f64 {
    let table = CapTable::new(bands);
    let caps = (1..=20_000).map(|i| f64::from(i) / 20_000.0).chain([1e-4, 1e-8, 1e-12]);
    let errors = caps.map(|sine| {
        let cap = Cap { sine, cosine: ((1.0 - sine) * (1.0 + sine)).sqrt() };
        let mut truth = vec![0.0; bands];
        cap_stable(cap, &mut truth);
        let error = |(value, truth): (f64, &f64)| (value - truth).abs();
        let worst = table.scales(cap).into_iter().zip(&truth).map(error).fold(0.0, f64::max);
        // c_1 and, for small caps, all.
        worst / (PI * sine * sine)
    });
    errors.fold(0.0, f64::max)
}

/// What the head of `cap_table.rs` states.
#[test]
fn interpolation_errs_as_stated() {
    for (bands, stated) in [(5, 1.3e-6), (7, 7.2e-6), (9, 2.3e-5), (15, 2.1e-4)] {
        let worst = worst(bands);
        println!("{bands} bands: {worst:.2e}");
        assert!(worst <= stated && worst > 0.8 * stated, "{bands} bands: {worst:e}");
    }
}
