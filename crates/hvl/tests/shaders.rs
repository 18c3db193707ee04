//! What the linked WGSL holds.

use crate::common::{FORMS, GPU, SETTINGS};
use manylights_hvl::{Horizon, LobeKinds, Settings, linked_shader};
use manylights_reflectance::{Form, ReceiverKinds};

const NONE: ReceiverKinds = ReceiverKinds {
    specular: false,
    colored: false,
    exact_fresnel: false,
    measured: false,
    narrow: false,
};
const LAMBERT: LobeKinds = LobeKinds { receivers: NONE, lights: false };
const COLORED: ReceiverKinds = ReceiverKinds { specular: true, colored: true, ..NONE };
const GLOSSY: LobeKinds = LobeKinds { receivers: COLORED, lights: true };

#[test]
fn a_lambertian_scene_links_no_ggx() {
    for form in FORMS {
        for horizon in [Horizon::Smooth, Horizon::Exact] {
            let settings = Settings { form, horizon, emission_bands: 3, ..SETTINGS };
            let wgsl = linked_shader(LAMBERT, false, &settings).expect("links").wgsl;
            for word in ["shapes", "glossy", "schlick", "specular", "smith", "lobe_dot", "emission"]
            {
                assert!(!wgsl.contains(word), "`{word}` in the Lambertian shader:\n{wgsl}");
            }
            let other = if horizon == Horizon::Exact { "horizon_smooth" } else { "horizon_exact" };
            assert!(!wgsl.contains(other));
            // The Lambertian lobe of the zonal form is in closed form.
            assert_eq!(wgsl.contains("cap_scales"), form == Form::Full);
            let glossy = linked_shader(GLOSSY, true, &settings).expect("links").wgsl;
            assert!(!glossy.contains("relative_fresnel") && !glossy.contains("blue"));
            assert!(glossy.contains("lobe_dot") && glossy.contains("emission_lobe"));
            assert!(glossy.contains("sh_evaluate_even") && glossy.contains("is_visible"));
        }
    }
}

#[test]
fn every_permutation_is_valid() {
    let of = |receivers, lights| LobeKinds { receivers, lights };
    let lobes = [
        LAMBERT,
        of(ReceiverKinds { specular: true, ..NONE }, false),
        of(COLORED, false),
        of(ReceiverKinds { colored: false, ..COLORED }, true),
        GLOSSY,
        of(ReceiverKinds { exact_fresnel: true, ..COLORED }, true),
        of(ReceiverKinds { measured: true, ..COLORED }, true),
        of(ReceiverKinds { measured: true, exact_fresnel: true, ..COLORED }, true),
    ];
    for form in FORMS {
        for lobes in lobes {
            for (bands, emission_bands) in [(1, 0), (2, 2), (5, 3), (20, 0)] {
                let horizon = if bands % 2 == 0 { Horizon::Smooth } else { Horizon::Exact };
                let settings = Settings { form, bands, emission_bands, horizon, ..SETTINGS };
                let declined = form == Form::Zonal || emission_bands == 0;
                if lobes.receivers.measured && declined {
                    continue;
                }
                for traced in [false, true] {
                    let shader = linked_shader(lobes, traced, &settings).expect("links");
                    shader.compile(&GPU).map(|_| ()).expect("valid WGSL");
                }
            }
        }
    }
}
