//! What import leaves out, changes or makes up is said: a valid file whose picture differs from what the
//! specification asks for has a note.

use crate::common::triangle::{
    accessor, attribute, floats, load_with, noted, triangle, two_texels,
};
use manylights_scene::{AreaLight, Scene, load};
use serde_json::{Value, json};

#[test]
fn what_is_not_drawn_is_noted() {
    let scene = load_with(|root| {
        let colors = accessor(root, 5126, "VEC3", 3, &floats(&[1.0; 9]));
        attribute(root, "COLOR_0", colors);
        root["extensionsUsed"] = json!(["KHR_texture_transform", "KHR_materials_ior"]);
        root["materials"] = json!([{ "alphaMode": "MASK" }]);
        root["meshes"][0]["primitives"][0]["material"] = json!(0);
        let line = json!({ "attributes": { "POSITION": 0 }, "mode": 1 });
        root["meshes"][0]["primitives"].as_array_mut().expect("is one").push(line);
        let lens = json!({ "xmag": 1, "ymag": 1, "zfar": 2, "znear": 1 });
        root["cameras"] = json!([{ "type": "orthographic", "orthographic": lens }]);
        root["nodes"][0]["camera"] = json!(0);
    });
    assert_eq!(
        scene.notes,
        [
            "extension KHR_texture_transform ignored: 1",
            "materials with an alpha mask, drawn opaque: 1",
            "orthographic cameras left out: 1",
            "primitives of points or lines left out: 1",
            "primitives whose vertex colours are ignored: 1",
            "primitives without normals, flat ones computed: 1",
            "single-sided materials, drawn from both sides: 1",
            "no light: every picture is black",
            "no camera: framed from outside",
        ]
    );
}

fn with_material(material: Value) -> Scene {
    load_with(|root| {
        root["materials"] = json!([material]);
        root["meshes"][0]["primitives"][0]["material"] = json!(0);
    })
}

/// A triangle with texture coordinates and this as its base-colour texture and sampler.
fn with_sampler(sampler: Value) -> Scene {
    load_with(|root| {
        let zeros = accessor(root, 5126, "VEC2", 3, &floats(&[0.0; 6]));
        attribute(root, "TEXCOORD_0", zeros);
        root["images"] = json!([two_texels([0; 3], [255; 3])]);
        root["samplers"] = json!([sampler]);
        root["textures"] = json!([{ "source": 0, "sampler": 0 }]);
        root["materials"] =
            json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
        root["meshes"][0]["primitives"][0]["material"] = json!(0);
    })
}

#[test]
fn textures_of_the_specular_extension() {
    for (members, count) in [
        (&["specularTexture"][..], 1),
        (&["specularColorTexture"], 1),
        (&["specularTexture", "specularColorTexture"], 2),
    ] {
        let scene = load_with(|root| {
            root["images"] = json!([two_texels([0; 3], [255; 3])]);
            root["textures"] = json!([{ "source": 0 }]);
            let textures: Value =
                members.iter().map(|&name| (name.to_owned(), json!({ "index": 0 }))).collect();
            root["materials"] = json!([{ "extensions": { "KHR_materials_specular": textures } }]);
            root["meshes"][0]["primitives"][0]["material"] = json!(0);
        });
        assert!(noted(&scene, &format!("specular textures ignored: {count}")), "{:?}", scene.notes);
    }
}

#[test]
fn sides_of_materials() {
    for (double, emission) in [(true, 1), (true, 0), (false, 1), (false, 0)] {
        let scene =
            with_material(json!({ "doubleSided": double, "emissiveFactor": [0, emission, 0] }));
        let single = noted(&scene, "single-sided materials, drawn from both sides: 1");
        assert_eq!((single, scene.materials[0].two_sided), (!double, double), "{emission}");
        let lights = scene.all_area_lights();
        let both = |light| matches!(light, AreaLight::Triangle { two_sided, .. } if two_sided);
        assert_eq!(
            lights.filter(|light| both(*light)).count(),
            usize::from(double && emission == 1)
        );
    }
}

#[test]
fn filters_that_show_texels() {
    for (sampler, is_nearest) in [
        (json!({ "magFilter": 9728, "minFilter": 9728 }), true),
        (json!({ "magFilter": 9728 }), true),
        (json!({ "magFilter": 9729, "minFilter": 9728 }), true),
        (json!({ "minFilter": 9984 }), true),
        (json!({ "minFilter": 9986 }), true),
        (json!({}), false),
        (json!({ "magFilter": 9729, "minFilter": 9729 }), false),
        (json!({ "minFilter": 9985 }), false),
        (json!({ "minFilter": 9987 }), false),
    ] {
        let scene = with_sampler(sampler.clone());
        let note = "textures filtered bilinearly against their sampler: 1";
        assert_eq!(noted(&scene, note), is_nearest, "{sampler}");
    }
}

