//! What the linked WGSL holds.

mod common;

use common::{GPU, LOBES, SETTINGS};
use manylights_gpu::Binding;
use manylights_vsgl::{Settings, filter_shader, linked_shader};

#[test]
fn a_lambertian_scene_links_no_ggx() {
    let gather = linked_shader(false, false, false, &SETTINGS).expect("links");
    let filter = filter_shader(false).expect("links");
    for (name, wgsl) in [("gather", &gather), ("filter", &filter)] {
        for word in ["glossy", "schlick", "smith", "albedos", "Mirror"] {
            assert!(!wgsl.contains(word), "`{word}` in the Lambertian {name}:\n{wgsl}");
        }
    }
    assert!(linked_shader(true, true, false, &SETTINGS).expect("links").contains("smith_view"));
    assert!(filter_shader(true).expect("links").contains("albedos"));
}

#[test]
fn the_other_lobe_is_not_in_the_shader() {
    let [anisotropic, filtered] = LOBES.map(|lobe| {
        linked_shader(true, true, false, &Settings { lobe, ..SETTINGS }).expect("links")
    });
    assert!(!anisotropic.contains("visible_share") && filtered.contains("visible_share"));
    assert!(!filtered.contains("narrow") && anisotropic.contains("narrow"));
}

#[test]
fn every_permutation_is_valid() {
    let bindings =
        [Binding::Uniform, Binding::Storage, Binding::Batch, Binding::StorageMut, Binding::Storage];
    for lobe in LOBES {
        for (receivers, lights) in [(false, false), (true, false), (true, true)] {
            for traced in [false, true] {
                let settings = Settings { lobe, ..SETTINGS };
                let wgsl = linked_shader(receivers, lights, traced, &settings).expect("links");
                GPU.kernel("gather", &wgsl, &bindings).map(|_| ()).expect("valid WGSL");
            }
        }
    }
    let [uniform, read, write] = [Binding::Uniform, Binding::Storage, Binding::StorageMut];
    for (specular, bindings) in [(false, vec![]), (true, vec![read])] {
        let bindings = [vec![uniform, read, read, write, write], bindings].concat();
        let wgsl = filter_shader(specular).expect("links");
        GPU.kernel("filter", &wgsl, &bindings).map(|_| ()).expect("valid WGSL");
    }
}
