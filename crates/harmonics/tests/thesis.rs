//! The thesis' forms agree with the pole-free one away from the poles.

use manylights_harmonics::polygon::solid_angle;
use manylights_harmonics::thesis::{
    Polynomials, SphericalGradients, arvo, oosterom_of_units, to_cartesian,
};
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

/// What f32 leaves of a triangle's solid angle: relative errors at so many sizes, of the form in use and of
/// the two that are printed.
#[test]
fn printed_solid_angles_lose_their_digits_in_single_precision() {
    let at = |distance: f64, turn: f64| {
        let (sine, cosine) = turn.sin_cos();
        let turned = |x: f64, y: f64| {
            let [x, y] = [x * cosine - y * sine, x * sine + y * cosine];
            [0.5 * distance + x, 0.6 * distance + y, 0.62 * distance + 0.2 * x]
        };
        [turned(0.0, 0.0), turned(1.0, 0.1), turned(0.4, 0.9)]
    };
    for (distance, least, most) in [
        (1.0, [0.0, 0.0, 0.0], [1e-6, 1e-6, 1e-4]),
        (10.0, [0.0, 1e-7, 1e-5], [1e-6, 1e-3, 1e-1]),
        (100.0, [0.0, 1e-5, 1e-2], [1e-6, 1e-1, 1e2]),
        (1000.0, [0.0, 1e-3, 1.0], [1e-6, 1e2, 1e4]),
    ] {
        let worst = (0..100).fold([0.0_f64; 3], |worst, i| {
            let single = at(distance, f64::from(i) * 0.0628).map(|corner| corner.map(|c| c as f32));
            let double = single.map(|corner| corner.map(f64::from));
            let truth = solid_angle(&double);
            let found = [
                solid_angle(&single),
                oosterom_of_units(single),
                truth.signum() as f32 * arvo(single),
            ];
            let error = found.map(|value| (f64::from(value) / truth - 1.0).abs());
            [0, 1, 2].map(|form| worst[form].max(error[form]))
        });
        println!("{distance}: {worst:?}");
        for form in 0..3 {
            assert!((least[form]..most[form]).contains(&worst[form]), "{distance}: {worst:?}");
        }
    }
    let corners = at(2.0, 0.4);
    let truth = solid_angle(&corners).abs();
    for value in [oosterom_of_units(corners).abs(), arvo(corners)] {
        assert!((value - truth).abs() < 1e-13, "{value} for {truth}");
    }
}