#[test]
fn texture_coordinates_that_are_not_there() {
    let note = "primitives without the texture coordinates that their material asks for, drawn in the \
                colour at (0, 0): 1";
    for (asked, present, is_noted) in [(1, 0, true), (0, 1, true), (0, 0, false), (1, 1, false)] {
        let scene = load_with(|root| {
            let zeros = accessor(root, 5126, "VEC2", 3, &floats(&[0.0; 6]));
            attribute(root, &format!("TEXCOORD_{present}"), zeros);
            root["images"] = json!([two_texels([0; 3], [255; 3])]);
            root["textures"] = json!([{ "source": 0 }]);
            let texture = json!({ "index": 0, "texCoord": asked });
            root["materials"] =
                json!([{ "pbrMetallicRoughness": { "baseColorTexture": texture } }]);
            root["meshes"][0]["primitives"][0]["material"] = json!(0);
        });
        assert_eq!(noted(&scene, note), is_noted, "asked for {asked}, there is {present}");
    }
    assert!(!noted(&load_with(|_| {}), note), "no texture, no coordinates needed");
}

#[test]
fn extensions_count_whether_declared_or_not() {
    let scene = load_with(|root| {
        root["extensionsUsed"] = json!(["KHR_xmp_json_ld", "KHR_materials_sheen"]);
        root["nodes"][0]["extensions"] = json!({ "KHR_node_visibility": { "visible": false } });
        root["nodes"][0]["extras"] = json!({ "extensions": { "NOT_an_extension": {} } });
        let extensions = json!({
            "KHR_materials_sheen": {},
            "KHR_materials_ior": { "extensions": { "KHR_nested": {} } },
        });
        root["materials"] =
            json!([{ "extensions": extensions }, { "extensions": { "KHR_materials_sheen": {} } }]);
    });
    let found: Vec<_> = scene.notes.iter().filter(|note| note.starts_with("extension")).collect();
    assert_eq!(
        found,
        [
            "extension KHR_materials_sheen ignored: 2",
            "extension KHR_nested ignored: 1",
            "extension KHR_node_visibility ignored: 1",
            "extension KHR_xmp_json_ld ignored: 1",
        ]
    );
}

#[test]
fn scenes_that_are_not_drawn() {
    let scene = load_with(|root| root["scenes"] = json!([{ "nodes": [0] }, { "nodes": [] }, {}]));
    assert!(noted(&scene, "scenes besides the one drawn, left out: 2"), "{:?}", scene.notes);
}

#[test]
fn roughness_below_the_smallest() {
    let note = "materials smoother than roughness 0.03, drawn at it: 1";
    for (roughness, is_noted) in [(0.0, true), (0.02, true), (0.03, false), (1.0, false)] {
        let scene =
            with_material(json!({ "pbrMetallicRoughness": { "roughnessFactor": roughness } }));
        assert_eq!(noted(&scene, note), is_noted, "{roughness}");
    }
    let lambertian = json!({
        "pbrMetallicRoughness": { "roughnessFactor": 0, "metallicFactor": 0 },
        "extensions": { "KHR_materials_specular": { "specularFactor": 0 } },
    });
    assert!(!noted(&with_material(lambertian), note), "it has no lobe");
}

#[test]
fn units_of_lights() {
    let note = "lights in candela or lux, taken as W/sr or W/m² (683 times too bright if exported at 683 lm/W): 2";
    let mut root = triangle();
    let lights = json!([{ "type": "point" }, { "type": "directional" }, { "type": "spot" }]);
    root["extensions"] = json!({ "KHR_lights_punctual": { "lights": lights } });
    root["extensions"]["KHR_lights_punctual"]["lights"][2]["spot"] = json!({});
    let node =
        |light| json!({ "mesh": 0, "extensions": { "KHR_lights_punctual": { "light": light } } });
    root["nodes"] = json!([node(0), node(1)]);
    root["scenes"][0]["nodes"] = json!([0, 1]);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("a.gltf"), root.to_string()).expect("can write");
    let load = |name: &str| load(path(name).to_str().expect("UTF-8"), None).expect("valid");
    assert!(noted(&load("a.gltf"), note), "{:?}", load("a.gltf").notes);
    // A scene file that drops them has nothing to say of them.
    for (keep, is_noted) in [(true, true), (false, false)] {
        let text = format!("about = \"a\"\nsource = \"a.gltf\"\nkeep_lights = {keep}");
        std::fs::write(path("a.toml"), text).expect("can write");
        let scene = load("a.toml");
        assert_eq!((scene.lights.len(), noted(&scene, note)), (2 * usize::from(keep), is_noted));
    }
}

