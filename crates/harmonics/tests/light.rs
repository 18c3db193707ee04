//! Gradients of the coefficients of a light as the point moves: against differences, and in f32.

use crate::common;
use crate::common::derivative;
use manylights_harmonics::zonal::{self, Sighting};
use manylights_harmonics::{Basis, MAX_BANDS, Real, count};

type See<R> = fn([R; 3], R) -> Option<Sighting<R>>;

/// Coefficients of a light.
fn coefficients<R: Real>(basis: &Basis<R>, sighting: Sighting<R>) -> Vec<R> {
    let mut scales = vec![R::zero(); basis.bands()];
    let mut coefficients = vec![R::zero(); count(basis.bands())];
    zonal::cap_stable(sighting.cap, &mut scales);
    zonal::rotate(basis, &scales, sighting.direction, &mut coefficients);
    coefficients
}

/// Their gradients, by axis.
fn gradients<R: Real>(basis: &Basis<R>, sighting: Sighting<R>) -> [Vec<R>; 3] {
    let band = || vec![R::zero(); basis.bands()];
    let all = || vec![R::zero(); count(basis.bands())];
    let (mut scales, mut rates) = (band(), band());
    zonal::cap_stable(sighting.cap, &mut scales);
    zonal::cap_rate_stable(sighting.cap, sighting.cosine_rate, &mut rates);
    let (mut values, mut gradients) = (all(), [all(), all(), all()]);
    let slices = gradients.each_mut().map(|axis| axis.as_mut_slice());
    basis.evaluate_with_gradient(sighting.direction, &mut values, slices);
    let slices = gradients.each_mut().map(|axis| axis.as_mut_slice());
    zonal::light_gradient(&sighting, &scales, &rates, &values, slices);
    gradients
}

#[test]
fn the_gradient_of_a_light_is_the_derivative_of_its_coefficients() {
    let basis = Basis::<f64>::new(6);
    let place = |x: [f64; 3]| [0.3 - x[0], -1.1 - x[1], 2.0 - x[2]];
    for see in [Sighting::of_sphere as See<f64>, Sighting::of_disk] {
        // The second and the third see the light along z and along x.
        for point in [[0.0; 3], [0.3, -1.1, 0.0], [1.5, -1.1, 2.0]] {
            let found = gradients(&basis, see(place(point), 0.7).expect("a direction"));
            for (axis, found) in found.iter().enumerate() {
                for (i, found) in found.iter().enumerate() {
                    let slope = derivative(point[axis], 0.01, |moved| {
                        let mut at = point;
                        at[axis] = moved;
                        coefficients(&basis, see(place(at), 0.7).expect("a direction"))[i]
                    });
                    let error = (found - slope).abs();
                    // Extrapolated differences are good to some 1e-12 here.
                    assert!(error < 1e-12, "{point:?}, axis {axis}, {i}: {error}");
                }
            }
        }
    }
}

/// Directions on the axes, beside them and between.
fn directions() -> impl Iterator<Item = [f32; 3]> {
    let axes = (0..3).flat_map(|axis| {
        [0.0, 1e-6, 1e-3, 0.1].into_iter().flat_map(move |beside| {
            [1.0, -1.0].map(|sign| {
                let mut direction = [0.0; 3];
                direction[axis] = sign;
                direction[(axis + 1) % 3] = beside;
                direction[(axis + 2) % 3] = -0.6 * beside;
                direction
            })
        })
    });
    let between = (0..40).map(|i| {
        let (s, c) = (2.4 * i as f32).sin_cos();
        let z = (i as f32 - 19.5) / 20.0;
        let sine = (1.0 - z * z).sqrt();
        [sine * c, sine * s, z]
    });
    axes.chain(between)
}

/// Distances over radii from one to a million.
const RATIOS: [f32; 14] =
    [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999, 0.9999];

/// The largest difference of a band's gradients and their largest true magnitude.
fn band_error(l: usize, found: &[Vec<f32>; 3], exact: &[Vec<f64>; 3]) -> (f64, f64) {
    let band = count(l)..count(l + 1);
    let pairs = found.iter().zip(exact).flat_map(|(found, exact)| {
        found[band.clone()].iter().zip(&exact[band.clone()]).map(|(&f, &e)| (f64::from(f), e))
    });
    pairs.fold((0.0, 0.0), |(error, most), (found, exact)| {
        assert!(found.is_finite(), "l = {l}");
        (f64::max(error, (found - exact).abs()), f64::max(most, exact.abs()))
    })
}

#[test]
fn gradients_keep_their_digits_in_f32() {
    let (single_basis, double_basis) = (Basis::<f32>::new(MAX_BANDS), Basis::new(MAX_BANDS));
    let sees: [(See<f32>, See<f64>); 2] =
        [(Sighting::of_sphere, Sighting::of_sphere), (Sighting::of_disk, Sighting::of_disk)];
    let mut worst = 0.0_f64;
    for (single, double) in sees {
        for direction in directions() {
            for ratio in RATIOS {
                let offset = direction.map(|component| 3.7 * component);
                let radius = ratio * offset.iter().map(|c| c * c).sum::<f32>().sqrt();
                let truth = double(offset.map(f64::from), f64::from(radius)).expect("a direction");
                let found = gradients(&single_basis, single(offset, radius).expect("a direction"));
                let exact = gradients(&double_basis, truth);
                let largest = exact.iter().map(|axis| common::largest(axis)).fold(0.0, f64::max);
                let tangent = truth.cap.sine / truth.cap.cosine;
                for l in 0..MAX_BANDS {
                    let (error, most) = band_error(l, &found, &exact);
                    // A distance off by ε d moves α = √(1 − s²) by ε tan² a of itself, and the rate
                    // ∝ P_l(α)/α with it, by up to that of the largest rate of all bands: near a
                    // sphere no f32 distance determines the gradient better.
                    let conditioning = f64::from(f32::EPSILON) * tangent * tangent;
                    let limit = 1e-5 * most + conditioning * largest;
                    assert!(error <= limit, "{direction:?}, {ratio}, {l}: {error} {most}");
                    if conditioning < 1e-6 {
                        worst = worst.max(error / largest);
                    }
                }
            }
        }
    }
    println!("worst error away from the surface: {worst:.1e} of the largest gradient");
}
