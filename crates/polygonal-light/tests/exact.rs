//! Exact triangles on the adapter against the oracle, near and far.

use crate::common::{DIRECT, GPU, exact, glossy, metal, oblique, render, scene, spiral, surface};
use crate::tensor;
use glam::{DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_polygonal_light::{Edges, Settings, gather, oracle};
use manylights_scene::{AreaLight, Brdf, Measured};

/// So far that the direction to it is one for all.
pub(crate) const CAMERA: Vec3 = Vec3::new(3e7, 9e7, -2e7);

/// Around the origin at one distance, turned at random, seen from their front.
pub(crate) fn receivers(brdf: Brdf, distance: f32, count: u32) -> Vec<SurfaceRecord> {
    (0..count)
        .map(|i| {
            let place = distance * spiral(i, count, -1.0).as_vec3();
            let normal = spiral((i * 197) % count, count, -1.0).as_vec3();
            surface(oblique(place), oblique(normal), brdf)
        })
        .filter(|surface| surface.normal.dot(CAMERA) > 0.0)
        .collect()
}

/// Largest difference to the oracle over all receivers, relative to the largest true radiance.
pub(crate) fn worst(surfaces: &[SurfaceRecord], lights: &[AreaLight], settings: &Settings) -> f64 {
    let pixels = gather(&GPU, surfaces, CAMERA, lights, settings).expect("a gather");
    let (mut peak, mut worst): (f64, f64) = (0.0, 0.0);
    for (surface, pixel) in surfaces.iter().zip(pixels) {
        let truth = oracle::radiance(surface, CAMERA.as_dvec3(), lights, settings);
        let pixel = Vec3::from(pixel);
        assert!(pixel.is_finite(), "{surface:?}: {pixel}");
        peak = peak.max(truth.abs().max_element());
        worst = worst.max((pixel.as_dvec3() - truth).abs().max_element());
    }
    assert!(peak > 0.0, "nothing arrives");
    worst / peak
}

/// Of diameter 1, about.
pub(crate) fn triangle(two_sided: bool) -> AreaLight {
    let corners = [[-0.4, 0.05, -0.3], [0.5, -0.02, -0.2], [0.02, 0.07, 0.5]];
    let corners = corners.map(|corner| oblique(Vec3::from(corner)));
    AreaLight::Triangle { corners, radiance: Vec3::new(1.0, 0.7, 0.3), two_sided }
}

#[test]
fn every_lobe_and_any_bands_at_one_size() {
    for brdf in [Brdf::lambert(Vec3::splat(0.7)), glossy(0.4), metal(0.3)] {
        for bands in [1, 2, 3, 5, 9, 15] {
            let settings = Settings { bands, ..exact(Edges::Own) };
            for two_sided in [false, true] {
                let worst = worst(&receivers(brdf, 1.0, 400), &[triangle(two_sided)], &settings);
                println!("{bands} bands, {brdf:?}: {worst:.1e}");
                assert!(worst < 1e-5, "{brdf:?}, {settings:?}: {worst:e}");
            }
        }
    }
}

#[test]
fn any_distance() {
    for brdf in [Brdf::lambert(Vec3::splat(0.7)), glossy(0.4), metal(0.3)] {
        for distance in [
            0.3, 1.0, 3.0, 6.0, 8.5, 9.0, 10.0, 20.0, 60.0, 110.0, 130.0, 300.0, 1e3, 1e4, 1e5, 1e6,
        ] {
            let surfaces = receivers(brdf, distance, 200);
            let worst = worst(&surfaces, &[triangle(true)], &exact(Edges::Own));
            println!("{distance}, {:?}: {worst:.1e}", brdf.alpha);
            assert!(worst < 1e-4, "{brdf:?}, {distance}: {worst:e}");
        }
    }
}

/// A lobe a channel.
#[test]
fn measured_materials() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("synthetic.bsdf");
    std::fs::write(&path, tensor::satin()).expect("can write");
    let satin = Measured::load(&path).expect("valid").brdf();
    for distance in [1.0, 20.0] {
        let settings = Settings { bands: 4, ..exact(Edges::Own) };
        let worst = worst(&receivers(satin, distance, 200), &[triangle(true)], &settings);
        assert!(worst < 1e-5, "{distance}: {worst:e}");
    }
}

/// Where one form follows the other: what a receiver sees a hair before and behind.
#[test]
fn no_seam_where_the_form_changes() {
    for brdf in [Brdf::lambert(Vec3::splat(0.7)), glossy(0.4), metal(0.3)] {
        for bands in [9, 15] {
            let settings = Settings { bands, ..exact(Edges::Own) };
            // The triangle lies in a sphere of a diameter between 1 and 1.3.
            for limit in [8.0, 100.0] {
                let mut worst = 0.0_f64;
                for near in 0..60 {
                    let at = limit * (1.0 + 0.005 * near as f32);
                    let [one, two] = [at, at * 1.005].map(|distance| {
                        let surfaces = receivers(brdf, distance, 60);
                        let pixels = gather(&GPU, &surfaces, CAMERA, &[triangle(true)], &settings);
                        let truth = |surface| {
                            oracle::radiance(
                                surface,
                                CAMERA.as_dvec3(),
                                &[triangle(true)],
                                &settings,
                            )
                        };
                        let truths: Vec<DVec3> = surfaces.iter().map(truth).collect();
                        let errors: Vec<DVec3> = pixels
                            .expect("a gather")
                            .iter()
                            .zip(&truths)
                            .map(|(&pixel, truth)| Vec3::from(pixel).as_dvec3() - truth)
                            .collect();
                        let peak = truths.iter().map(|truth| truth.abs().max_element());
                        (errors, peak.fold(0.0, f64::max))
                    });
                    for (before, behind) in one.0.iter().zip(&two.0) {
                        worst = worst.max((before - behind).abs().max_element() / one.1);
                    }
                }
                println!("{limit} sizes, {bands} bands, {:?}: {worst:.1e}", brdf.alpha);
                let bound = if bands == 9 { 1e-4 } else { 3e-4 };
                assert!(worst < bound, "{brdf:?}, {limit}: {worst:e}");
            }
        }
    }
}

#[test]
fn pictures_by_default_and_of_every_words_edges() {
    let scene = scene(5);
    let (lights, eye) = (&scene.area_lights, scene.cameras[0].position.as_dvec3());
    for texts in [&[][..], &[("edges", "own")], &[("edges", "shared"), ("bands", "5")]] {
        let (image, surfaces) = render(&scene, [24, 18], texts, DIRECT).expect("a picture");
        let bands = if texts.len() == 2 { 5 } else { 9 };
        let settings = Settings { bands, ..exact(Edges::Own) };
        let truth = |surface| oracle::radiance(surface, eye, lights, &settings).max(DVec3::ZERO);
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
