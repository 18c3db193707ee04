//! What the linked WGSL holds.

use manylights_gpu::{Binding, Gpu};
use manylights_vpl::{Settings, linked_shader};

fn every_setting() -> Vec<Settings> {
    let options = [None, Some(1.0)];
    options
        .iter()
        .flat_map(|&clamp| options.iter().map(move |&radius| Settings { lights: 1, clamp, radius }))
        .collect()
}

#[test]
fn a_lambertian_scene_links_no_ggx() {
    for settings in every_setting() {
        let wgsl = linked_shader(false, false, false, &settings).expect("links");
        for word in ["alpha2", "glossy", "schlick", "specular", "smith"] {
            assert!(!wgsl.contains(word), "`{word}` in the Lambertian shader:\n{wgsl}");
        }
    }
    let glossy = linked_shader(true, true, false, &every_setting()[0]).expect("links");
    assert!(glossy.contains("schlick") && glossy.contains("smith_view"));
}

#[test]
fn options_that_are_off_are_not_in_the_shader() {
    let plain = linked_shader(true, true, false, &every_setting()[0]).expect("links");
    for word in ["attenuation", "view.clamp", "hidden"] {
        assert!(!plain.contains(word), "`{word}` in:\n{plain}");
    }
}

#[test]
fn every_permutation_is_valid() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let bindings =
        [Binding::Uniform, Binding::Storage, Binding::Batch, Binding::StorageMut, Binding::Storage];
    for settings in every_setting() {
        for (receivers, lights) in [(false, false), (true, false), (true, true)] {
            for traced in [false, true] {
                let wgsl = linked_shader(receivers, lights, traced, &settings).expect("links");
                gpu.kernel("gather", &wgsl, &bindings).map(|_| ()).expect("valid WGSL");
            }
        }
    }
}
