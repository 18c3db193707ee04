//! What the linked WGSL holds.

use crate::common::{GPU, LOBES, SETTINGS};
use manylights_gpu::{Binding, Reflectances};
use manylights_vsgl::{Settings, filter_shader, linked_shader};

const LAMBERT: Reflectances =
    Reflectances { specular: false, exact_fresnel: false, measured: Vec::new() };
const GLOSSY: Reflectances =
    Reflectances { specular: true, exact_fresnel: false, measured: Vec::new() };
const EXACT: Reflectances =
    Reflectances { specular: true, exact_fresnel: true, measured: Vec::new() };

#[test]
fn a_lambertian_scene_links_no_ggx() {
    let gather = linked_shader(&LAMBERT, false, false, &SETTINGS).expect("links").wgsl;
    let filter = filter_shader(&LAMBERT).expect("links");
    for (name, wgsl) in [("gather", &gather), ("filter", &filter)] {
        for word in ["glossy", "schlick", "smith", "albedos", "Mirror"] {
            assert!(!wgsl.contains(word), "`{word}` in the Lambertian {name}:\n{wgsl}");
        }
    }
    let glossy = linked_shader(&GLOSSY, true, false, &SETTINGS).expect("links").wgsl;
    assert!(glossy.contains("smith_view"));
    assert!(filter_shader(&GLOSSY).expect("links").contains("albedos"));
}

#[test]
fn the_exact_term_is_linked_where_it_is_needed() {
    let shaders = [&GLOSSY, &EXACT].map(|kinds| {
        let gather = linked_shader(kinds, true, false, &SETTINGS).expect("links").wgsl;
        [gather, filter_shader(kinds).expect("links")]
    });
    let [[plain, plain_filter], [exact, exact_filter]] = shaders;
    assert!(!plain.contains("relative_fresnel") && exact.contains("relative_fresnel"));
    assert!(!plain_filter.contains("exact_lobes") && exact_filter.contains("exact_lobes"));
}

#[test]
fn the_other_lobe_is_not_in_the_shader() {
    let [anisotropic, filtered] = LOBES.map(|lobe| {
        linked_shader(&GLOSSY, true, false, &Settings { lobe, ..SETTINGS }).expect("links").wgsl
    });
    assert!(!anisotropic.contains("visible_share") && filtered.contains("visible_share"));
    assert!(!filtered.contains("narrow") && anisotropic.contains("narrow"));
}

#[test]
fn every_permutation_is_valid() {
    for lobe in LOBES {
        for (kinds, lights) in
            [(&LAMBERT, false), (&GLOSSY, false), (&GLOSSY, true), (&EXACT, false), (&EXACT, true)]
        {
            for traced in [false, true] {
                let settings = Settings { lobe, ..SETTINGS };
                let shader = linked_shader(kinds, lights, traced, &settings).expect("links");
                shader.compile(&GPU).map(|_| ()).expect("valid WGSL");
            }
        }
    }
    let [uniform, read, write] = [Binding::Uniform, Binding::Storage, Binding::StorageMut];
    for (kinds, tables) in [(LAMBERT, 0), (GLOSSY, 1), (EXACT, 2)] {
        let mut bindings = vec![uniform, read, read, write, write];
        bindings.resize(5 + tables, read);
        let wgsl = filter_shader(&kinds).expect("links");
        GPU.kernel("filter", &wgsl, &bindings).map(|_| ()).expect("valid WGSL");
    }
}
