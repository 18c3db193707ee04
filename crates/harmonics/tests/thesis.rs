//! The thesis' forms agree with the pole-free one away from the poles.

use manylights_harmonics::thesis::{Polynomials, SphericalGradients, to_cartesian};
use manylights_harmonics::{Basis, MAX_BANDS, count};
use proptest::prelude::*;

fn truth(bands: usize, p: [f64; 3]) -> [Vec<f64>; 4] {
    let mut found: [Vec<f64>; 4] = std::array::from_fn(|_| vec![0.0; count(bands)]);
    let [value, x, y, z] = &mut found;
    Basis::new(bands).evaluate_with_gradient(p, value, [x, y, z]);
    found
}

fn close(
    found: &[Vec<f64>; 4],
    truth: &[Vec<f64>; 4],
    tolerance: f64,
) -> Result<(), TestCaseError> {
    for (found, truth) in found.iter().flatten().zip(truth.iter().flatten()) {
        prop_assert!((found - truth).abs() < tolerance, "{found} {truth}");
    }
    Ok(())
}

proptest! {
    // |z| ≤ 0.99: these forms divide by sin θ.
    #[test]
    fn spherical_gradients(z in -0.99..0.99_f64, angle in 0.0..std::f64::consts::TAU, bands in 1..=MAX_BANDS) {
        let radius = (1.0 - z * z).sqrt();
        let p = [radius * angle.cos(), radius * angle.sin(), z];
        let tables = SphericalGradients::<f64>::new(bands);
        for form in [SphericalGradients::direct, SphericalGradients::sloans_like] {
            let mut found: [Vec<f64>; 4] = std::array::from_fn(|_| vec![0.0; count(bands)]);
            let (mut theta, mut phi) = (vec![0.0; count(bands)], vec![0.0; count(bands)]);
            form(&tables, p, &mut found[0], &mut theta, &mut phi);
            let [_, x, y, z] = &mut found;
            to_cartesian(p, &theta, &phi, [x, y, z]);
            // Gradients reach 90, and 1/sin² θ = 50 multiplies their rounding.
            close(&found, &truth(bands, p), 1e-11)?;
        }
    }

    #[test]
    fn polynomials(z in -1.0..1.0_f64, angle in 0.0..std::f64::consts::TAU, bands in 1..=10_usize) {
        let radius = (1.0 - z * z).sqrt();
        let p = [radius * angle.cos(), radius * angle.sin(), z];
        let form = Polynomials::<f64>::new(bands);
        let mut found: [Vec<f64>; 4] = std::array::from_fn(|_| vec![0.0; count(bands)]);
        let [value, x, y, z] = &mut found;
        form.evaluate(p, value);
        form.gradient(p, [x, y, z]);
        // Monomials of band 9 cancel from about 1e3.
        close(&found, &truth(bands, p), 1e-11)?;
    }
}
