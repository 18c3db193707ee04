//! The closed forms of the oracle against quadrature.

use std::f64::consts::PI;

use crate::common::{at, weighted};
use glam::DVec3;
use manylights_harmonics::quadrature::sphere_nodes;
use manylights_vsgl::oracle::DIFFUSE_SHARPNESS;
use manylights_vsgl::oracle::gaussian::{
    Gaussian, blur, clamped_cosine, gaussian_cosine, integral, mean_length, sharpness,
    visible_share,
};

#[test]
fn products_and_integrals() {
    let gaussian = |axis, sharpness| Gaussian { axis, sharpness, log_amplitude: 0.3 };
    let w = DVec3::new(0.5, -0.3, 0.2).normalize();
    for (one, other) in [(0.0, 3.0), (2.0, 2.0), (0.5, 400.0), (1e6, 1e6)] {
        for apart in [1e-4, 0.3, 2.0, PI] {
            let (a, b) = (gaussian(DVec3::Z, one), gaussian(at(f64::cos(apart)), other));
            let product = a.product(&b).eval(w);
            // An axis that is unit to one rounding moves a logarithm by the sharpness times that.
            let error = (product - a.eval(w) * b.eval(w)).abs();
            assert!(error <= 1e-9 * product, "{one} {other} {apart}: {product}");
        }
    }
    for l in [0.0, 1e-6, 0.1, 2.3, 40.0, 3e3] {
        let truth: f64 = weighted(DVec3::Z, l, 60).iter().map(|(_, weight)| weight).sum();
        assert!((integral(l) / truth - 1.0).abs() < 1e-5, "{l}: {truth}");
        let mean: f64 = weighted(DVec3::Z, l, 60).iter().map(|(w, weight)| w.z * weight).sum();
        assert!((mean_length(l) - mean / truth).abs() < 1e-5, "{l}: {mean}");
    }
}

/// Tokuyoshi's closed form and our mean cosine, which couples the lobes by (1 − c)⁵: the errors that
/// ../src/lib.rs states. Bounds are the measured errors, rounded up.
#[test]
fn clamped_cosine_integral() {
    let table = [
        (0.1, 6e-6, 0.009, 0.045),
        (1.0, 9e-5, 0.095, 0.057),
        (2.29, 5.5e-4, 0.164, 0.104),
        (5.0, 1.6e-3, 0.147, 0.161),
        (20.0, 3.5e-4, 0.048, 0.074),
        (100.0, 2.8e-5, 0.01, 0.035),
    ];
    for (l, bound, mean_bound, coupling_bound) in table {
        let peak = clamped_cosine(1.0, l).integral;
        let (mut worst, mut worst_mean, mut worst_coupling) = (0.0_f64, 0.0_f64, 0.0_f64);
        for step in -9..=10 {
            let axis = at(f64::from(step) / 10.0);
            // About the normal: the cosine has no kink then.
            let nodes = sphere_nodes(160, [0.0, 1.0]).into_iter().map(|(w, weight)| {
                let apart = (DVec3::from_array(w) - axis).length_squared();
                (w[2], weight * (-0.5 * l * apart).exp())
            });
            let nodes: Vec<_> = nodes.collect();
            let integral_of = |value: fn(f64) -> f64| {
                nodes.iter().map(|(c, weight)| value(*c) * weight).sum::<f64>()
            };
            let truth = integral_of(|c| c);
            let found = clamped_cosine(axis.z, l);
            worst = worst.max((found.integral - truth).abs() / peak);
            if truth > 0.01 * peak {
                let mean = integral_of(|c| c * c) / truth;
                worst_mean = worst_mean.max((found.mean - mean).abs());
                let coupling = integral_of(|c| c * (1.0 - c).powi(5)) / truth;
                worst_coupling = worst_coupling.max(((1.0 - found.mean).powi(5) - coupling).abs());
            }
        }
        println!(
            "λ = {l}: integral {worst:.1e} of the peak, mean cosine {worst_mean:.4}, \
             (1 − c)⁵ {worst_coupling:.4}"
        );
        assert!(worst < bound, "{l}: {worst:e}");
        assert!(worst_mean < mean_bound, "{l}: {worst_mean}");
        assert!(worst_coupling < coupling_bound, "{l}: {worst_coupling}");
    }
}

/// The thesis' cosine, exp(2(n·w − 1)): its approximated integral against quadrature, and against that of
/// the cosine itself, beside which it leaks from below. Bounds are the measured errors, rounded up.
#[test]
fn gaussian_cosine_integral() {
    for (l, bound, cosine_bound) in [(0.1, 0.055, 0.061), (2.0, 0.066, 0.133), (20.0, 0.011, 0.146)]
    {
        let peak = clamped_cosine(1.0, l).integral;
        let (mut worst, mut worst_cosine) = (0.0_f64, 0.0_f64);
        for step in -9..=10 {
            let axis = at(f64::from(step) / 10.0);
            let value = |(w, weight): (DVec3, f64)| weight * (2.0 * (w.z - 1.0)).exp();
            let truth: f64 = weighted(axis, l, 60).into_iter().map(value).sum();
            let found = gaussian_cosine(axis.z, l).integral;
            worst = worst.max((found - truth).abs() / peak);
            let cosine = clamped_cosine(axis.z, l).integral;
            worst_cosine = worst_cosine.max((found - cosine).abs() / peak);
        }
        println!("λ = {l}: {worst:.3} of the peak, {worst_cosine:.3} off the cosine's");
        assert!(worst < bound, "{l}: {worst}");
        assert!(worst_cosine < cosine_bound, "{l}: {worst_cosine}");
    }
    // The mean is that of the product's axis.
    let axis = at(0.3);
    let [cosine, light] = [(DVec3::Z, 2.0), (axis, 7.0)].map(|(axis, sharpness)| Gaussian {
        axis,
        sharpness,
        log_amplitude: 0.0,
    });
    let product = cosine.product(&light).axis.z;
    assert!((gaussian_cosine(0.3, 7.0).mean - product).abs() < 1e-12);
}

#[test]
fn share_above_the_horizon() {
    for l in [0.1, 1.0, 5.0, 50.0] {
        for step in -10..=10 {
            let axis = at(f64::from(step) / 10.0);
            let nodes = weighted(axis, l, 200);
            let above: f64 =
                nodes.iter().filter(|(w, _)| w.z > 0.0).map(|(_, weight)| weight).sum();
            let error = (visible_share(axis.z, l) - above / integral(l)).abs();
            assert!(error < 3.2e-3, "{l} {}: {error}", axis.z);
        }
    }
}

#[test]
fn mean_lengths() {
    for l in [0.0, 1e-3, 0.5, 2.2925, 10.0, 1e6, 1e12] {
        let back = (1.0 - blur(l)).clamp(0.0, 1.0);
        // The sharpness of a mean length has the rounding of 1 − r.
        assert!(
            (sharpness(back) - l).abs() <= 1e-9 * l + 1e-15 * l * l,
            "{l}: {}",
            sharpness(back)
        );
        // Banerjee's estimate is within 4 % of the exact one.
        assert!(l == 0.0 || (sharpness(mean_length(l)) / l - 1.0).abs() < 0.04 || l > 1e9, "{l}");
    }
    // The lobe that is nearest to cos/π has this mean length in the authors' code.
    assert!((1.0 - blur(DIFFUSE_SHARPNESS) - 0.5749255543539332).abs() < 1e-6);
}
