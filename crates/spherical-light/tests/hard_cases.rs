//! No energy jumps, nothing non-finite: where lights touch, swallow, shrink or sink.

use std::f64::consts::PI;

use crate::common::{GPU, SETTINGS, all_settings, glossy, metal, surface};
use glam::Vec3;
use manylights_paths::closed_form::sphere_irradiance;
use manylights_scene::Brdf;
use manylights_spherical_light::{
    CosineProduct, Extent, Product, Settings, SphereLight, gather, oracle,
};

const CAMERA: Vec3 = Vec3::new(0.6, 1.0, -0.2);

/// Every form of the full lobe, a product in the surface's frame and one in the world's, of which adapters
/// take 20 s to compile 9 bands.
fn hard_settings() -> Vec<Settings> {
    let of = |product, bands| Settings { bands, product: Product::Cosine(product), ..SETTINGS };
    let products = [of(CosineProduct::Local, 9), of(CosineProduct::Folded, 5)];
    all_settings().into_iter().chain(products).collect()
}

/// Values of one receiver as a sphere moves along a path; so far from the camera that the receivers may move
/// instead.
fn along(
    places: impl Iterator<Item = Vec3>,
    brdf: Brdf,
    radius: f32,
    settings: &Settings,
) -> Vec<f32> {
    let receivers: Vec<_> = places.map(|place| surface(-place, Vec3::Y, brdf)).collect();
    let light = SphereLight::new(Vec3::ZERO, radius, Vec3::ONE);
    let pixels = gather(&GPU, &receivers, 1e4 * CAMERA, &[light], settings).expect("a gather");
    pixels.into_iter().map(|pixel| pixel[0]).collect()
}

/// Steps of the path are about 1 % of the radius: none is more than this part of the largest value.
fn continuous(values: &[f32], most: f32, settings: &Settings) {
    let largest = values.iter().copied().fold(0.0, f32::max);
    assert!(largest > 0.0 && largest.is_finite());
    let steps = values.windows(2).map(|pair| (pair[1] - pair[0]).abs() / largest);
    let step = steps.fold(0.0, f32::max);
    println!("{settings:?}: {step:.4}");
    assert!(step < most, "{step} of the largest, {settings:?}");
}

#[test]
fn nothing_jumps_where_the_point_enters_the_sphere() {
    let toward = Vec3::new(-0.3, 0.9, 0.1).normalize();
    for settings in hard_settings() {
        for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.5)] {
            let places = (1..200).map(|step| toward * (0.005 * step as f32));
            // Outside the sphere its cap shrinks by 0.14 rad in the first step.
            let most = if settings.extent == Extent::Sphere { 0.05 } else { 0.015 };
            continuous(&along(places, brdf, 0.5, &settings), most, &settings);
        }
    }
}

/// Through the surface and below its horizon; at the end what a few bands leak.
#[test]
fn nothing_jumps_where_the_sphere_sinks_below_the_horizon() {
    for settings in hard_settings() {
        for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.5)] {
            let places = (0..260).map(|step| Vec3::new(-0.8, 0.8 - 0.005 * step as f32, 0.1));
            let values = along(places, brdf, 0.4, &settings);
            continuous(&values, 0.015, &settings);
            let largest = values.iter().copied().fold(0.0, f32::max);
            assert!(values[259].abs() < 0.02 * largest, "{settings:?}: {}", values[259]);
        }
    }
}

/// Lengths times any factor: the same picture.
#[test]
fn the_unit_of_length_does_not_matter() {
    for settings in hard_settings() {
        let value = |size: f32| {
            let light = SphereLight::new(size * Vec3::new(-0.3, 0.4, 0.1), 0.3 * size, Vec3::ONE);
            let surface = surface(Vec3::ZERO, Vec3::Y, glossy(0.6));
            gather(&GPU, &[surface], size * CAMERA, &[light], &settings).expect("a gather")[0][0]
        };
        let metre = value(1.0);
        assert!(metre > 0.0);
        for size in [1e-3, 1e4] {
            let error = (value(size) / metre - 1.0).abs();
            assert!(error < 1e-5, "{settings:?} {size}: {error}");
        }
    }
}

/// Small and far lights keep their digits: the radiance over the square of the sine is that of the limit.
#[test]
fn lights_vanish_without_losing_digits() {
    for settings in hard_settings() {
        for brdf in [Brdf::lambert(Vec3::ONE), metal(0.6)] {
            let surface = surface(Vec3::ZERO, Vec3::Y, brdf);
            let value = |sine: f32, distance: f32| {
                let center = distance * Vec3::new(-0.48, 0.64, 0.6);
                let light = SphereLight::new(center, distance * sine, Vec3::ONE);
                let pixels = gather(&GPU, &[surface], CAMERA, &[light], &settings);
                f64::from(pixels.expect("a gather")[0][0] / (sine * sine))
            };
            let limit = value(1e-4, 1.0);
            assert!(limit > 0.0);
            for (sine, distance) in [(1e-5, 1.0), (1e-7, 1.0), (1e-5, 1e4), (1e-4, 1e-3)] {
                let error = (value(sine, distance) / limit - 1.0).abs();
                assert!(error < 3e-6, "{settings:?} {sine} at {distance}: {error:e}");
            }
        }
    }
}

