//! What the linked WGSL holds.

use manylights_gpu::{Binding, Gpu, RadiusRule};
use manylights_vsl::{Sampling, Settings, linked_shader};

const SAMPLINGS: [Sampling; 3] = [Sampling::Brdf, Sampling::Cone, Sampling::Both];

fn settings(sampling: Sampling) -> Settings {
    Settings { lights: 1, samples: 9, sampling, radius: RadiusRule::FieldOfView, scale: 1.0 }
}

#[test]
fn a_lambertian_scene_links_no_ggx() {
    for sampling in SAMPLINGS {
        let wgsl = linked_shader(false, false, false, &settings(sampling)).expect("links");
        for word in ["glossy", "schlick", "specular", "smith"] {
            assert!(!wgsl.contains(word), "`{word}` in the Lambertian shader:\n{wgsl}");
        }
    }
    let glossy = linked_shader(true, true, false, &settings(Sampling::Both)).expect("links");
    assert!(glossy.contains("schlick") && glossy.contains("smith_view"));
}

#[test]
fn strategies_that_are_off_are_not_in_the_shader() {
    let cone = linked_shader(true, true, false, &settings(Sampling::Cone)).expect("links");
    assert!(!cone.contains("glossy_density") && !cone.contains("in_cosine_lobe"));
    let brdf = linked_shader(true, true, false, &settings(Sampling::Brdf)).expect("links");
    assert!(!brdf.contains("in_cone") && brdf.contains("in_cosine_lobe"));
}

#[test]
fn every_permutation_is_valid() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let bindings =
        [Binding::Uniform, Binding::Storage, Binding::Batch, Binding::StorageMut, Binding::Storage];
    for sampling in SAMPLINGS {
        for (receivers, lights) in [(false, false), (true, false), (true, true)] {
            for traced in [false, true] {
                let settings = settings(sampling);
                let wgsl = linked_shader(receivers, lights, traced, &settings).expect("links");
                gpu.kernel("gather", &wgsl, &bindings).map(|_| ()).expect("valid WGSL");
            }
        }
    }
}
