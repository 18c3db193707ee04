//! No energy jumps, nothing non-finite: groups that are empty, tiny or far away, receivers inside the
//! cloud of texels, lobes of all widths.

use std::f32::consts::FRAC_PI_2;

use crate::common::{
    FITTED, GPU, SETTINGS, VARIANTS, empty, glossy, lobe, preset, render, surface, texel,
};
use glam::Vec3;
use manylights_gpu::SurfaceRecord;
use manylights_scene::Brdf;
use manylights_virtual_lights::LitTexel;
use manylights_vsgl::{
    Approximation, GaussianLight, GaussianLobe, Settings, filter_group, gather, oracle,
};

const CAMERA: Vec3 = Vec3::new(0.6, 1.0, -0.2);

fn both(lobe: GaussianLobe) -> GaussianLight {
    let specular = GaussianLobe { sharpness: 30.0 * lobe.sharpness, ..lobe };
    let (center, geometric_normal) = (lobe.position, lobe.axis);
    GaussianLight { diffuse: lobe, specular, center, geometric_normal }
}

#[test]
fn empty_groups_are_no_lights() {
    assert_eq!(filter_group(&GPU, &[empty(); 9], Approximation::Filtered).expect("a filter"), None);
    // Lit, but black: nothing is emitted.
    let black = texel(Vec3::ONE, Vec3::Y, Vec3::Y, Brdf::lambert(Vec3::ZERO));
    assert_eq!(filter_group(&GPU, &[black; 4], Approximation::Filtered).expect("a filter"), None);
}

/// One lit texel among empty ones is the light of that texel, wherever it stands.
#[test]
fn one_lit_texel_among_empty_ones() {
    let one = texel(Vec3::new(3.0, -1.0, 2.0), Vec3::Y, Vec3::new(0.6, 0.8, 0.0), glossy(0.2));
    let alone = filter_group(&GPU, &[one], Approximation::Filtered).expect("a filter");
    assert!(alone.is_some());
    for place in [0, 8, 63, 64, 195] {
        let mut texels = [empty(); 196];
        texels[place] = one;
        let found = filter_group(&GPU, &texels, Approximation::Filtered).expect("a filter");
        assert_eq!(found, alone, "{place}");
    }
}

/// Texels of a curved patch of one metre, `size` times as large, that starts at `origin`.
fn curved(origin: Vec3, size: f32, roughness: f32) -> Vec<(SurfaceRecord, LitTexel)> {
    let texels = (0..196).map(|i| {
        let (x, y) = ((i % 14) as f32 / 14.0, (i / 14) as f32 / 14.0);
        let normal = Vec3::new(0.4 * x, 1.0, 0.3 * y - 0.1).normalize();
        let incoming = Vec3::new(0.5 - 0.1 * x, 0.8, 0.1 * y).normalize();
        let local = Vec3::new(x, -0.2 * x * x - 0.15 * y * y, y);
        let (surface, mut lit) = texel(origin + size * local, normal, incoming, glossy(roughness));
        lit.variance = (size / 14.0).powi(2) / 12.0;
        lit.flux = Vec3::new(1.0, 0.5 + x, 2.0 * y);
        (surface, lit)
    });
    texels.collect()
}

/// Places of the texels are rounded where the group is far from the origin; the sums over them lose
/// nothing more.
#[test]
fn filtering_keeps_its_digits() {
    for roughness in [0.03, 0.1, 0.3, 1.0] {
        for (size, origin) in [(1.0, 0.0), (1e-3, 0.0), (1e4, 0.0), (1.0, 1e4), (1e-2, 1e4)] {
            let texels = curved(origin * Vec3::new(0.3, -0.7, 0.6), size, roughness);
            let by = Approximation::Filtered;
            let found = filter_group(&GPU, &texels, by).expect("a filter").expect("a light");
            let truths = oracle::filter(&texels, by);
            for (found, truth) in [found.diffuse, found.specular].into_iter().zip(truths) {
                let place = found.position.as_dvec3() - truth.position;
                // Half of the last digit of the mean place, which f32 must hold.
                let digit = 1e-7 * truth.position.length() + 1e-6 * f64::from(size);
                assert!(place.length() < digit, "{roughness} {size} {origin}: {place}");
                let relative = |found: f32, truth: f64| (f64::from(found) / truth - 1.0).abs();
                let variance = relative(found.variance, truth.variance);
                let sharpness = relative(found.sharpness, truth.sharpness);
                let power = relative(found.power.y, truth.power.y);
                let axis = (found.axis.as_dvec3() - truth.axis).length();
                println!(
                    "roughness {roughness}, {size} m at {origin}: variance {variance:.1e}, \
                     sharpness {sharpness:.1e}, power {power:.1e}, axis {axis:.1e}"
                );
                let worst = variance.max(sharpness).max(power).max(axis);
                assert!(worst < 1e-4, "{roughness} {size} {origin}: {found:?} {truth:?}");
            }
        }
    }
}

