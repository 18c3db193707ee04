//! The closed forms of the oracle against quadrature.

use std::f64::consts::PI;

use glam::{DMat3, DVec2, DVec3};
use manylights_harmonics::quadrature::sphere_nodes;
use manylights_scene::DBrdf;
use manylights_vsgl::oracle::gaussian::{
    Gaussian, blur, clamped_cosine, integral, mean_length, sharpness, visible_share,
};
use manylights_vsgl::oracle::reflection::{anisotropic, filtered};
use manylights_vsgl::oracle::{DIFFUSE_SHARPNESS, albedo};

/// Directions and weights times a Gaussian of amplitude 1 about `axis`.
fn weighted(axis: DVec3, sharpness: f64, count: usize) -> Vec<(DVec3, f64)> {
    let (a, b) = axis.any_orthonormal_pair();
    let frame = DMat3::from_cols(a, b, axis);
    let cut = (1.0 - 12.0 / sharpness).max(-1.0);
    let ranges = [[-1.0, cut], [cut, 1.0]].into_iter().filter(|[low, high]| high > low);
    let nodes = ranges.flat_map(|range| sphere_nodes(count, range));
    nodes
        .map(|(w, weight)| {
            let w = DVec3::from_array(w);
            (frame * w, weight * (-0.5 * sharpness * (w - DVec3::Z).length_squared()).exp())
        })
        .collect()
}

fn at(cosine: f64) -> DVec3 {
    DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine)
}

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

/// Tokuyoshi's closed form; the errors that ../src/lib.rs states.
#[test]
fn clamped_cosine_integral() {
    let table =
        [(0.1, 4e-5), (1.0, 1e-4), (2.29, 6e-4), (5.0, 1.6e-3), (20.0, 4e-4), (100.0, 4e-5)];
    for (l, bound) in table {
        let peak = clamped_cosine(1.0, l).integral;
        let (mut worst, mut worst_mean) = (0.0_f64, 0.0_f64);
        for step in -9..=10 {
            let axis = at(f64::from(step) / 10.0);
            let cosine = |(w, weight): &(DVec3, f64)| w.z.max(0.0) * weight;
            let nodes = weighted(axis, l, 200);
            let truth: f64 = nodes.iter().map(cosine).sum();
            let mean = nodes.iter().map(|node| cosine(node) * node.0.z).sum::<f64>() / truth;
            let found = clamped_cosine(axis.z, l);
            worst = worst.max((found.integral - truth).abs() / peak);
            if truth > 0.01 * peak {
                worst_mean = worst_mean.max((found.mean - mean).abs());
            }
        }
        println!("λ = {l}: integral {worst:.1e} of the peak, mean cosine {worst_mean:.3}");
        assert!(worst < bound && worst_mean < 0.17, "{l}: {worst:e} {worst_mean}");
    }
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
            assert!(error < 4e-3, "{l} {}: {error}", axis.z);
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

/// Root mean square over lights all around, in units of the largest value.
fn specular_errors(roughness: f64, view: f64, sharpness: f64) -> [f64; 2] {
    let brdf = DBrdf {
        diffuse: DVec3::ZERO,
        f0: DVec3::ONE,
        lobe: manylights_scene::Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    };
    let view = at(view.to_radians().cos());
    let (mut errors, mut peak, mut total) = ([0.0; 2], 0.0_f64, 0.0);
    for (axis, weight) in sphere_nodes(10, [-0.3, 1.0]) {
        let axis = DVec3::from_array(axis);
        let value =
            |(w, weight): (DVec3, f64)| brdf.eval(DVec3::Z, view, w).x * w.z.max(0.0) * weight;
        let truth: f64 = weighted(axis, sharpness, 60).into_iter().map(value).sum();
        let found = [
            anisotropic(brdf.alpha, view, axis, sharpness).integral,
            filtered(brdf.alpha, view, axis, sharpness).integral,
        ];
        for (error, found) in errors.iter_mut().zip(found) {
            *error += weight * (found - truth).powi(2);
        }
        peak = peak.max(truth);
        total += weight;
    }
    errors.map(|error| (error / total).sqrt() / peak)
}

/// Which of the two lobes is nearer to the truth: the reason for the default.
#[test]
fn filtered_normals_beat_the_anisotropic_gaussian() {
    let mut sums = [0.0; 2];
    for roughness in [0.4, 0.7, 1.0] {
        for view in [10.0, 45.0, 75.0] {
            for sharpness in [2.3, 20.0, 200.0] {
                let [by_gaussian, by_normals] = specular_errors(roughness, view, sharpness);
                println!("{roughness} {view}° λ {sharpness}: {by_gaussian:.3} {by_normals:.3}");
                sums[0] += by_gaussian / 27.0;
                sums[1] += by_normals / 27.0;
            }
        }
    }
    println!("mean: {sums:?}");
    assert!(sums[1] < 0.5 * sums[0], "{sums:?}");
    assert!(sums[1] < 0.1, "{sums:?}");
}

/// The table that the filter reads, against the midpoint rule over the hemisphere, which knows nothing
/// of visible normals.
#[test]
fn albedos() {
    let side = 1500;
    let middle = |index: u32| (f64::from(index) + 0.5) / f64::from(side);
    for roughness in [0.3, 0.5, 0.77, 1.0] {
        for cosine in [0.06, 0.31, 0.7, 0.99] {
            let (f0, alpha) = (DVec3::splat(0.3), roughness * roughness);
            let lobe = manylights_scene::Lobe::Schlick { f90: 0.8 };
            let brdf = DBrdf { diffuse: DVec3::ZERO, f0, lobe, alpha };
            let mut truth = 0.0;
            for ring in 0..side {
                for sector in 0..128 {
                    // cos² uniform.
                    let z = middle(ring).sqrt();
                    // Dense about the mirrored view, where grazing lobes are narrow.
                    let turn = (f64::from(sector) + 0.5) / 128.0;
                    let around = -DVec2::from_angle(PI * turn.powi(3));
                    let w = ((1.0 - z * z).sqrt() * around).extend(z);
                    truth += 3.0 * turn * turn * brdf.eval(DVec3::Z, at(cosine), w).x;
                }
            }
            truth *= PI / f64::from(side * 128);
            let found = albedo(alpha, cosine).dot(DVec2::new(0.3, 0.8));
            println!("{roughness} {cosine}: {found:.4} {truth:.4}");
            // The table's rows are 0.03 apart and its curves bend where light grazes.
            assert!((found / truth - 1.0).abs() < 0.015, "{roughness} {cosine}: {found} {truth}");
        }
    }
}
