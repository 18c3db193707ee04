//! No energy jumps, nothing non-finite: where lights touch, swallow, shrink or sink.

use crate::common::{GPU, SETTINGS, all_settings, glossy, metal, spiral, surface};
use glam::Vec3;
use manylights_scene::Brdf;
use manylights_spherical_light::{Settings, SphereLight, gather, oracle};

const CAMERA: Vec3 = Vec3::new(0.6, 1.0, -0.2);

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

/// Steps of the path are 1 % of the radius; where the point leaves a sphere the cap shrinks by 0.14 rad in the
/// first one.
fn continuous(values: &[f32], settings: &Settings) {
    let largest = values.iter().copied().fold(0.0, f32::max);
    assert!(largest > 0.0 && largest.is_finite());
    for (index, pair) in values.windows(2).enumerate() {
        let step = (pair[1] - pair[0]).abs();
        assert!(step < 0.15 * largest, "step {index}: {pair:?} of {largest}, {settings:?}");
    }
}

#[test]
fn nothing_jumps_where_the_point_enters_the_sphere() {
    let toward = Vec3::new(-0.3, 0.9, 0.1).normalize();
    for settings in all_settings() {
        for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.5)] {
            let places = (1..200).map(|step| toward * (0.005 * step as f32));
            continuous(&along(places, brdf, 0.5, &settings), &settings);
        }
    }
}

/// Through the surface and below its horizon; at the end what a few bands leak.
#[test]
fn nothing_jumps_where_the_sphere_sinks_below_the_horizon() {
    for settings in all_settings() {
        for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.5)] {
            let places = (0..260).map(|step| Vec3::new(-0.8, 0.8 - 0.005 * step as f32, 0.1));
            let values = along(places, brdf, 0.4, &settings);
            continuous(&values, &settings);
            let largest = values.iter().copied().fold(0.0, f32::max);
            assert!(values[259].abs() < 0.02 * largest, "{settings:?}: {}", values[259]);
        }
    }
}

/// Lengths times any factor: the same picture.
#[test]
fn the_unit_of_length_does_not_matter() {
    for settings in all_settings() {
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
    for settings in all_settings() {
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

/// Lights at, next to and around the shaded point, of any radius, on smooth and rough surfaces: finite, and
/// the oracle's.
#[test]
fn nothing_is_ever_non_finite() {
    let distances = [0.0, 1e-30, 1e-20, 1e-12, 1e-6, 1e-3, 0.0999, 0.1, 0.1001, 1.0, 1e6];
    for settings in all_settings() {
        for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.5), metal(0.1)] {
            let receiver = surface(Vec3::ZERO, Vec3::Y, brdf);
            for radius in [1e-30, 1e-10, 1e-3, 0.1, 1e3, 1e10] {
                for distance in distances {
                    let toward = spiral(5, 17, -1.0).as_vec3();
                    let light = SphereLight::new(distance * toward, radius, Vec3::ONE);
                    let pixels = gather(&GPU, &[receiver], CAMERA, &[light], &settings);
                    let value = Vec3::from(pixels.expect("a gather")[0]);
                    let truth = oracle::radiance(&receiver, CAMERA.as_dvec3(), &[light], &settings);
                    assert!(value.is_finite() && truth.is_finite(), "{radius} {distance}");
                    // On the sphere itself a rounded distance tells the cap to √ε alone.
                    let bound = if (radius / distance - 1.0).abs() < 1e-6 { 1e-3 } else { 2e-5 };
                    let error = (value.as_dvec3() - truth).abs().max_element();
                    let what = format!("{settings:?} {brdf:?} {radius} at {distance}");
                    assert!(error < bound, "{what}: {value} {truth}");
                }
            }
        }
    }
}

/// Inside a sphere a point sees the hemisphere about its centre; at the centre, that about the normal, of
/// which a Lambertian surface reflects all.
#[test]
fn the_centre_is_the_hemisphere_about_the_normal() {
    let receiver = surface(Vec3::ZERO, Vec3::Y, Brdf::lambert(Vec3::ONE));
    for settings in all_settings() {
        let at = |place: Vec3| {
            let light = SphereLight::new(place, 0.5, Vec3::ONE);
            gather(&GPU, &[receiver], CAMERA, &[light], &settings).expect("a gather")[0][0]
        };
        // What nine bands leave of it.
        assert!((at(Vec3::ZERO) - 1.0).abs() < 5e-3, "{settings:?}: {}", at(Vec3::ZERO));
        assert!((at(1e-9 * Vec3::Y) - at(Vec3::ZERO)).abs() < 1e-5, "{settings:?}");
    }
    let half =
        |light: SphereLight| oracle::radiance(&receiver, CAMERA.as_dvec3(), &[light], &SETTINGS).x;
    // π/2 (1 + cos) over π.
    let sideways = half(SphereLight::new(0.1 * Vec3::X, 0.5, Vec3::ONE));
    assert!((sideways - 0.5).abs() < 5e-3, "{sideways}");
}