#[test]
fn far_planes_that_cut() {
    let note = "cameras whose far plane cuts the scene, drawn without it: 1";
    for (far, is_noted) in [(json!(4.9), true), (json!(5.1), false), (Value::Null, false)] {
        let scene = load_with(|root| {
            let lens = json!({ "yfov": 0.9, "znear": 0.1, "zfar": far });
            root["cameras"] = json!([{ "type": "perspective", "perspective": lens }]);
            root["nodes"] = json!([{ "mesh": 0 }, { "camera": 0, "translation": [0, 0, 5] }]);
            root["scenes"][0]["nodes"] = json!([0, 1]);
        });
        assert_eq!(noted(&scene, note), is_noted, "{far}");
    }
}

/// How many triangles are noted as rounded.
fn rounded(change: impl FnOnce(&mut Value)) -> usize {
    let scene = load_with(change);
    let start =
        "triangles too far from the origin for single precision, rounded (move the scene there): ";
    let counts = scene.notes.iter().filter_map(|note| note.strip_prefix(start));
    counts.map(|count| count.parse::<usize>().expect("a number")).sum()
}

/// The triangle with its corners moved in the file.
fn moved_corners(root: &mut Value, x: f32) {
    let corners = floats(&[x, 0.0, 0.0, x + 1.0, 0.0, 0.0, x, 1.0, 0.0]);
    let corners = accessor(root, 5126, "VEC3", 3, &corners);
    attribute(root, "POSITION", corners);
}

#[test]
fn coordinates_beyond_single_precision() {
    // The longest edge is √2: 8192 of them are 11585 m.
    for (far, expected) in [(1e4, 0), (-1e4, 0), (2e4, 1), (-2e4, 1), (5e6, 1)] {
        assert_eq!(
            rounded(|r| r["nodes"][0]["translation"] = json!([0, far, 0])),
            expected,
            "{far}"
        );
        let matrix = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, far, 1]);
        assert_eq!(rounded(|r| r["nodes"][0]["matrix"] = matrix), expected, "{far}");
        assert_eq!(rounded(|r| moved_corners(r, far as f32)), expected, "{far}");
        // There and back: what was rounded there stays so.
        assert_eq!(
            rounded(|r| {
                r["nodes"] = json!([
                    { "children": [1], "translation": [far, 0, 0] },
                    { "mesh": 0, "translation": [-far, 0, 0] },
                ]);
            }),
            expected,
            "{far}"
        );
        assert_eq!(
            rounded(|r| {
                moved_corners(r, far as f32);
                r["nodes"][0]["translation"] = json!([-far, 0, 0]);
            }),
            expected,
            "{far}"
        );
    }
    assert_eq!(rounded(|r| r["nodes"][0]["scale"] = json!([1e7, 1e7, 1e7])), 0, "large, not far");
    // A model in kilometres, placed in metres.
    let kilometres = json!({ "mesh": 0, "scale": [1e3, 1e3, 1e3], "translation": [2e4, 0, 0] });
    assert_eq!(rounded(|r| r["nodes"][0] = kilometres), 0);
}

/// Triangles with their right angle at x = 1, of these sizes.
fn of_sizes(root: &mut Value, sizes: &[f32]) {
    let corners = |&size: &f32| [1.0, 0.0, 0.0, 1.0 + size, 0.0, 0.0, 1.0, size, 0.0];
    let corners: Vec<f32> = sizes.iter().flat_map(corners).collect();
    let positions = accessor(root, 5126, "VEC3", 3 * sizes.len(), &floats(&corners));
    root["meshes"][0]["primitives"][0] = json!({ "attributes": { "POSITION": positions } });
}

#[test]
fn some_small_triangles_are_in_every_scene() {
    assert_eq!(rounded(|root| of_sizes(root, &[1e-5, 1.0, 1.0])), 0);
    assert_eq!(rounded(|root| of_sizes(root, &[1e-5, 1e-5, 1.0])), 2);
}

#[test]
fn an_object_is_far_whatever_lies_at_the_origin() {
    let far = |root: &mut Value| {
        of_sizes(root, &[1.0; 5]);
        let small = json!({ "attributes": { "POSITION": 0 }, "indices": 1 });
        root["meshes"].as_array_mut().expect("is one").push(json!({ "primitives": [small] }));
        root["nodes"] = json!([{ "mesh": 0 }, { "mesh": 1, "translation": [0, 0, 4e6] }]);
        root["scenes"][0]["nodes"] = json!([0, 1]);
    };
    assert_eq!(rounded(far), 1);
}
