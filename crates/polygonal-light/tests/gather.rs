//! The adapter against the f64 oracle.

use crate::common::{
    DIRECT, GPU, glossy, metal, oblique, render, scene, settings, spiral, surface,
};
use glam::{DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_polygonal_light::{Settings, TriangleForm, gather, oracle};
use manylights_scene::{AreaLight, Brdf};

/// Receivers around the origin, at distances of 0.2 to 5.3.
fn receivers(brdf: Brdf, camera: Vec3) -> Vec<SurfaceRecord> {
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
fn worst(brdf: Brdf, lights: &[AreaLight], settings: &Settings) -> f64 {
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

fn triangle(size: f32, two_sided: bool) -> AreaLight {
    let corners = [[-0.4, 0.05, -0.3], [0.5, -0.02, -0.2], [0.02, 0.07, 0.6]];
    let corners = corners.map(|corner| oblique(size * Vec3::from(corner)));
    AreaLight::Triangle { corners, radiance: Vec3::new(1.0, 0.7, 0.3), two_sided }
}

#[test]
fn every_form_on_every_lobe() {
    let brdfs = [Brdf::lambert(Vec3::splat(0.7)), glossy(0.4), metal(0.3)];
    for form in TriangleForm::ALL {
        for brdf in brdfs {
            for bands in [1, 2, 5, 9, 15] {
                let settings = Settings { bands, ..settings(form) };
                let lights = [triangle(0.3, false), triangle(0.6, true)];
                let worst = worst(brdf, &lights, &settings);
                println!("{brdf:?}, {settings:?}: {worst:.1e}");
                assert!(worst < 1e-5, "{brdf:?}, {settings:?}: {worst:e}");
            }
        }
    }
}

#[test]
fn pictures_of_every_word() {
    let scene = scene(5);
    let (lights, eye) = (&scene.area_lights, scene.cameras[0].position.as_dvec3());
    let words = [
        ("sphere", TriangleForm::Sphere),
        ("main", TriangleForm::Main),
        ("solid-angle", TriangleForm::SolidAngle),
        ("compromise", TriangleForm::Compromise),
        ("compromise-root", TriangleForm::CompromiseRoot),
        ("scaled", TriangleForm::Scaled),
        ("point", TriangleForm::Point),
    ];
    for (word, form) in words {
        let (image, surfaces) =
            render(&scene, [24, 18], &[("approximation", word)], DIRECT).expect("a picture");
        let truth =
            |surface| oracle::radiance(surface, eye, lights, &settings(form)).max(DVec3::ZERO);
        let truth: Vec<_> = surfaces.iter().map(truth).collect();
        let peak = truth.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
        let errors = image.pixels.iter().zip(&truth).map(|(&pixel, truth)| {
            (Vec3::from(pixel).as_dvec3() - truth).abs().max_element() / peak
        });
        let worst = errors.fold(0.0, f64::max);
        println!("{word}: {worst:.1e}");
        assert!(peak > 0.0 && worst < 1e-5, "{word}: {worst:e}");
    }
}
