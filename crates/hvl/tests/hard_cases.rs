//! No energy jumps, nothing non-finite: where spheres touch, swallow or shrink.

use std::f32::consts::FRAC_PI_2;

use crate::common::{GPU, SETTINGS, glossy, light, metal, render, surface};
use glam::Vec3;
use manylights_gpu::SurfaceRecord;
use manylights_hvl::{Horizon, Settings, VirtualSphere, gather};
use manylights_reflectance::Form;
use manylights_scene::Brdf;
use manylights_scene::Visibility;
use manylights_virtual_lights::RadiusRule;

const CAMERA: Vec3 = Vec3::new(0.6, 1.0, -0.2);

/// Every form, horizon and kind of emission.
fn all_settings() -> [Settings; 4] {
    let exact = Settings { horizon: Horizon::Exact, ..SETTINGS };
    let zonal = Settings { form: Form::Zonal, ..SETTINGS };
    [
        SETTINGS,
        Settings { emission_bands: 3, ..exact },
        Settings { emission_bands: 3, ..zonal },
        Settings { form: Form::Zonal, ..exact },
    ]
}

fn radiance(surface: SurfaceRecord, sphere: VirtualSphere, settings: &Settings) -> f32 {
    let pixels = gather(&GPU, &[surface], CAMERA, &[sphere], settings).expect("a gather");
    pixels[0][0]
}

/// Values of a receiver along a path of the light, which has one normal; so far from the camera that the
/// receivers may move instead.
fn along(
    places: impl Iterator<Item = Vec3>,
    normal: Vec3,
    brdf: Brdf,
    radius: f32,
    settings: &Settings,
) -> Vec<f32> {
    let receivers: Vec<_> = places.map(|place| surface(-place, Vec3::Y, brdf)).collect();
    let sphere = light(Vec3::ZERO, normal, brdf, radius);
    let pixels = gather(&GPU, &receivers, 1e4 * CAMERA, &[sphere], settings).expect("a gather");
    pixels.into_iter().map(|pixel| pixel[0]).collect()
}

/// Steps of the path are 1 % of the radius. Where the point leaves the sphere, 1/d² takes over, 2 % a
/// step, and the cap shrinks by 0.14 rad in the first one.
fn continuous(values: &[f32], settings: &Settings) {
    let largest = values.iter().copied().fold(0.0, f32::max);
    assert!(largest > 0.0 && largest.is_finite());
    for (index, pair) in values.windows(2).enumerate() {
        let step = (pair[1] - pair[0]).abs();
        assert!(step < 0.05 * largest, "step {index}: {pair:?} of {largest}, {settings:?}");
    }
}

#[test]
fn nothing_jumps_where_the_point_enters_the_sphere() {
    let toward = Vec3::new(-0.3, 0.9, 0.1).normalize();
    for settings in all_settings() {
        for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.5)] {
            let places = (1..200).map(|step| toward * (0.005 * step as f32));
            continuous(&along(places, -toward, brdf, 0.5, &settings), &settings);
        }
    }
}

#[test]
fn nothing_jumps_where_the_sphere_sinks_below_the_horizon() {
    for settings in all_settings() {
        for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.5)] {
            let places = (0..260).map(|step| Vec3::new(-0.8, 0.8 - 0.005 * step as f32, 0.1));
            let values = along(places, Vec3::X, brdf, 0.4, &settings);
            continuous(&values, &settings);
            // At the end nothing is above the horizon.
            assert_eq!(values[259], 0.0, "{settings:?}");
        }
    }
}

