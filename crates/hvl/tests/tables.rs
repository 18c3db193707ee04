//! The tables of lobes, and what the linked WGSL holds.

use glam::{DVec3, Vec3};
use manylights_harmonics::quadrature::sphere;
use manylights_harmonics::{Basis, count, even_count, index};
use manylights_hvl::lobes::{ANGLES, LobeTable};
use manylights_gpu::RadiusRule;
use manylights_hvl::{Horizon, Settings, diffuse, linked_shader};
use manylights_scene::{Brdf, DBrdf};

const BANDS: usize = 6;

/// Against a quadrature over directions, of the reflectance as the scene has it.
#[test]
fn lobes_are_projections_of_the_reflectance() {
    let basis = Basis::<f64>::new(BANDS);
    for (alpha, bound) in [(0.25_f32, 5e-5), (1.0, 2e-5)] {
        let table = LobeTable::of(alpha, BANDS);
        let brdf = Brdf { alpha, f0: Vec3::splat(0.3), f90: 0.8, ..Brdf::lambert(Vec3::ZERO) };
        let brdf = DBrdf::from(brdf);
        for degrees in [0_usize, 40, 80] {
            let view = (degrees as f64).to_radians();
            let view = DVec3::new(view.sin(), 0.0, view.cos());
            let row = &table.values()[degrees * even_count(BANDS)..];
            for (l, m) in [(0, 0), (1, 0), (1, 1), (3, 2), (5, 5)] {
                let mut values = vec![0.0; count(BANDS)];
                let expected = sphere(200, [0.0, 1.0], |w| {
                    basis.evaluate(w, &mut values);
                    let w = DVec3::from(w);
                    brdf.specular(DVec3::Z, view, w).x * w.z * values[index(l, m)]
                });
                let [a, b] = row[manylights_harmonics::even_index(l, m as usize)];
                let value = 0.3 * a + 0.8 * b;
                let error = (value - expected).abs();
                println!("α {alpha} {degrees}° ({l}, {m}): {value:.6}, off by {error:.1e}");
                assert!(error < bound, "{value} {expected}");
            }
        }
    }
}

#[test]
fn the_quadrature_has_converged() {
    for alpha in [9e-4_f64, 0.04, 1.0] {
        let fine = LobeTable::integrate(alpha, BANDS, [128, 192]);
        let coarse = LobeTable::integrate(alpha, BANDS, [64, 96]);
        let worst = |rows: std::ops::Range<usize>| {
            let range = rows.start * even_count(BANDS)..rows.end * even_count(BANDS);
            let pairs = fine.values()[range.clone()].iter().zip(&coarse.values()[range]);
            pairs.map(|(f, c)| (f[0] - c[0]).abs().max((f[1] - c[1]).abs())).fold(0.0, f64::max)
        };
        let (below, last) = (worst(0..ANGLES - 1), worst(ANGLES - 1..ANGLES));
        println!("α {alpha}: {below:.1e}, at 90° {last:.1e}");
        // Coefficients reach 1. At 90° the lobe ends at the horizon in a step.
        assert!(below < 1e-4 && last < 1e-3, "α {alpha}: {below:e}, {last:e}");
        assert_eq!(fine.values().len(), ANGLES * even_count(BANDS));
    }
}

#[test]
fn the_diffuse_lobe_is_the_projection_of_its_formula() {
    let bands = 9;
    for (scales, lobe) in [
        (diffuse::cosine(bands), (|c| c) as fn(f64) -> f64),
        (diffuse::grazing(bands), |c| c * (1.0 - c).powi(5)),
    ] {
        for (l, scale) in scales.iter().enumerate() {
            let mut unit = vec![0.0; l + 1];
            unit[l] = 1.0;
            let expected = sphere(40, [0.0, 1.0], |[.., z]| {
                lobe(z) * manylights_harmonics::zonal::evaluate(&unit, z)
            });
            assert!((scale - expected).abs() < 1e-12, "l = {l}: {scale} {expected}");
        }
    }
}

#[test]
fn a_lambertian_scene_links_no_ggx() {
    for horizon in [Horizon::Smooth, Horizon::Exact] {
        let settings =
            Settings { lights: 1, bands: 5, radius: RadiusRule::Fixed, scale: 1.0, horizon };
        let wgsl = linked_shader(false, false, &settings).expect("links");
        for word in ["alphas", "alpha2", "glossy", "schlick", "specular", "smith", "zonal_dot"] {
            assert!(!wgsl.contains(word), "`{word}` in the Lambertian shader:\n{wgsl}");
        }
        let other = if horizon == Horizon::Exact { "horizon_smooth" } else { "horizon_exact" };
        assert!(!wgsl.contains(other));
        let glossy = linked_shader(true, true, &settings).expect("links");
        assert!(glossy.contains("schlick") && glossy.contains("sh_zonal_dot_even"));
    }
}