/// Lights at, next to and around the shaded point, of any extent, on smooth and rough surfaces, seen
/// from the front to within 1e-6 of the horizon.
#[test]
fn nothing_is_ever_non_finite() {
    let mut surfaces = Vec::new();
    let brdfs = [0.03, 0.1, 0.3, 1.0].map(glossy).into_iter().chain(FITTED.map(preset));
    for brdf in brdfs {
        for tilt in [0.0, 1.0, FRAC_PI_2 - 1e-3, FRAC_PI_2 - 1e-6] {
            let (view, side) = (CAMERA.normalize(), CAMERA.any_orthonormal_vector());
            let normal = (tilt.cos() * view + tilt.sin() * side).normalize();
            surfaces.push(surface(Vec3::ZERO, normal, brdf));
        }
    }
    let mut lights = Vec::new();
    for variance in [0.0, 1e-20, 1e-6, 0.1, 1.0, 1e10] {
        for distance in [0.0, 1e-18, 1e-7, 0.1, 1.0, 1e6] {
            for axis in [-Vec3::Y, Vec3::X] {
                for sharpness in [0.0, 2.3, 1e6, 2.2e12] {
                    let place = distance * Vec3::new(0.3, 0.9, -0.1);
                    lights.push(both(lobe(place, axis, sharpness, variance)));
                }
            }
        }
    }
    for settings in VARIANTS {
        let pixels = gather(&GPU, &surfaces, CAMERA, &lights, &settings).expect("a gather");
        for (surface, pixel) in surfaces.iter().zip(pixels) {
            // A value that is not finite would stay so in the sum over the lights.
            let finite = pixel.iter().all(|value| value.is_finite() && *value >= 0.0);
            assert!(finite, "{settings:?} {surface:?}: {pixel:?}");
        }
    }
}

/// Values along a path of the receiver, which a camera far away sees under one angle, past a light at
/// the origin: steps of 2.5 % of the cloud's width move the value by no more than 3 % of the largest.
fn continuous(brdf: Brdf, settings: &Settings, places: impl Iterator<Item = Vec3>, axis: Vec3) {
    let surfaces: Vec<_> = places.map(|place| surface(place, Vec3::Y, brdf)).collect();
    let light = both(lobe(Vec3::ZERO, axis, 2.2925, 0.04));
    let values = gather(&GPU, &surfaces, 1e4 * CAMERA, &[light], settings).expect("a gather");
    let largest = values.iter().map(|value| value[0]).fold(0.0, f32::max);
    assert!(largest > 0.0 && largest.is_finite());
    for (index, pair) in values.windows(2).enumerate() {
        let jump = (pair[1][0] - pair[0][0]).abs();
        assert!(jump < 0.03 * largest, "step {index} of {brdf:?}: {pair:?} of {largest}");
    }
}

#[test]
fn nothing_jumps_inside_the_cloud_or_at_the_horizon() {
    for settings in VARIANTS {
        for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.5)] {
            let toward = Vec3::new(0.3, -0.9, -0.1).normalize();
            let through = (0..240).map(|step| toward * (0.005 * (step - 120) as f32));
            continuous(brdf, &settings, through, toward);
            let sinking = (0..240).map(|step| Vec3::new(0.4, 0.005 * step as f32 - 0.6, -0.1));
            continuous(brdf, &settings, sinking, Vec3::X);
        }
    }
}

/// Lengths times s and flux times s²: the same picture.
#[test]
fn the_unit_of_length_does_not_matter() {
    for settings in VARIANTS {
        let value = |size: f32| {
            let mut light = both(lobe(
                size * Vec3::new(-0.3, 0.4, 0.1),
                Vec3::NEG_Y,
                2.2925,
                0.01 * size * size,
            ));
            light.diffuse.power *= size * size;
            light.specular.power *= size * size;
            let receiver = surface(Vec3::ZERO, Vec3::Y, glossy(0.6));
            gather(&GPU, &[receiver], size * CAMERA, &[light], &settings).expect("a gather")[0][0]
        };
        let metre = value(1.0);
        assert!(metre > 0.0);
        for size in [1e-3, 1e4] {
            let error = (value(size) / metre - 1.0).abs();
            assert!(error < 1e-5, "{settings:?} {size}: {error}");
        }
    }
}

/// A Gaussian has no horizon: what a surface sends behind itself, and takes from behind, is bounded by
/// the lobe's own value there.
#[test]
fn little_leaks_behind() {
    let receiver = surface(Vec3::ZERO, Vec3::Y, Brdf::lambert(Vec3::ONE));
    let value = |place: Vec3, axis: Vec3| {
        let mut light = both(lobe(place, axis, 2.2925, 1e-4));
        light.specular.power = Vec3::ZERO;
        gather(&GPU, &[receiver], CAMERA, &[light], &SETTINGS).expect("a gather")[0][0]
    };
    let facing = value(Vec3::Y, Vec3::NEG_Y);
    let away = value(Vec3::Y, Vec3::Y) / facing;
    // exp(−2 λ)
    assert!((away / (-2.0_f32 * 2.2925).exp() - 1.0).abs() < 1e-2, "{away}");
    let below = value(Vec3::NEG_Y, Vec3::Y) / facing;
    assert!(below < 1e-6, "{below}");
}

/// One group: a picture.
#[test]
fn a_single_light_is_a_picture() {
    for texels in [1, 2, 3, 17] {
        let picture = render("trio", [16, 12], &Settings { lights: 1, texels, ..SETTINGS }, 0);
        assert!(!picture.lights.is_empty());
        assert!(picture.image.pixels.iter().flatten().all(|value| value.is_finite()));
        let all: f32 = picture.image.pixels.iter().flatten().sum();
        assert!(all > 0.0);
    }
}
