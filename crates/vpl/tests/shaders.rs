//! What the linked WGSL holds.

use crate::tensor;
use manylights_gpu::{Gpu, Reflectances};
use manylights_scene::Measured;
use manylights_vpl::{Settings, linked_shader};

const LAMBERT: Reflectances =
    Reflectances { specular: false, exact_fresnel: false, measured: Vec::new() };
const GLOSSY: Reflectances =
    Reflectances { specular: true, exact_fresnel: false, measured: Vec::new() };

fn every_setting() -> Vec<Settings> {
    let options = [None, Some(1.0)];
    options
        .iter()
        .flat_map(|&clamp| {
            options.iter().map(move |&attenuation_radius| Settings {
                lights: 1,
                clamp,
                attenuation_radius,
            })
        })
        .collect()
}

#[test]
fn a_lambertian_scene_links_no_ggx() {
    for settings in every_setting() {
        let wgsl = linked_shader(&LAMBERT, false, false, &settings).expect("links").wgsl;
        for word in ["alpha2", "glossy", "schlick", "specular", "smith"] {
            assert!(!wgsl.contains(word), "`{word}` in the Lambertian shader:\n{wgsl}");
        }
    }
    let glossy = linked_shader(&GLOSSY, true, false, &every_setting()[0]).expect("links").wgsl;
    assert!(glossy.contains("schlick") && glossy.contains("smith_view"));
    assert!(!glossy.contains("relative_fresnel") && !glossy.contains("measured"));
}

#[test]
fn options_that_are_off_are_not_in_the_shader() {
    let plain = linked_shader(&GLOSSY, true, false, &every_setting()[0]).expect("links").wgsl;
    for word in ["attenuation", "settings", "occluded"] {
        assert!(!plain.contains(word), "`{word}` in:\n{plain}");
    }
}

#[test]
fn every_permutation_is_valid() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("satin.bsdf");
    std::fs::write(&path, tensor::satin()).expect("can write");
    let measured = vec![Measured::load(&path).expect("valid")];
    let exact = Reflectances { exact_fresnel: true, ..GLOSSY };
    let all = Reflectances { measured, ..exact.clone() };
    for settings in every_setting() {
        for (kinds, lights) in [
            (&LAMBERT, false),
            (&GLOSSY, false),
            (&GLOSSY, true),
            (&exact, false),
            (&exact, true),
            (&all, false),
            (&all, true),
        ] {
            for traced in [false, true] {
                let shader = linked_shader(kinds, lights, traced, &settings).expect("links");
                shader.compile(&gpu).map(|_| ()).expect("valid WGSL");
            }
        }
    }
}
