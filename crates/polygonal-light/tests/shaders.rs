//! What the linked WGSL holds.

use crate::common::{GPU, settings};
use manylights_polygonal_light::{Settings, TriangleForm, linked_shader};
use manylights_reflectance::ReceiverKinds;

#[test]
fn a_shader_holds_what_its_scene_and_form_need() {
    for form in TriangleForm::ALL {
        let wgsl = linked_shader(ReceiverKinds::default(), &settings(form)).expect("links").wgsl;
        for word in ["shapes", "glossy", "schlick", "specular", "smith", "lobe_dot", "evaluate"] {
            assert!(!wgsl.contains(word), "`{word}` in the Lambertian shader:\n{wgsl}");
        }
        use TriangleForm::{Point, Scaled, SolidAngle};
        let holds = |word: &str| wgsl.contains(word);
        assert_eq!(holds("arc_tangent"), matches!(form, SolidAngle | Scaled | Point), "{form:?}");
        assert_eq!(holds("cap_scales_of"), form != Point, "{form:?}");
        assert_eq!(holds("point_scales"), form == Point, "{form:?}");
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
    ];
    for (kinds, bands) in kinds.into_iter().flat_map(|kinds| [1, 2, 9, 15].map(|n| (kinds, n))) {
        for form in TriangleForm::ALL {
            let shader = linked_shader(kinds, &Settings { bands, ..settings(form) });
            shader.expect("links").compile(&GPU).map(|_| ()).expect("valid WGSL");
        }
    }
}
