//! The adapter's gather against the f64 oracle, with the same samples.

use crate::common::{GPU, Picture, SETTINGS, glossy, light, render};
use crate::tensor;
use glam::{DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_virtual_lights::RadiusRule;
use manylights_vsl::{Sampling, Settings, gather};

/// How a picture differs from its oracle.
#[derive(Debug)]
struct Difference {
    /// Largest of any pixel, relative to the picture's largest component.
    worst: f64,
    /// Share of pixels that differ by more than 1e-5 of it.
    odd: f64,
    /// Of the sum over the picture, relative.
    energy: f64,
}

fn difference(scene: &str, settings: &Settings) -> Difference {
    let Picture { image, oracle, .. } = render(scene, [48, 36], settings, 0);
    let peak = oracle.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
    assert!(peak > 0.0, "{scene} is black");
    let pixels: Vec<DVec3> = image.pixels.iter().map(|&p| Vec3::from(p).as_dvec3()).collect();
    let errors: Vec<f64> =
        pixels.iter().zip(&oracle).map(|(p, t)| (p - t).abs().max_element() / peak).collect();
    let sum = |pixels: &[DVec3]| pixels.iter().sum::<DVec3>().element_sum();
    let difference = Difference {
        worst: errors.iter().copied().fold(0.0, f64::max),
        odd: errors.iter().filter(|&&e| e > 1e-5).count() as f64 / errors.len() as f64,
        energy: (sum(&pixels) / sum(&oracle) - 1.0).abs(),
    };
    println!("{scene} {settings:?}: {difference:?}");
    difference
}

/// Materials with the exact Fresnel term.
const PRESETS: &str = "../../scenes/trio-merl.toml";

/// Samples of the cone move with rounding but never leave it: as tight as for point lights.
#[test]
fn cone_samples() {
    for scene in ["cornell", "cornell-glossy", "atrium", "trio", PRESETS] {
        let settings = Settings { sampling: Sampling::Cone, ..SETTINGS };
        assert!(difference(scene, &settings).worst < 1e-5, "{scene}");
    }
}

/// A sample of the lobes at the very rim of a cone may fall on either side in f32 and f64. Single
/// samples of single lights then differ, nothing more.
#[test]
fn lobe_samples() {
    for scene in ["cornell", "cornell-glossy", "atrium", "trio", PRESETS] {
        for sampling in [Sampling::Brdf, Sampling::Both] {
            let Difference { worst, odd, energy } =
                difference(scene, &Settings { sampling, ..SETTINGS });
            assert!(odd < 0.01, "{scene} {sampling:?}: {odd} of the pixels differ");
            assert!(worst < 0.01 && energy < 1e-5, "{scene} {sampling:?}: {worst:e} {energy:e}");
        }
    }
}

/// A measured material: tables are continuous but not smooth.
#[test]
fn measurements() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = folder.path().join("trio.toml");
    std::fs::write(folder.path().join("satin.bsdf"), tensor::satin()).expect("can write");
    let materials = ["floor", "satin"]
        .map(|name| format!("[material.{name}]\nmeasured = \"satin.bsdf\"\n"))
        .concat();
    let text = format!("about = \"a test\"\nsource = \"builtin:trio\"\n{materials}");
    std::fs::write(&scene, text).expect("can write");
    let scene = scene.to_str().expect("UTF-8");
    let cone = Settings { sampling: Sampling::Cone, ..SETTINGS };
    assert!(difference(scene, &cone).worst < 1e-5);
    let Difference { worst, odd, energy } = difference(scene, &SETTINGS);
    assert!(odd < 0.01 && worst < 0.01 && energy < 1e-5, "{odd} {worst:e} {energy:e}");
}

#[test]
fn every_radius_rule() {
    for radius in [RadiusRule::NearestNeighbours, RadiusRule::MapNeighbours] {
        let settings = Settings { sampling: Sampling::Cone, radius, scale: 1.7, ..SETTINGS };
        assert!(difference("cornell-glossy", &settings).worst < 1e-5, "{radius:?}");
    }
}

#[test]
fn same_seed_same_image_and_other_seed_other_image() {
    let first = render("trio", [32, 24], &SETTINGS, 0).image;
    assert_eq!(first, render("trio", [32, 24], &SETTINGS, 0).image);
    assert_ne!(first, render("trio", [32, 24], &SETTINGS, 1).image);
}

/// The lights stay: what differs are the directions alone, which seed, pixel and light choose.
#[test]
fn samples_depend_on_seed_pixel_and_light() {
    let sphere = light(Vec3::new(-0.3, 0.4, 0.1), Vec3::NEG_Y, glossy(0.6), 0.5);
    let surfaces = [SurfaceRecord::new(Vec3::ZERO, Vec3::Y, glossy(0.6)); 2];
    for sampling in [Sampling::Brdf, Sampling::Cone, Sampling::Both] {
        let settings = Settings { sampling, ..SETTINGS };
        let radiance = |lights: &[_], seed| {
            let camera = Vec3::new(0.6, 1.0, -0.2);
            gather(&GPU, &surfaces, camera, lights, &settings, seed).expect("a gather")
        };
        let [first, other_pixel] = radiance(&[sphere], 0)[..] else { panic!("two pixels") };
        assert_eq!(first, radiance(&[sphere], 0)[0]);
        assert_ne!(first, other_pixel, "{sampling:?}");
        for seed in [1, 1 << 32] {
            assert_ne!(first, radiance(&[sphere], seed)[0], "{sampling:?}, seed {seed}");
        }
        assert_ne!(first.map(|c| 2.0 * c), radiance(&[sphere; 2], 0)[0], "{sampling:?}");
    }
}
