//! What import makes of valid files, against values worked out by hand.

use crate::common::triangle::{accessor, attribute, floats, load_with, noted, two_texels};
use glam::{Vec2, Vec3, vec2, vec3};
use serde_json::json;

#[test]
fn transforms_compose_from_the_root() {
    // Inner: scaled by 2 and moved by 1 along x. Outer: a quarter turn about z.
    let scene = load_with(|root| {
        let half = std::f32::consts::FRAC_1_SQRT_2;
        root["nodes"] = json!([
            { "children": [1], "rotation": [0, 0, half, half] },
            { "mesh": 0, "scale": [2, 2, 2], "translation": [1, 0, 0] },
        ]);
    });
    let [a, b, c] = scene.corners(0);
    let expected = [vec3(0.0, 1.0, 0.0), vec3(0.0, 3.0, 0.0), vec3(-2.0, 1.0, 0.0)];
    for (corner, expected) in [a, b, c].into_iter().zip(expected) {
        assert!(corner.abs_diff_eq(expected, 1e-6), "{corner}, not {expected}");
    }
}

#[test]
fn normals_stay_orthogonal_under_uneven_scale_and_mirrors() {
    for scale in [[1.0, 4.0, 1.0], [-1.0, 4.0, 1.0], [1.0, -4.0, 0.5], [-1.0, -4.0, -0.5]] {
        let normal = vec3(1.0, 1.0, 1.0).normalize();
        let scene = load_with(|root| {
            // The corner of a cube cut off, with the normal of the cut.
            let corners = floats(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
            let corners = accessor(root, 5126, "VEC3", 3, &corners);
            attribute(root, "POSITION", corners);
            let normals = accessor(root, 5126, "VEC3", 3, &floats(&[normal.x; 9]));
            attribute(root, "NORMAL", normals);
            root["nodes"][0]["scale"] = json!(scale);
        });
        let expected = (normal / Vec3::from(scale)).normalize();
        assert!(scene.vertices[0].normal.abs_diff_eq(expected, 1e-6), "{scale:?}");
        // The front goes with the normal, also where the transform mirrors.
        assert!(scene.geometric_normal(0).abs_diff_eq(expected, 1e-6), "{scale:?}");
        assert_eq!(scene.vertices.len(), 3, "shared, not split");
    }
}

#[test]
fn strips_and_fans_keep_their_front() {
    // A strip of three triangles up the plane z = 0, and the same vertices as a fan about the first.
    let strip = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.0, 2.0]];
    let fan = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 1.0]];
    for (mode, points) in [(5, strip), (6, fan)] {
        let scene = load_with(|root| {
            let points: Vec<f32> = points.iter().flat_map(|&[x, y]| [x, y, 0.0]).collect();
            let positions = accessor(root, 5126, "VEC3", 5, &floats(&points));
            let primitive = &mut root["meshes"][0]["primitives"][0];
            primitive["mode"] = json!(mode);
            primitive["attributes"] = json!({ "POSITION": positions });
            primitive.as_object_mut().expect("is one").remove("indices");
        });
        assert_eq!(scene.triangles.len(), 3, "mode {mode}");
        for i in 0..3 {
            assert_eq!(scene.geometric_normal(i), Vec3::Z, "mode {mode}, triangle {i}");
        }
    }
}

#[test]
fn cameras_look_along_minus_z() {
    let scene = load_with(|root| {
        let lens = json!({ "yfov": 0.9, "znear": 0.1 });
        root["cameras"] = json!([{ "type": "perspective", "perspective": lens }]);
        let far = [1e4, 2.0, 3.0];
        root["nodes"][0] = json!({ "mesh": 0, "camera": 0, "name": "view", "translation": far });
    });
    let camera = scene.camera(Some("view")).expect("named after its node");
    assert_eq!((camera.forward, camera.up, camera.right), (Vec3::NEG_Z, Vec3::Y, Vec3::X));
    assert_eq!((camera.position, camera.vertical_fov), (vec3(1e4, 2.0, 3.0), 0.9));
}

#[test]
fn materials_textures_and_coordinate_sets() {
    let scene = load_with(|root| {
        // Set 1 as normalised bytes: 0, 51/255 = 0.2, 1.
        let uvs = accessor(root, 5121, "VEC2", 3, &[0, 51, 255, 0, 51, 255]);
        attribute(root, "TEXCOORD_1", uvs);
        let zeros = accessor(root, 5126, "VEC2", 3, &floats(&[0.0; 6]));
        attribute(root, "TEXCOORD_0", zeros);
        root["images"] =
            json!([two_texels([255, 0, 0], [0, 255, 0]), two_texels([0, 51, 0], [0, 153, 255])]);
        root["textures"] = json!([{ "source": 0 }, { "source": 1 }]);
        root["materials"] = json!([{ "name": "unused" }, {
            "name": "painted",
            "pbrMetallicRoughness": {
                "baseColorFactor": [0.5, 0.25, 1, 1],
                "baseColorTexture": { "index": 0, "texCoord": 1 },
                "metallicRoughnessTexture": { "index": 1 },
                "metallicFactor": 0.5,
                "roughnessFactor": 1.0,
            },
            "emissiveFactor": [1, 0.5, 0.25],
            "extensions": {
                "KHR_materials_ior": { "ior": 1.33 },
                "KHR_materials_specular": {
                    "specularFactor": 0.5, "specularColorFactor": [1, 0.5, 2]
                },
                "KHR_materials_emissive_strength": { "emissiveStrength": 8 },
            },
        }]);
        root["meshes"][0]["primitives"][0]["material"] = json!(1);
    });
    let [material] = &scene.materials[..] else { panic!("only the used material") };
    assert_eq!((material.name.as_str(), material.ior), ("painted", 1.33));
    assert_eq!(material.base_color, vec3(0.5, 0.25, 1.0));
    // Means of the texture: green (51 + 153)/2/255 = 0.4, blue 0.5.
    assert!((material.roughness - 0.4).abs() < 1e-6, "{}", material.roughness);
    assert!((material.metallic - 0.25).abs() < 1e-6, "{}", material.metallic);
    assert!(noted(&scene, "metallic-roughness textures replaced by their mean: 1"));
    assert_eq!((material.specular, material.specular_color), (0.5, vec3(1.0, 0.5, 2.0)));
    assert_eq!(material.emission, vec3(8.0, 4.0, 2.0));

    let uvs: Vec<Vec2> = scene.vertices.iter().map(|vertex| vertex.uv).collect();
    let expected = [vec2(0.0, 0.2), vec2(1.0, 0.0), vec2(0.2, 1.0)];
    for (uv, expected) in uvs.iter().zip(expected) {
        assert!(uv.abs_diff_eq(expected, 1e-6), "{uv}, not {expected}");
    }
    assert_eq!((scene.textures[0].width, scene.textures[0].height), (2, 1));
    let left = material.base_color_at(&scene.textures, vec2(0.25, 0.5));
    assert!(left.abs_diff_eq(vec3(0.5, 0.0, 0.0), 1e-6), "{left}");
}
