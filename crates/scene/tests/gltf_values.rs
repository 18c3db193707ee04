//! glTF files that are broken or out to do harm in their values, written into a temporary folder: each is
//! refused with one line, or loaded without what is wrong with it. None panics.

use crate::common;
use crate::common::triangle::{data_uri, load_json, noted, refused, triangle, triangle_with};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use manylights_scene::load;
use serde_json::{Value, json};

#[test]
fn types() {
    refused([
        ("POSITION: has a type", |r| r["accessors"][0]["type"] = json!("VEC2")),
        ("POSITION: has a type", |r| r["accessors"][0]["componentType"] = json!(5121)),
        ("indices: are not unsigned integers", |r| {
            r["accessors"][1]["componentType"] = json!(5122);
        }),
        ("componentType", |r| r["accessors"][0]["componentType"] = json!(17)),
        ("mode", |r| r["meshes"][0]["primitives"][0]["mode"] = json!(7)),
        ("JSON: ", |r| r["nodes"] = json!("none")),
        ("asset.version: glTF version 1.0", |r| r["asset"]["version"] = json!("1.0")),
        ("asset.version: glTF version 2.7", |r| r["asset"]["minVersion"] = json!("2.7")),
        ("KHR_draco_mesh_compression", |r| {
            r["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
        }),
        ("EXT_meshopt_compression", |r| {
            r["extensionsRequired"] = json!(["KHR_materials_ior", "EXT_meshopt_compression"]);
        }),
    ]);
}

#[test]
fn uris() {
    refused([
        ("`../secret.bin` leaves the folder", |r| r["buffers"][0]["uri"] = json!("../secret.bin")),
        ("leaves the folder", |r| r["buffers"][0]["uri"] = json!("a/../../secret.bin")),
        ("leaves the folder", |r| r["buffers"][0]["uri"] = json!("%2e%2e/secret.bin")),
        ("leaves the folder", |r| r["buffers"][0]["uri"] = json!("..%2Fsecret.bin")),
        ("is an absolute path", |r| r["buffers"][0]["uri"] = json!("/etc/hostname")),
        ("is an absolute path", |r| r["buffers"][0]["uri"] = json!("//host/share")),
        ("has a scheme", |r| r["buffers"][0]["uri"] = json!("file:///etc/hostname")),
        ("has a scheme", |r| r["buffers"][0]["uri"] = json!("https://example.com/a.bin")),
        ("has a scheme", |r| r["buffers"][0]["uri"] = json!("C:/secret.bin")),
        ("is not a path", |r| r["buffers"][0]["uri"] = json!("..\\secret.bin")),
        ("is not a path", |r| r["buffers"][0]["uri"] = json!("a%00.bin")),
        ("is not UTF-8", |r| r["buffers"][0]["uri"] = json!("%ff.bin")),
        ("without base64 data", |r| r["buffers"][0]["uri"] = json!("data:text/plain,hello")),
        ("Invalid symbol", |r| r["buffers"][0]["uri"] = json!("data:;base64,????")),
        ("missing.bin", |r| r["buffers"][0]["uri"] = json!("missing.bin")),
        ("is not a file", |r| r["buffers"][0]["uri"] = json!(".")),
        ("buffers[0]: uri: is missing", |r| r["buffers"][0]["uri"] = Value::Null),
    ]);
}

#[test]
fn percent_encoded_uris_are_decoded() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut root = triangle();
    let uri = root["buffers"][0]["uri"].as_str().expect("is one").to_owned();
    let (_, data) = uri.split_once(',').expect("a data URI");
    let bytes = STANDARD.decode(data).expect("base64");
    std::fs::create_dir(folder.path().join("my data")).expect("can write");
    std::fs::write(folder.path().join("my data/ä.bin"), bytes).expect("can write");
    root["buffers"][0]["uri"] = json!("my%20data/./x/../%C3%A4.bin");
    std::fs::create_dir(folder.path().join("my data/x")).expect("can write");
    let path = folder.path().join("scene.GLTF");
    std::fs::write(&path, root.to_string()).expect("can write");
    let scene = load(path.to_str().expect("UTF-8"), None).expect("inside the folder");
    assert_eq!(scene.triangles.len(), 1);
}

