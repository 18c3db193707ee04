//! What the linked WGSL holds.

use crate::common::{GPU, all_settings};
use manylights_reflectance::ReceiverKinds;
use manylights_spherical_light::{Coefficients, Extent, Settings, linked_shader};

#[test]
fn a_lambertian_scene_links_no_ggx() {
    for settings in all_settings() {
        let wgsl = linked_shader(ReceiverKinds::default(), &settings).expect("links").wgsl;
        for word in ["shapes", "glossy", "schlick", "specular", "smith", "lobe_dot", "evaluate"] {
            assert!(!wgsl.contains(word), "`{word}` in the Lambertian shader:\n{wgsl}");
        }
        let tabulated = settings.coefficients == Coefficients::Tabulated;
        assert_eq!(wgsl.contains("tabulated_scales"), tabulated);
        assert_eq!(wgsl.contains("cap_scales_of"), !tabulated);
        assert_eq!(wgsl.contains("slant"), settings.extent == Extent::Disc);
    }
}

#[test]
fn every_permutation_is_valid() {
    let specular = ReceiverKinds { specular: true, ..ReceiverKinds::default() };
    let kinds = [
        ReceiverKinds::default(),
        specular,
        ReceiverKinds { colored: true, ..specular },
        ReceiverKinds { colored: true, exact_fresnel: true, ..specular },
        ReceiverKinds { colored: true, measured: true, ..specular },
        ReceiverKinds { measured: true, exact_fresnel: true, ..specular },
    ];
    for (kinds, bands) in kinds.into_iter().flat_map(|kinds| [1, 2, 9, 15].map(|n| (kinds, n))) {
        for settings in all_settings() {
            let settings = Settings { bands, ..settings };
            let shader = linked_shader(kinds, &settings).expect("links");
            shader.compile(&GPU).map(|_| ()).expect("valid WGSL");
        }
    }
}
