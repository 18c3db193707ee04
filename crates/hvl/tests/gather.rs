//! The adapter's gather against the f64 oracle.

use crate::common::{
    FORMS, GPU, SETTINGS, dielectric, glossy, light, metal, oblique, render, surface, worst,
};
use glam::Vec3;
use manylights_gpu::{Center, GpuFrame, Shadows};
use manylights_harmonics::window::Window;
use manylights_hvl::{Horizon, Settings, gather, oracle};
use manylights_reflectance::{Damping, Form};
use manylights_scene::Brdf;
use manylights_scene::Visibility;
use manylights_virtual_lights::RadiusRule;

#[test]
fn every_form_on_every_pair_of_lobes() {
    let lambert = Brdf::lambert(Vec3::splat(0.7));
    let pairs = [
        ("Lambert by Lambert", lambert, lambert),
        ("glossy by Lambert", glossy(0.4), lambert),
        ("metal by glossy", metal(0.3), glossy(0.5)),
        ("glossy by dielectric", glossy(0.4), dielectric(0.6)),
        ("dielectric by metal", dielectric(0.4), metal(0.5)),
    ];
    for (name, receiver, emitter) in pairs {
        let sphere = light(Vec3::ZERO, oblique(Vec3::Y), emitter, 0.4);
        for form in FORMS {
            for (bands, emission_bands) in [(1, 1), (5, 0), (8, 3)] {
                for horizon in [Horizon::Smooth, Horizon::Exact] {
                    let settings = Settings { bands, form, emission_bands, horizon, ..SETTINGS };
                    let worst = worst(receiver, &sphere, &settings);
                    println!(
                        "{name}, {form:?}, {bands}, {emission_bands}, {horizon:?}: {worst:.1e}"
                    );
                    // A few roundings of f32.
                    assert!(worst < 3e-6, "{name}, {settings:?}: {worst:e}");
                }
            }
        }
    }
}

/// As many bands as there may be, a lobe narrower than they show, points and spheres that swallow the
/// receivers.
#[test]
fn the_most_bands() {
    for form in FORMS {
        for emission_bands in [0, 5] {
            let settings = Settings { bands: 20, form, emission_bands, ..SETTINGS };
            for radius in [0.0, 0.02, 3.0] {
                let sphere = light(Vec3::ZERO, oblique(Vec3::Y), metal(0.1), radius);
                let worst = worst(metal(0.1), &sphere, &settings);
                println!("{form:?}, {emission_bands}, {radius}: {worst:.1e}");
                assert!(worst < 3e-5, "{settings:?} {radius}: {worst:e}");
            }
        }
    }
}

/// Spheres that the horizon cuts, however small: the closed form takes a difference that vanishes as
/// their third power.
#[test]
fn small_spheres_that_the_horizon_cuts() {
    let settings = Settings { form: Form::Zonal, ..SETTINGS };
    let lambert = Brdf::lambert(Vec3::ONE);
    let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
    for radius in [1e-3, 0.02, 0.0201, 0.05, 0.3, 0.6] {
        let sphere = light(Vec3::ZERO, oblique(Vec3::Y), lambert, radius);
        // One metre above the light; the cosine to it in −0.95 to 0.95 radii, the middle one 0.
        let place = oblique(Vec3::Y);
        let surfaces: Vec<_> = (-19..=19_i8)
            .map(|step| {
                let cosine = 0.05 * f32::from(step) * radius;
                let normal = Vec3::new((1.0 - cosine * cosine).sqrt(), -cosine, 0.0);
                surface(place, oblique(normal), lambert)
            })
            .collect();
        let pixels = gather(&GPU, &surfaces, camera, &[sphere], &settings).expect("a gather");
        let truth = |surface| oracle::radiance(surface, camera.as_dvec3(), &[sphere], &settings).x;
        let middle = truth(&surfaces[19]);
        for (surface, pixel) in surfaces.iter().zip(pixels) {
            let error = (f64::from(pixel[0]) - truth(surface)).abs() / middle;
            // A rounding of the cosine is 6e-8/radius of the sphere.
            let bound = 4e-6 + 3e-7 / f64::from(radius);
            assert!(error < bound, "radius {radius}: {error:e} of {bound:e}");
        }
    }
}

