//! No energy jumps, nothing non-finite: where spheres touch, swallow or shrink.

use std::f32::consts::{FRAC_1_PI, FRAC_PI_2};

use crate::common::{GPU, SETTINGS, glossy, light, render};
use glam::Vec3;
use manylights_gpu::SurfaceRecord;
use manylights_scene::Brdf;
use manylights_virtual_lights::RadiusRule;
use manylights_vsl::{Sampling, Settings, VirtualSphere, gather};

const CAMERA: Vec3 = Vec3::new(0.6, 1.0, -0.2);
const SAMPLINGS: [Sampling; 3] = [Sampling::Brdf, Sampling::Cone, Sampling::Both];

fn radiance(surface: SurfaceRecord, sphere: VirtualSphere, settings: &Settings) -> f32 {
    let pixels = gather(&GPU, &[surface], CAMERA, &[sphere], settings, 0).expect("a gather");
    pixels[0][0]
}

/// Values along a path of the light, by cone samples.
fn along(places: impl Iterator<Item = (Vec3, Vec3)>, brdf: Brdf, radius: f32) -> Vec<f32> {
    let settings = Settings { directions: 4096, sampling: Sampling::Cone, ..SETTINGS };
    let receiver = SurfaceRecord::new(Vec3::ZERO, Vec3::Y, brdf);
    places
        .map(|(place, normal)| radiance(receiver, light(place, normal, brdf, radius), &settings))
        .collect()
}

/// Steps of the path are 1 % of the radius: no step moves the value by more than 3 % of the largest.
fn continuous(values: &[f32]) {
    let largest = values.iter().copied().fold(0.0, f32::max);
    assert!(largest > 0.0 && largest.is_finite());
    for (index, pair) in values.windows(2).enumerate() {
        assert!((pair[1] - pair[0]).abs() < 0.03 * largest, "step {index}: {pair:?} of {largest}");
    }
}

#[test]
fn nothing_jumps_where_the_point_enters_the_sphere() {
    let toward = Vec3::new(-0.3, 0.9, 0.1).normalize();
    // Inside, a value stays below 2/r² Φ f_x f_j of the largest reflectances.
    let lambert = FRAC_1_PI.powi(2);
    for (brdf, reflectances) in [(Brdf::lambert(Vec3::ONE), lambert), (glossy(0.5), 1.5)] {
        let places = (1..200).map(|step| (toward * (0.005 * step as f32), -toward));
        let values = along(places, brdf, 0.5);
        continuous(&values);
        let bound = 2.0 / 0.25 * reflectances;
        assert!(values.iter().all(|&value| value < bound), "{values:?}");
    }
}

#[test]
fn nothing_jumps_where_the_sphere_sinks_below_the_horizon() {
    for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.5)] {
        let places =
            (0..260).map(|step| (Vec3::new(-0.8, 0.8 - 0.005 * step as f32, 0.1), Vec3::X));
        let values = along(places, brdf, 0.4);
        continuous(&values);
        // A centre below the horizon still lights by what is above it; at the end nothing is.
        assert!(values[165] > 0.0 && values[259] == 0.0);
    }
}

/// Lengths times s and flux times s²: the same picture, with the same samples.
#[test]
fn the_unit_of_length_does_not_matter() {
    let pair = |size: f32| {
        let mut sphere = light(size * Vec3::new(-0.3, 0.4, 0.1), -Vec3::Y, glossy(0.7), 0.3 * size);
        sphere.light.flux *= size * size;
        (SurfaceRecord::new(Vec3::ZERO, Vec3::Y, glossy(0.6)), sphere)
    };
    for sampling in SAMPLINGS {
        let settings = Settings { directions: 25, sampling, ..SETTINGS };
        let value = |size: f32| {
            let (surface, sphere) = pair(size);
            let camera = size * CAMERA;
            gather(&GPU, &[surface], camera, &[sphere], &settings, 0).expect("a gather")[0][0]
        };
        let metre = value(1.0);
        assert!(metre > 0.0);
        for size in [1e-3, 1e4] {
            let error = (value(size) / metre - 1.0).abs();
            assert!(error < 1e-5, "{sampling:?} {size}: {error}");
        }
    }
}

