//! The adapter's gather against the f64 oracle.

use crate::common;
use crate::common::{Picture, render};
use manylights_vpl::Settings;

const PLAIN: Settings = Settings { lights: 256, clamp: None, attenuation_radius: None };

/// Largest difference of any pixel to the oracle, relative to the picture's largest component.
///
/// Single pixels may differ by more of their own value: next to a light, 1/d² amplifies the rounding
/// of positions. What counts is what the picture shows.
fn worst(scene: &str, settings: &Settings) -> f64 {
    let Picture { image, oracle, .. } = render(scene, [48, 36], settings);
    let peak = oracle.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
    let difference =
        image.pixels.iter().zip(&oracle).map(|(pixel, truth)| {
            (glam::Vec3::from(*pixel).as_dvec3() - truth).abs().max_element()
        });
    let worst = difference.fold(0.0, f64::max) / peak;
    println!("{scene} {settings:?}: {worst:.2e}");
    worst
}

#[test]
fn lambertian_scene() {
    assert!(worst("cornell", &PLAIN) < 1e-5);
}

#[test]
fn glossy_scenes() {
    for scene in ["cornell-glossy", "atrium", "trio", "../../scenes/trio-merl.toml"] {
        assert!(worst(scene, &PLAIN) < 1e-5, "{scene}");
    }
}

#[test]
fn clamp_and_attenuation() {
    let clamped = Settings { clamp: Some(0.7), ..PLAIN };
    let attenuated = Settings { attenuation_radius: Some(0.3), ..PLAIN };
    let both = Settings { clamp: Some(0.7), attenuation_radius: Some(0.3), ..PLAIN };
    for settings in [clamped, attenuated, both] {
        assert!(worst("cornell-glossy", &settings) < 1e-5, "{settings:?}");
    }
}

#[test]
fn the_clamp_bounds_and_the_attenuation_dims() {
    let sum = |settings: &Settings| {
        let picture = render("cornell", [48, 36], settings);
        picture.oracle.iter().map(|pixel| pixel.element_sum()).sum::<f64>()
    };
    let plain = sum(&PLAIN);
    assert!(sum(&Settings { clamp: Some(0.3), ..PLAIN }) < 0.999 * plain);
    assert!(sum(&Settings { attenuation_radius: Some(0.5), ..PLAIN }) < 0.999 * plain);
}

#[test]
fn same_seed_same_image_and_other_seed_other_image() {
    let first = render("trio", [32, 24], &PLAIN).image;
    assert_eq!(first, render("trio", [32, 24], &PLAIN).image);
    let other = common::render_with_seed("trio", [32, 24], &PLAIN, 1).image;
    assert_ne!(first, other);
}
