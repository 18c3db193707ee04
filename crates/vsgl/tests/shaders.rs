//! What the linked WGSL holds.

use crate::common::{CUT, GPU, SETTINGS, THESIS, VARIANTS};
use manylights_gpu::{Binding, Reflectances};
use manylights_vsgl::{Approximation, filter_shader, linked_shader};

const LAMBERT: Reflectances =
    Reflectances { specular: false, exact_fresnel: false, measured: Vec::new() };
const GLOSSY: Reflectances =
    Reflectances { specular: true, exact_fresnel: false, measured: Vec::new() };
const EXACT: Reflectances =
    Reflectances { specular: true, exact_fresnel: true, measured: Vec::new() };

#[test]
fn a_lambertian_scene_links_no_ggx() {
    let gather = linked_shader(&LAMBERT, false, false, &SETTINGS).expect("links").wgsl;
    let filter = filter_shader(&LAMBERT, Approximation::Filtered).expect("links");
    for (name, wgsl) in [("gather", &gather), ("filter", &filter)] {
        for word in ["glossy", "schlick", "smith", "albedos", "Mirror"] {
            assert!(!wgsl.contains(word), "`{word}` in the Lambertian {name}:\n{wgsl}");
        }
    }
    let glossy = linked_shader(&GLOSSY, true, false, &SETTINGS).expect("links").wgsl;
    assert!(glossy.contains("smith_view"));
    assert!(filter_shader(&GLOSSY, Approximation::Filtered).expect("links").contains("albedos"));
}

#[test]
fn the_exact_term_is_linked_where_it_is_needed() {
    let shaders = [&GLOSSY, &EXACT].map(|kinds| {
        let gather = linked_shader(kinds, true, false, &SETTINGS).expect("links").wgsl;
        [gather, filter_shader(kinds, Approximation::Filtered).expect("links")]
    });
    let [[plain, plain_filter], [exact, exact_filter]] = shaders;
    assert!(!plain.contains("relative_fresnel") && exact.contains("relative_fresnel"));
    assert!(!plain_filter.contains("exact_lobes") && exact_filter.contains("exact_lobes"));
}

#[test]
fn what_is_not_chosen_is_not_in_the_shader() {
    let [thesis, filtered, cut] = [THESIS, SETTINGS, CUT].map(|settings| {
        [&LAMBERT, &GLOSSY].map(|kinds| {
            linked_shader(kinds, kinds.specular, false, &settings).expect("links").wgsl
        })
    });
    for [thesis, filtered] in [0, 1].map(|kinds| [&thesis[kinds], &filtered[kinds]]) {
        assert!(!thesis.contains("clamped_cosine") && filtered.contains("clamped_cosine"));
        assert!(!filtered.contains("gaussian_cosine") && thesis.contains("gaussian_cosine"));
    }
    assert!(!thesis[1].contains("by_filtered_normals"));
    assert!(!filtered[0].contains("visible_share") && cut[0].contains("visible_share"));
    let [thesis, filtered] = [Approximation::Thesis, Approximation::Filtered]
        .map(|lobe| filter_shader(&GLOSSY, lobe).expect("links"));
    assert!(!thesis.contains("root") && filtered.contains("root"));
}

#[test]
fn every_permutation_is_valid() {
    for settings in VARIANTS {
        for (kinds, lights) in
            [(&LAMBERT, false), (&GLOSSY, false), (&GLOSSY, true), (&EXACT, false), (&EXACT, true)]
        {
            for traced in [false, true] {
                let shader = linked_shader(kinds, lights, traced, &settings).expect("links");
                shader.compile(&GPU).map(|_| ()).expect("valid WGSL");
            }
        }
    }
    let [uniform, read, write] = [Binding::Uniform, Binding::Storage, Binding::StorageMut];
    for (kinds, tables) in [(LAMBERT, 0), (GLOSSY, 1), (EXACT, 2)] {
        let mut bindings = vec![uniform, read, read, write, write];
        bindings.resize(5 + tables, read);
        for lobe in [Approximation::Thesis, Approximation::Filtered] {
            let wgsl = filter_shader(&kinds, lobe).expect("links");
            GPU.kernel("filter", &wgsl, &bindings).map(|_| ()).expect("valid WGSL");
        }
    }
}