/// Lengths times s and flux times s²: the same picture.
#[test]
fn the_unit_of_length_does_not_matter() {
    for settings in all_settings() {
        let value = |size: f32| {
            let mut sphere =
                light(size * Vec3::new(-0.3, 0.4, 0.1), -Vec3::Y, glossy(0.7), 0.3 * size);
            sphere.light.flux *= size * size;
            let surface = surface(Vec3::ZERO, Vec3::Y, glossy(0.6));
            gather(&GPU, &[surface], size * CAMERA, &[sphere], &settings).expect("a gather")[0][0]
        };
        let metre = value(1.0);
        assert!(metre > 0.0);
        for size in [1e-3, 1e4] {
            let error = (value(size) / metre - 1.0).abs();
            assert!(error < 1e-5, "{settings:?} {size}: {error}");
        }
    }
}

#[test]
fn back_faces_are_dark() {
    let receiver = surface(Vec3::ZERO, Vec3::Y, glossy(0.3));
    for settings in all_settings() {
        // Below the receiver; above it but shining away; on the same plane, shining the same way.
        let below = light(Vec3::new(0.2, -1.0, 0.3), Vec3::Y, glossy(0.3), 0.5);
        let away = light(Vec3::new(0.2, 1.0, 0.3), Vec3::Y, glossy(0.3), 0.5);
        let beside = light(Vec3::new(0.2, 0.0, 0.3), Vec3::Y, glossy(0.3), 0.5);
        for sphere in [below, away, beside] {
            assert_eq!(radiance(receiver, sphere, &settings), 0.0, "{settings:?} {sphere:?}");
        }
    }
}

/// Lights at, next to and around the shaded point, of any radius, on smooth and rough surfaces.
#[test]
fn nothing_is_ever_non_finite() {
    let mut surfaces = Vec::new();
    for brdf in [glossy(0.1), glossy(0.3), metal(1.0)] {
        for tilt in [0.0, 1.0, FRAC_PI_2 - 1e-3, FRAC_PI_2 - 1e-6] {
            // From facing the camera to within 1e-6 of its horizon.
            let (view, side) = (CAMERA.normalize(), CAMERA.any_orthonormal_vector());
            let normal = (tilt.cos() * view + tilt.sin() * side).normalize();
            surfaces.push(surface(Vec3::ZERO, normal, brdf));
        }
    }
    let mut lights = Vec::new();
    for radius in [0.0, 1e-20, 1e-6, 0.1, 1.0, 1e10] {
        for distance in [0.0, 1e-18, 1e-7, 0.1, 1.0, 1e6] {
            for normal in [-Vec3::Y, Vec3::X] {
                let place = distance * Vec3::new(0.3, 0.9, -0.1);
                lights.push(light(place, normal, glossy(0.1), radius));
            }
        }
    }
    for settings in all_settings() {
        for bands in [1, 5, 20] {
            let settings = Settings { bands, ..settings };
            let pixels = gather(&GPU, &surfaces, CAMERA, &lights, &settings).expect("a gather");
            for (surface, pixel) in surfaces.iter().zip(pixels) {
                // A value that is not finite would stay so in the sum over the lights.
                assert!(Vec3::from(pixel).is_finite(), "{settings:?} {surface:?}: {pixel:?}");
            }
        }
    }
}

/// One cell: no neighbour, so the rules that ask for neighbours make a point of it.
#[test]
fn a_single_light_is_a_picture() {
    let rules = [
        ("neighbours", RadiusRule::NearestNeighbours),
        ("r1", RadiusRule::MapNeighbours),
        ("r2", RadiusRule::FieldOfView),
        ("fixed", RadiusRule::Fixed),
    ];
    for (word, radius) in rules {
        let texts = [("lights", "1"), ("radius", word)];
        let picture = render(
            "trio",
            [16, 12],
            &texts,
            &Settings { lights: 1, radius, ..SETTINGS },
            Visibility::Ignored,
            0,
        );
        assert!(!picture.lights.is_empty(), "{radius:?}");
        let pixels = picture.image.pixels.as_flattened();
        assert!(pixels.iter().all(|value| value.is_finite() && *value >= 0.0));
        assert!(pixels.iter().sum::<f32>() > 0.0, "{radius:?}");
    }
}