#[test]
fn back_faces_are_dark() {
    let receiver = SurfaceRecord::new(Vec3::ZERO, Vec3::Y, glossy(0.3));
    for sampling in SAMPLINGS {
        let settings = Settings { sampling, ..SETTINGS };
        // Below the receiver; above it but shining away; on the same plane, shining the same way.
        let below = light(Vec3::new(0.2, -1.0, 0.3), Vec3::Y, glossy(0.3), 0.5);
        let away = light(Vec3::new(0.2, 1.0, 0.3), Vec3::Y, glossy(0.3), 0.5);
        let beside = light(Vec3::new(0.2, 0.0, 0.3), Vec3::Y, glossy(0.3), 0.5);
        for sphere in [below, away, beside] {
            assert_eq!(radiance(receiver, sphere, &settings), 0.0, "{sampling:?} {sphere:?}");
        }
    }
}

/// Lights at, next to and around the shaded point, of any radius, on smooth and rough surfaces.
#[test]
fn nothing_is_ever_non_finite() {
    let mut surfaces = Vec::new();
    for roughness in [0.01, 0.05, 0.3, 1.0] {
        for tilt in [0.0, 1.0, FRAC_PI_2 - 1e-3, FRAC_PI_2 - 1e-6] {
            // From facing the camera to within 1e-6 of its horizon.
            let (view, side) = (CAMERA.normalize(), CAMERA.any_orthonormal_vector());
            let normal = (tilt.cos() * view + tilt.sin() * side).normalize();
            surfaces.push(SurfaceRecord::new(Vec3::ZERO, normal, glossy(roughness)));
        }
    }
    let mut lights = Vec::new();
    for radius in [0.0, 1e-20, 1e-6, 0.1, 1.0, 1e10] {
        for distance in [0.0, 1e-18, 1e-7, 0.1, 1.0, 1e6] {
            for normal in [-Vec3::Y, Vec3::X] {
                let place = distance * Vec3::new(0.3, 0.9, -0.1);
                lights.push(light(place, normal, glossy(0.05), radius));
            }
        }
    }
    for sampling in SAMPLINGS {
        for directions in [1, 25] {
            let settings = Settings { directions, sampling, ..SETTINGS };
            let pixels = gather(&GPU, &surfaces, CAMERA, &lights, &settings, 0).expect("a gather");
            for (surface, pixel) in surfaces.iter().zip(pixels) {
                // A value that is not finite would stay so in the sum over the lights.
                let finite = pixel.iter().all(|value| value.is_finite() && *value >= 0.0);
                assert!(finite, "{sampling:?} {surface:?}: {pixel:?}");
            }
        }
    }
}

/// A camera that rounding puts on the receiver's horizon, and lights on it.
#[test]
fn a_view_on_the_horizon_is_finite() {
    let surfaces = [SurfaceRecord::new(Vec3::ZERO, Vec3::Y, glossy(0.3))];
    let lights = [0.0, 0.4].map(|radius| light(Vec3::NEG_X, Vec3::X, glossy(0.3), radius));
    for eye in [Vec3::X, Vec3::new(1.0, -1e-8, 0.0), Vec3::new(1.0, 1e-30, 0.0)] {
        for sampling in SAMPLINGS {
            let settings = Settings { sampling, ..SETTINGS };
            let pixels = gather(&GPU, &surfaces, eye, &lights, &settings, 0).expect("a gather");
            let finite = pixels[0].iter().all(|value| value.is_finite() && *value >= 0.0);
            assert!(finite, "{sampling:?} {eye}: {pixels:?}");
        }
    }
}

#[test]
fn no_lights_are_a_black_picture() {
    let surfaces = [SurfaceRecord::new(Vec3::ZERO, Vec3::Y, glossy(0.3))];
    let pixels = gather(&GPU, &surfaces, CAMERA, &[], &SETTINGS, 0).expect("a gather");
    assert_eq!(pixels, [[0.0; 3]]);
}

/// One cell: no neighbour, so the rules that ask for neighbours make a point of it.
#[test]
fn a_single_light_is_a_picture() {
    for radius in
        [RadiusRule::NearestNeighbours, RadiusRule::MapNeighbours, RadiusRule::FieldOfView]
    {
        let picture = render("trio", [16, 12], &Settings { lights: 1, radius, ..SETTINGS }, 0);
        assert!(!picture.lights.is_empty(), "{radius:?}");
        assert!(picture.image.pixels.iter().flatten().all(|value| value.is_finite()));
        let all: f32 = picture.image.pixels.iter().flatten().sum();
        assert!(all > 0.0, "{radius:?}");
    }
}
