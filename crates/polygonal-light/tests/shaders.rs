//! What the linked WGSL holds.

use crate::common::{GPU, exact, settings};
use manylights_polygonal_light::{Edges, Narrow, Settings, TriangleForm, linked_shader};
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
    let wgsl = linked_shader(ReceiverKinds::default(), &exact(Edges::Own)).expect("links").wgsl;
    for word in ["shapes", "glossy", "specular", "lobe_dot", "polygon_weights", "evaluate"] {
        assert!(!wgsl.contains(word), "`{word}` in the exact Lambertian shader:\n{wgsl}");
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
        for settings in TriangleForm::ALL.map(settings).into_iter().chain([exact(Edges::Own)]) {
            let shader = linked_shader(kinds, &Settings { bands, ..settings });
            shader.expect("links").compile(&GPU).map(|_| ()).expect("valid WGSL");
        }
    }
}

/// Edges, solid angles and narrow lobes have one arc tangent, far triangles of bands and of narrow lobes one rule.
#[test]
fn formulas_are_there_once() {
    let narrow = ReceiverKinds { specular: true, narrow: true, ..ReceiverKinds::default() };
    for settings in [exact(Edges::Own), settings(TriangleForm::SolidAngle)] {
        let settings = Settings { narrow: Narrow::Transformed, ..settings };
        let wgsl = linked_shader(narrow, &settings).expect("links").wgsl;
        assert_eq!(wgsl.matches("arc_tangent(y: f32").count(), 1, "{wgsl}");
        assert_eq!(wgsl.matches("0.101286507").count(), 1, "{wgsl}");
    }
}
