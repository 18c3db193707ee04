//! The adapter against the f64 oracle.

use crate::common::{GPU, glossy, metal, oblique, receivers, sphere, triangle};
use glam::Vec3;
use manylights_gpu::SurfaceRecord;
use manylights_ltc::{LightRecord, gather, oracle};
use manylights_scene::Brdf;

/// Largest difference to the oracle over all receivers, relative to the largest true radiance.
fn worst(brdf: Brdf, lights: &[LightRecord]) -> f64 {
    let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
    let surfaces = receivers(brdf, camera);
    let pixels = gather(&GPU, &surfaces, camera, lights).expect("a gather");
    let (mut peak, mut worst): (f64, f64) = (0.0, 0.0);
    for (surface, pixel) in surfaces.iter().zip(pixels) {
        let truth = oracle::radiance(surface, camera.as_dvec3(), lights);
        let pixel = Vec3::from(pixel);
        assert!(pixel.is_finite() && pixel.min_element() >= 0.0, "{surface:?}: {pixel}");
        let error = (pixel.as_dvec3() - truth).abs().max_element();
        peak = peak.max(truth.abs().max_element());
        worst = worst.max(error);
    }
    assert!(peak > 0.0, "nothing arrives");
    worst / peak
}

fn sized(size: f32, two_sided: bool) -> LightRecord {
    let corners =
        [Vec3::new(-0.4, 0.1, -0.3), Vec3::new(0.6, -0.1, -0.2), Vec3::new(-0.1, 0.2, 0.7)];
    triangle(corners.map(|corner| oblique(size * corner)), two_sided)
}

/// The narrower a lobe, the fewer digits f32 has of a direction in it.
fn bound(brdf: Brdf) -> f64 {
    if brdf.has_specular() && brdf.alpha < 0.05 { 2e-4 } else { 1e-5 }
}

fn brdfs() -> [Brdf; 6] {
    [
        Brdf::lambert(Vec3::splat(0.7)),
        glossy(0.3),
        glossy(0.8),
        metal(0.1),
        metal(0.4),
        Brdf { lobe: manylights_scene::Lobe::Schlick { f90: 0.6 }, ..glossy(0.5) },
    ]
}

#[test]
fn triangles_on_every_lobe() {
    for brdf in brdfs() {
        for size in [0.01, 0.1, 1.0, 5.0] {
            for two_sided in [false, true] {
                let worst = worst(brdf, &[sized(size, two_sided)]);
                println!("{} {:?} {size} {two_sided}: {worst:.1e}", brdf.alpha, brdf.f0.x);
                assert!(worst < bound(brdf), "{brdf:?}: {worst:e}");
            }
        }
    }
}

#[test]
fn spheres_on_every_lobe() {
    for brdf in brdfs() {
        for radius in [1e-3, 0.1, 1.0, 4.0, 30.0] {
            let worst = worst(brdf, &[sphere(oblique(Vec3::new(0.02, 0.05, 0.01)), radius)]);
            println!("{} {:?} {radius}: {worst:.1e}", brdf.alpha, brdf.f0.x);
            assert!(worst < bound(brdf), "{brdf:?}: {worst:e}");
        }
    }
}

/// Spheres of half-angles all around receivers whose horizon most of them cross, each against the largest of its size.
#[test]
fn spheres_that_the_horizon_cuts() {
    let place = Vec3::new(0.1, -0.2, 0.3);
    for (brdf, degrees) in [
        (metal(0.1), 40.0_f32),
        (metal(0.3), 60.0),
        (metal(0.3), 85.0),
        (glossy(0.5), 60.0),
        (metal(1.0), 75.0),
    ] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let surface = SurfaceRecord::new(place, oblique(Vec3::Z), brdf);
        let camera = place + oblique(5.0 * Vec3::new(sin, 0.0, cos));
        for sine in [1e-3_f32, 0.01, 0.05, 0.2, 0.6, 0.9, 0.999] {
            let (mut peak, mut worst) = (0.0_f64, 0.0_f64);
            for i in 0..600 {
                // Heights within the radius of the horizon.
                let height = sine * (2.0 * (i as f32 + 0.5) / 600.0 - 1.0);
                let turn = (2.399_963 * i as f32).sin_cos();
                let flat = (1.0 - height * height).sqrt();
                let toward = oblique(Vec3::new(flat * turn.0, flat * turn.1, height));
                let light = sphere(place + 3.0 * toward, 3.0 * sine);
                let pixel = gather(&GPU, &[surface], camera, &[light]).expect("a gather")[0];
                let truth = oracle::radiance(&surface, camera.as_dvec3(), &[light]);
                peak = peak.max(truth.max_element());
                worst = worst.max((Vec3::from(pixel).as_dvec3() - truth).abs().max_element());
            }
            println!("{} {degrees}° {sine}: {:.1e}", brdf.alpha, worst / peak);
            // Angles of whole turns are summed in f32.
            assert!(
                worst < (2e-4 * peak).max(1e-7),
                "{} {degrees}° {sine}: {worst:e} of {peak:e}",
                brdf.alpha
            );
        }
    }
}