/// Lights at, next to and around the shaded point, above, on and below its horizon, of any radius, on smooth and
/// rough surfaces: finite, and the oracle's, both over the square of the sine, so that a far light counts as
/// much as a near one.
#[test]
fn nothing_is_ever_non_finite() {
    let toward = [[0.3, 0.9, 0.2], [0.8, 0.0, -0.6], [-0.5, -0.5, 0.7]];
    let distances = [0.0, 1e-30, 1e-20, 1e-12, 1e-6, 1e-3, 0.0999, 0.1, 0.1001, 1.0, 1e6];
    // So far that its direction is one for all.
    let camera = 1e8 * CAMERA;
    let places: Vec<_> = toward
        .iter()
        .flat_map(|&w| distances.map(|distance| distance * Vec3::from(w).normalize()))
        .collect();
    for settings in hard_settings() {
        for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.5), metal(0.1)] {
            let mut worst = 0.0_f64;
            let receivers: Vec<_> =
                places.iter().map(|&place| surface(-place, Vec3::Y, brdf)).collect();
            for radius in [1e-30, 1e-10, 1e-3, 0.1, 1e3, 1e10] {
                let light = SphereLight::new(Vec3::ZERO, radius, Vec3::ONE);
                let pixels = gather(&GPU, &receivers, camera, &[light], &settings);
                let pixels = pixels.expect("a gather");
                let of =
                    |receiver| oracle::radiance(receiver, camera.as_dvec3(), &[light], &settings);
                let truths: Vec<_> = receivers.iter().map(of).collect();
                let square = |place: &Vec3| {
                    let distance = place.as_dvec3().length();
                    (f64::from(radius) / distance.max(f64::from(radius))).powi(2)
                };
                let seen = places.iter().map(square).zip(&truths);
                let largest = seen.map(|(square, truth)| truth.abs().max_element() / square);
                let largest = largest.fold(0.0, f64::max);
                assert!(largest > 0.0, "{settings:?} {brdf:?} {radius}: nothing arrives");
                for ((place, pixel), truth) in places.iter().zip(pixels).zip(&truths) {
                    let value = Vec3::from(pixel);
                    let what = format!("{settings:?} {brdf:?} {radius} at {place}");
                    assert!(value.is_finite() && truth.is_finite(), "{what}");
                    let beside = (radius / place.length() - 1.0).abs() < 1e-6;
                    // On the sphere itself a rounded distance tells the cap to √ε alone.
                    let bound = match settings.extent {
                        Extent::Sphere if beside => f64::from(f32::EPSILON.sqrt()),
                        _ => 5e-6,
                    };
                    // f32 has no smaller radiance.
                    let bound = bound * largest * square(place) + f64::from(f32::MIN_POSITIVE);
                    let error = (value.as_dvec3() - truth).abs().max_element();
                    worst = worst.max(error / bound);
                    assert!(error < bound, "{what}: {value} for {truth}");
                }
            }
            println!("{settings:?} {brdf:?}: {worst:.2} of the bound");
        }
    }
}

/// Inside a sphere a point sees the hemisphere about its centre; at the centre, that about the normal, of
/// which a Lambertian surface reflects all; next to it, however near, that about the direction it lies in.
#[test]
fn the_centre_is_the_hemisphere_about_the_normal() {
    let receiver = surface(Vec3::ZERO, Vec3::Y, Brdf::lambert(Vec3::ONE));
    let radius = 0.5_f32;
    for settings in hard_settings() {
        let at = |place: Vec3| -> f64 {
            let light = SphereLight::new(place, radius, Vec3::ONE);
            gather(&GPU, &[receiver], CAMERA, &[light], &settings).expect("a gather")[0][0].into()
        };
        assert!((at(Vec3::ZERO) - 1.0).abs() < 1e-6, "{settings:?}: {}", at(Vec3::ZERO));
        assert_eq!(at(1e-20 * Vec3::X), at(Vec3::ZERO), "{settings:?}");
        let slanted = Vec3::new(0.6, 0.48, 0.64);
        for toward in [Vec3::Y, Vec3::X, slanted, -slanted] {
            for distance in [1e-9, 0.1, 0.499] {
                // Of a hemisphere's irradiance bands leave nothing.
                let (sine, most) = match settings.extent {
                    Extent::Sphere => (1.0, 1e-6),
                    Extent::Disc => (f64::from(radius / radius.hypot(distance)), 2e-3),
                };
                let truth = sphere_irradiance(f64::from(toward.y), sine) / PI;
                let value = at(distance * toward);
                let error = (value - truth).abs();
                assert!(error < most, "{settings:?} {toward} {distance}: {value} for {truth}");
            }
        }
    }
}
