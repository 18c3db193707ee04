//! What the linked WGSL holds.

use crate::tensor;
use manylights_gpu::{Gpu, Reflectances};
use manylights_scene::Measured;
use manylights_virtual_lights::RadiusRule;
use manylights_vsl::{Sampling, Settings, linked_shader};

const SAMPLINGS: [Sampling; 3] = [Sampling::Brdf, Sampling::Cone, Sampling::Both];

const LAMBERT: Reflectances =
    Reflectances { specular: false, exact_fresnel: false, measured: Vec::new() };
const GLOSSY: Reflectances =
    Reflectances { specular: true, exact_fresnel: false, measured: Vec::new() };

fn settings(sampling: Sampling) -> Settings {
    Settings { lights: 1, directions: 9, sampling, radius: RadiusRule::FieldOfView, scale: 1.0 }
}

#[test]
fn a_lambertian_scene_links_no_ggx() {
    for sampling in SAMPLINGS {
        let wgsl = linked_shader(&LAMBERT, false, false, &settings(sampling)).expect("links").wgsl;
        for word in ["glossy", "schlick", "specular", "smith"] {
            assert!(!wgsl.contains(word), "`{word}` in the Lambertian shader:\n{wgsl}");
        }
    }
    let glossy =
        linked_shader(&GLOSSY, true, false, &settings(Sampling::Both)).expect("links").wgsl;
    assert!(glossy.contains("schlick") && glossy.contains("smith_view"));
    assert!(!glossy.contains("relative_fresnel") && !glossy.contains("measured"));
}

#[test]
fn strategies_that_are_off_are_not_in_the_shader() {
    let cone = linked_shader(&GLOSSY, true, false, &settings(Sampling::Cone)).expect("links").wgsl;
    assert!(!cone.contains("glossy_density") && !cone.contains("in_cosine_lobe"));
    let brdf = linked_shader(&GLOSSY, true, false, &settings(Sampling::Brdf)).expect("links").wgsl;
    assert!(!brdf.contains("in_cone") && brdf.contains("in_cosine_lobe"));
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
    for sampling in SAMPLINGS {
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
                let settings = settings(sampling);
                let shader = linked_shader(kinds, lights, traced, &settings).expect("links");
                shader.compile(&gpu).map(|_| ()).expect("valid WGSL");
            }
        }
    }
}