#[test]
fn every_window() {
    let sphere = light(Vec3::ZERO, oblique(Vec3::Y), glossy(0.5), 0.4);
    let windows = [Window::Hann, Window::Lanczos, Window::Hamming].map(Damping::Window);
    for damping in windows.into_iter().chain([Damping::Weakest]) {
        for form in FORMS {
            let worst = worst(glossy(0.3), &sphere, &Settings { damping, form, ..SETTINGS });
            assert!(worst < 3e-6, "{damping:?}, {form:?}: {worst:e}");
        }
    }
}

/// Largest difference of any pixel to the oracle's picture, relative to the largest component.
fn difference(scene: &str, texts: &[(&str, &str)], settings: &Settings) -> f64 {
    let picture = render(scene, [24, 18], texts, settings, Visibility::Ignored, 0);
    let truth = picture.oracle(settings);
    let peak = truth.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
    assert!(peak > 0.0, "{scene} is black");
    let pixels = picture.image.pixels.iter().map(|&pixel| Vec3::from(pixel).as_dvec3());
    let errors = pixels.zip(&truth).map(|(p, t)| (p - t).abs().max_element() / peak);
    let worst = errors.fold(0.0, f64::max);
    println!("{scene} {texts:?}: {worst:.1e}");
    worst
}

#[test]
fn pictures() {
    for scene in ["cornell", "cornell-glossy", "atrium", "trio", "../../scenes/trio-merl.toml"] {
        assert!(
            difference(scene, &[("lights", "64")], &Settings { lights: 64, ..SETTINGS }) < 1e-5
        );
    }
}

#[test]
fn every_parameter_reaches_the_picture() {
    let settings = Settings { lights: 64, ..SETTINGS };
    let zonal = Settings { form: Form::Zonal, bands: 9, ..settings };
    let expanded = Settings { emission_bands: 3, horizon: Horizon::Exact, ..settings };
    let hann = Damping::Window(Window::Hann);
    let neighbours = Settings { radius: RadiusRule::MapNeighbours, scale: 1.7, ..settings };
    let fixed = Settings { radius: RadiusRule::Fixed, scale: 0.25, damping: hann, ..settings };
    let cases: [(&[(&str, &str)], Settings); 4] = [
        (&[("form", "zonal"), ("bands", "9")], zonal),
        (&[("emission_bands", "3"), ("horizon", "exact")], expanded),
        (&[("radius", "r1"), ("scale", "1.7")], neighbours),
        (&[("radius", "fixed"), ("scale", "0.25"), ("window", "hann")], fixed),
    ];
    for (texts, settings) in cases {
        let texts: Vec<_> = texts.iter().copied().chain([("lights", "64")]).collect();
        assert!(difference("trio", &texts, &settings) < 1e-5, "{texts:?}");
    }
}

#[test]
fn same_seed_same_image_and_other_seed_other_image() {
    let render = |seed| render("trio", [16, 12], &[], &SETTINGS, Visibility::Ignored, seed).image;
    assert_eq!(render(0), render(0));
    assert_ne!(render(0), render(1));
}

/// Every pixel is the oracle's sum over the lights that the shadow rays let through; the rays themselves
/// are tested in `manylights-gpu`.
#[test]
fn traced_shadows() {
    let settings = Settings { lights: 64, ..SETTINGS };
    let picture = render("trio", [24, 18], &[("lights", "64")], &settings, Visibility::Traced, 0);
    let scene = manylights_scene::load("trio", None).expect("built in");
    let frame = GpuFrame::new(&GPU, &scene, &scene.cameras[0], [24, 18]).expect("the scene fits");
    let centers: Vec<_> = picture.lights.iter().map(|sphere| Center::from(&sphere.light)).collect();
    let shadows = Shadows::new(&frame, &scene).expect("the hierarchy fits");
    let occluded = shadows.occluded_lights(&centers).expect("a pass");
    assert!(occluded.iter().filter(|occluded| **occluded).count() > 1000);
    let peak = picture.image.pixels.as_flattened().iter().copied().fold(0.0, f32::max);
    for (index, (surface, pixel)) in picture.surfaces.iter().zip(&picture.image.pixels).enumerate()
    {
        let pairs = picture.lights.iter().zip(occluded.chunks(picture.surfaces.len()));
        let seen = pairs.filter(|(_, occluded)| !occluded[index]).map(|(light, _)| *light);
        let seen: Vec<_> = seen.collect();
        let truth = oracle::radiance(surface, picture.eye, &seen, &settings).as_vec3();
        let difference = (Vec3::from(*pixel) - truth.max(Vec3::ZERO)).abs().max_element();
        assert!(difference < 1e-5 * peak, "pixel {index}: {pixel:?}, {truth}");
    }
}
