//! The adapter against the f64 oracle.

use crate::common::{
    DIRECT, GPU, SETTINGS, all_settings, dielectric, glossy, metal, oblique, render, scene,
    spheres, spiral, surface,
};
use crate::tensor;
use glam::Vec3;
use manylights_gpu::SurfaceRecord;
use manylights_scene::{Brdf, Measured};
use manylights_spherical_light::{Coefficients, Extent, Settings, SphereLight, gather, oracle};

/// Receivers around the origin.
pub(crate) fn receivers(brdf: Brdf, camera: Vec3) -> Vec<SurfaceRecord> {
    (0..512)
        .map(|i| {
            let place = spiral(i, 512, -1.0).as_vec3() * (0.2 + 0.01 * i as f32);
            let normal = spiral((i * 197) % 512, 512, -1.0).as_vec3();
            surface(oblique(place), oblique(normal), brdf)
        })
        .filter(|surface| surface.normal.dot(camera - surface.position) > 0.0)
        .collect()
}

/// Largest difference to the oracle over all receivers, relative to the largest true radiance.
pub(crate) fn worst(brdf: Brdf, lights: &[SphereLight], settings: &Settings) -> f64 {
    let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
    let surfaces = receivers(brdf, camera);
    let pixels = gather(&GPU, &surfaces, camera, lights, settings).expect("a gather");
    let (mut peak, mut worst): (f64, f64) = (0.0, 0.0);
    for (surface, pixel) in surfaces.iter().zip(pixels) {
        let truth = oracle::radiance(surface, camera.as_dvec3(), lights, settings);
        let pixel = Vec3::from(pixel);
        assert!(pixel.is_finite(), "{surface:?}: {pixel}");
        peak = peak.max(truth.abs().max_element());
        worst = worst.max((pixel.as_dvec3() - truth).abs().max_element());
    }
    assert!(peak > 0.0, "nothing arrives");
    worst / peak
}

/// A synthetic measurement with a lobe of its own for each channel.
fn measured() -> Brdf {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("synthetic.bsdf");
    std::fs::write(&path, tensor::satin()).expect("can write");
    Measured::load(&path).expect("valid").brdf()
}

pub(crate) fn sphere(radius: f32) -> SphereLight {
    SphereLight::new(oblique(Vec3::new(0.02, 0.05, 0.01)), radius, Vec3::new(1.0, 0.7, 0.3))
}

#[test]
fn every_lobe_in_every_setting() {
    let brdfs = [Brdf::lambert(Vec3::splat(0.7)), glossy(0.4), metal(0.3), dielectric(0.5)];
    for brdf in brdfs {
        for settings in all_settings() {
            for bands in [1, 2, 5, 9, 15] {
                let settings = Settings { bands, ..settings };
                let worst = worst(brdf, &[sphere(0.15), sphere(0.6)], &settings);
                println!("{brdf:?}, {settings:?}: {worst:.1e}");
                assert!(worst < 1e-5, "{brdf:?}, {settings:?}: {worst:e}");
            }
        }
    }
}

#[test]
fn measured_lobes() {
    for bands in [2, 7] {
        let settings = Settings { bands, ..SETTINGS };
        let worst = worst(measured(), &[sphere(0.15), sphere(0.6)], &settings);
        println!("{bands} bands: {worst:.1e}");
        assert!(worst < 1e-5, "{bands} bands: {worst:e}");
    }
}

/// From points to spheres that swallow all receivers.
#[test]
fn every_radius() {
    for radius in [1e-6, 1e-3, 0.02, 0.2, 3.0, 50.0] {
        for settings in all_settings() {
            let worst = worst(metal(0.4), &[sphere(radius)], &settings);
            println!("{radius}, {settings:?}: {worst:.1e}");
            assert!(worst < 1e-5, "{radius}, {settings:?}: {worst:e}");
        }
    }
}

#[test]
fn pictures_of_every_word() {
    let scene = scene(5);
    let (lights, eye) = (spheres(&scene), scene.cameras[0].position.as_dvec3());
    let tabulated = Settings { coefficients: Coefficients::Tabulated, ..SETTINGS };
    let cases: [(&[(&str, &str)], Settings); 4] = [
        (&[], SETTINGS),
        (&[("bands", "4")], Settings { bands: 4, ..SETTINGS }),
        (&[("coefficients", "tabulated")], tabulated),
        (&[("extent", "disc"), ("narrow", "keep")], Settings { extent: Extent::Disc, ..SETTINGS }),
    ];
    for (texts, settings) in cases {
        let (image, surfaces) = render(&scene, [24, 18], texts, DIRECT).expect("a picture");
        let truth =
            |surface| oracle::radiance(surface, eye, &lights, &settings).max(glam::DVec3::ZERO);
        let truth: Vec<_> = surfaces.iter().map(truth).collect();
        let peak = truth.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
        let errors = image.pixels.iter().zip(&truth).map(|(&pixel, truth)| {
            (Vec3::from(pixel).as_dvec3() - truth).abs().max_element() / peak
        });
        let worst = errors.fold(0.0, f64::max);
        println!("{texts:?}: {worst:.1e}");
        assert!(peak > 0.0 && worst < 1e-5, "{texts:?}: {worst:e}");
    }
}

/// Twice the radiance, twice the light; lights add up, over batches as well.
#[test]
fn linear_in_the_lights() {
    let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
    let surfaces = receivers(metal(0.5), camera);
    let of = |lights: &[SphereLight]| {
        gather(&GPU, &surfaces, camera, lights, &SETTINGS).expect("a gather")
    };
    let once = of(&[sphere(0.3)]);
    let mut bright = sphere(0.3);
    bright.radiance *= 2.0;
    let twice = of(&[bright]);
    let many = of(&[sphere(0.3); 2048]);
    let peak = once.as_flattened().iter().fold(0.0_f32, |peak, value| peak.max(value.abs()));
    for ((once, twice), many) in once.iter().zip(&twice).zip(&many) {
        for channel in 0..3 {
            assert_eq!(2.0 * once[channel], twice[channel]);
            // A sum of 512 rounds by as many halves of the last place at most.
            let error = (many[channel] / 2048.0 - once[channel]).abs();
            assert!(error < 512.0 * 6e-8 * peak, "{error:e} of {peak:e}");
        }
    }
}