/// Nothing may be written over them: also those that import does not read.
#[test]
fn files_that_a_scene_names() {
    let (folder, mut root) = (tempfile::tempdir().expect("a temporary folder"), triangle());
    root["images"] = json!([{ "uri": "read.png" }, { "uri": "%C3%A4/../un%20read.png" }, { "uri": "../up.jpg" }]);
    root["textures"] = json!([{ "source": 0 }, { "source": 1 }, { "source": 2 }]);
    root["materials"] = json!([{
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } },
        "normalTexture": { "index": 1 },
        "occlusionTexture": { "index": 2 },
    }]);
    root["meshes"][0]["primitives"][0]["material"] = json!(0);
    root["extensions"] = json!({ "VENDOR_sky": { "uri": "sky.hdr" } });
    root["extras"] = json!({ "uri": "nobodys.business" });
    let image = image::RgbImage::new(1, 1);
    image.save(folder.path().join("read.png")).expect("can write");
    let (gltf, toml) = (folder.path().join("a.gltf"), folder.path().join("a.toml"));
    std::fs::write(&gltf, root.to_string()).expect("can write");
    std::fs::write(&toml, "about = \"a\"\nsource = \"a.gltf\"").expect("can write");
    let mut expected: Vec<_> = ["a.gltf", "sky.hdr", "read.png", "ä/../un read.png", "../up.jpg"]
        .map(|name| folder.path().join(name))
        .into();
    let mut sources = load(gltf.to_str().expect("UTF-8"), None).expect("valid").sources;
    sources.sort();
    expected.sort();
    assert_eq!(sources, expected);
    expected.push(toml.clone());
    let mut sources = load(toml.to_str().expect("UTF-8"), None).expect("valid").sources;
    sources.sort();
    expected.sort();
    assert_eq!(sources, expected);
    assert!(load("trio", None).expect("built-in").sources.is_empty());
}

#[test]
fn lights_cameras_and_materials() {
    fn light(root: &mut Value, light: Value) {
        root["extensions"] = json!({ "KHR_lights_punctual": { "lights": [light] } });
        root["nodes"][0]["extensions"] = json!({ "KHR_lights_punctual": { "light": 0 } });
    }
    fn camera(root: &mut Value, camera: Value) {
        root["cameras"] = json!([camera]);
        root["nodes"][0]["camera"] = json!(0);
    }
    fn material(root: &mut Value, material: Value) {
        root["materials"] = json!([material]);
        root["meshes"][0]["primitives"][0]["material"] = json!(0);
    }
    refused([
        ("lights[0].spot: Missing data", |r| light(r, json!({ "type": "spot" }))),
        ("lights[0].type", |r| light(r, json!({ "type": "laser" }))),
        ("light: its colour times", |r| light(r, json!({ "type": "point", "intensity": -1 }))),
        ("light: its colour times", |r| {
            light(r, json!({ "type": "point", "color": [10, 10, 10], "intensity": 3e38 }));
        }),
        // Beyond what a number of the file can be.
        ("JSON: number out of range at line 1 column", |r| {
            light(r, json!({ "type": "point", "intensity": 1e39 }));
        }),
        ("light.spot: the angles", |r| {
            let spot = json!({ "innerConeAngle": 1.0, "outerConeAngle": 0.5 });
            light(r, json!({ "type": "spot", "spot": spot }));
        }),
        ("nodes[0]: transform", |r| {
            // Each finite, not so their sum.
            let far = json!([3e38, 0, 0]);
            r["nodes"] = json!([{ "translation": far }, { "translation": far, "children": [0] }]);
            r["scenes"] = json!([{ "nodes": [1] }]);
            light(r, json!({ "type": "point" }));
        }),
        ("nodes[0]: transform", |r| {
            r["nodes"][0]["scale"] = json!([0, 0, 0]);
            light(r, json!({ "type": "directional" }));
        }),
        ("cameras[0]: lacks the projection", |r| {
            let lens = json!({ "xmag": 1, "ymag": 1, "zfar": 2, "znear": 1 });
            camera(r, json!({ "type": "perspective", "orthographic": lens }));
        }),
        ("camera.perspective.yfov", |r| {
            camera(r, json!({ "type": "perspective", "perspective": { "yfov": 7, "znear": 1 } }));
        }),
        ("materials[0]: emissiveFactor", |r| {
            let extensions =
                json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 3e38 } });
            material(r, json!({ "emissiveFactor": [10, 10, 10], "extensions": extensions }));
        }),
        ("materials[0]: ior", |r| {
            material(r, json!({ "extensions": { "KHR_materials_ior": { "ior": 0.5 } } }));
        }),
        ("metallicFactor", |r| {
            material(r, json!({ "pbrMetallicRoughness": { "metallicFactor": 2 } }));
        }),
        ("baseColorFactor", |r| {
            material(r, json!({ "pbrMetallicRoughness": { "baseColorFactor": [1, -1, 1, 1] } }));
        }),
    ]);
}

#[test]
fn non_finite_vertices_and_transforms() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let root = triangle_with([0.0, 0.0, 0.0, 1.0, bad, 0.0, 0.0, 1.0, 0.0]);
        let scene = load_json(&root).expect("loads without the triangle");
        common::check_invariants(&scene, "non-finite");
        assert!(scene.triangles.is_empty() && scene.vertices.is_empty());
        assert!(noted(&scene, "triangles with non-finite vertices left out: 1"));
    }
    let mut root = triangle();
    root["nodes"][0]["scale"] = json!([3e38, 1, 1]);
    root["nodes"][0]["translation"] = json!([3e38, 0, 0]);
    let scene = load_json(&root).expect("loads without the triangle");
    assert!(noted(&scene, "triangles with non-finite vertices left out: 1"), "{:?}", scene.notes);
    // Finite vertices whose cross product is not: no normal could be computed.
    root["nodes"][0]["scale"] = json!([1e30, 1e30, 1]);
    root["nodes"][0]["translation"] = json!([0, 0, 0]);
    let scene = load_json(&root).expect("loads without the triangle");
    assert!(noted(&scene, "triangles without area left out: 1"), "{:?}", scene.notes);
}

#[test]
fn tiny_and_huge_scenes_keep_their_triangles() {
    for scale in [1e-6_f32, 1e-3, 1e4, 1e7] {
        let mut root = triangle();
        root["nodes"][0]["scale"] = json!([scale, scale, scale]);
        let scene = load_json(&root).expect("valid");
        common::check_invariants(&scene, "scaled");
        assert_eq!(scene.triangles.len(), 1, "scale {scale}");
    }
}

#[test]
fn images() {
    fn textured(image: Value) -> Value {
        let mut root = triangle();
        root["images"] = json!([image]);
        root["textures"] = json!([{ "source": 0 }]);
        root["materials"] =
            json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
        root["meshes"][0]["primitives"][0]["material"] = json!(0);
        root
    }
    let image = |bytes: &[u8]| json!({ "uri": data_uri(bytes) });
    let cases = [
        // 16 TiB, if anyone believed the header.
        ("is too large an image", image(&png_header(2_000_000, 2_000_000))),
        ("images[0]: data", image(&png_header(16, 16))),
        ("images[0]: data", image(b"not an image")),
        ("images[0]: data", image(b"RIFF\x10\0\0\0WEBPVP8 ")),
        ("leaves the folder", json!({ "uri": "../image.png" })),
        ("images[0]: uri: is missing", json!({})),
        ("images[0].bufferView", json!({ "bufferView": 8, "mimeType": "image/png" })),
        // The crate unwraps the type.
        ("images[0]: data", json!({ "bufferView": 0 })),
    ];
    for (expected, image) in cases {
        let line = common::check_line(&load_json(&textured(image)).expect_err("no image"));
        assert!(line.contains(expected), "{line}: not `{expected}`");
    }
    let mut root = textured(json!({ "uri": "unused.png" }));
    root["textures"] = json!([{}]);
    let scene = load_json(&root).expect("a texture may have no core image");
    assert!(noted(&scene, "textures without a PNG or JPEG image, left out: 1"));
}

/// The first two chunks' worth of a PNG: signature and IHDR, then nothing.
fn png_header(width: u32, height: u32) -> Vec<u8> {
    let mut header = b"IHDR".to_vec();
    header.extend(width.to_be_bytes());
    header.extend(height.to_be_bytes());
    header.extend([8, 6, 0, 0, 0]);
    let mut crc = u32::MAX;
    for &byte in &header {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
        }
    }
    [b"\x89PNG\r\n\x1a\n\0\0\0\r".as_slice(), &header, &(!crc).to_be_bytes()].concat()
}
