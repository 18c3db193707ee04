//! glTF files that are broken or out to do harm, written into a temporary folder: each is refused
//! with one line, or loaded without what is wrong with it. None panics.

mod common;

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use manylights_scene::{LoadError, Scene, load};
use serde_json::{Value, json};

/// One triangle in the plane z = 0 with 16-bit indices: 36 + 6 bytes.
fn triangle() -> Value {
    triangle_with([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0])
}

fn triangle_with(positions: [f32; 9]) -> Value {
    let mut bytes: Vec<u8> = positions.iter().flat_map(|p| p.to_le_bytes()).collect();
    bytes.extend([0_u16, 1, 2].iter().flat_map(|i| i.to_le_bytes()));
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3,
              "min": [0, 0, 0], "max": [1, 1, 0] },
            { "bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 3 }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 36 },
            { "buffer": 0, "byteOffset": 36, "byteLength": 6 }
        ],
        "buffers": [{ "byteLength": 42, "uri": data_uri(&bytes) }]
    })
}

fn data_uri(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", STANDARD.encode(bytes))
}

fn load_bytes(extension: &str, bytes: &[u8]) -> Result<Scene, LoadError> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("hostile").with_extension(extension);
    std::fs::write(&path, bytes).expect("can write");
    load(path.to_str().expect("UTF-8"), None)
}

fn load_json(root: &Value) -> Result<Scene, LoadError> {
    load_bytes("gltf", root.to_string().as_bytes())
}

/// Asserts that the triangle with each change is refused with a line that names the place.
fn refused<const N: usize>(cases: [(&str, fn(&mut Value)); N]) {
    for (expected, change) in cases {
        let mut root = triangle();
        change(&mut root);
        let line = match load_json(&root) {
            Err(error) => common::check_line(&error),
            Ok(_) => panic!("loaded, not refused with `{expected}`"),
        };
        assert!(line.contains("hostile.gltf: "), "{line}");
        assert!(line.contains(expected), "{line}: not `{expected}`");
    }
}

fn noted(scene: &Scene, note: &str) -> bool {
    scene.notes.iter().any(|line| line == note)
}

#[test]
fn the_triangle_itself_loads() {
    let scene = load_json(&triangle()).expect("valid");
    common::check_invariants(&scene, "triangle");
    assert_eq!(scene.triangles.len(), 1);
    assert!(noted(&scene, "no camera in the file, framed from outside: 1"));
    assert!(noted(&scene, "no light in the file: 1"));
    assert!(noted(&scene, "primitives without normals, flat ones computed: 1"));
}

#[test]
fn references() {
    refused([
        ("accessor that does not exist", |r| {
            r["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(9);
        }),
        ("indices: Index out of bounds", |r| {
            r["meshes"][0]["primitives"][0]["indices"] = json!(9);
        }),
        ("material: Index out of bounds", |r| {
            r["meshes"][0]["primitives"][0]["material"] = json!(0);
        }),
        ("nodes[0].mesh: Index out of bounds", |r| r["nodes"][0]["mesh"] = json!(7)),
        ("nodes[0].children[0]: Index out of bounds", |r| r["nodes"][0]["children"] = json!([5])),
        ("scene: Index out of bounds", |r| r["scene"] = json!(4)),
        ("bufferViews[0].buffer", |r| r["bufferViews"][0]["buffer"] = json!(1)),
        // The crate would take 2³² for 0.
        ("nodes.mesh: the integer 4294967296", |r| r["nodes"][0]["mesh"] = json!(1_u64 << 32)),
        ("light: Index out of bounds", |r| {
            r["nodes"][0]["extensions"] = json!({ "KHR_lights_punctual": { "light": 0 } });
        }),
    ]);
}

#[test]
fn indices_beyond_the_vertices() {
    let mut bytes = [0_u8; 42];
    bytes[40] = 3;
    let mut root = triangle();
    root["buffers"][0]["uri"] = json!(data_uri(&bytes));
    let line = common::check_line(&load_json(&root).expect_err("index 3 of 3"));
    let place = "nodes[0]: meshes[0].primitives[0]: indices: one is 3, but there are 3 vertices";
    assert!(line.contains(place), "{line}");
}

#[test]
fn node_hierarchies() {
    refused([
        ("nodes[0]: is below itself", |r| r["nodes"][0]["children"] = json!([0])),
        ("is below itself (a cycle)", |r| {
            r["nodes"] = json!([{ "mesh": 0 }, { "children": [2] }, { "children": [1] }]);
        }),
        ("node 2 is the child of more than one node", |r| {
            r["nodes"] = json!([{ "children": [1, 2] }, { "children": [2] }, { "mesh": 0 }]);
        }),
        ("node 1 is the child of more than one node", |r| {
            r["nodes"] = json!([{ "children": [1, 1] }, { "mesh": 0 }]);
        }),
        ("scenes[0].nodes: node 1 is also the child", |r| {
            r["nodes"] = json!([{ "children": [1] }, { "mesh": 0 }]);
            r["scenes"][0]["nodes"] = json!([0, 1]);
        }),
        ("scenes[0].nodes: node 0 is listed twice", |r| {
            r["scenes"][0]["nodes"] = json!([0, 0]);
        }),
    ]);
}

#[test]
fn deeply_nested_nodes_load() {
    const DEPTH: usize = 3_000;
    let mut root = triangle();
    let link = |i| json!({ "children": [i + 1], "translation": [0.0, 0.0, 0.5] });
    let mut nodes: Vec<_> = (0..DEPTH).map(link).collect();
    nodes.push(json!({ "mesh": 0 }));
    root["nodes"] = json!(nodes);
    let scene = load_json(&root).expect("a chain is valid");
    assert_eq!(scene.triangles.len(), 1);
    // Sums of halves are exact.
    assert_eq!(scene.bounds().0.z, 0.5 * DEPTH as f32);
}

#[test]
fn deeply_nested_json_is_refused() {
    for text in ["[".repeat(100_000), "{\"extras\":".repeat(100_000)] {
        common::check_line(&load_bytes("gltf", text.as_bytes()).expect_err("no glTF"));
    }
}

#[test]
fn counts_and_lengths() {
    refused([
        ("accessors[0]: count: 4000000000 elements end at byte", |r| {
            r["accessors"][0]["count"] = json!(4_000_000_000_u64);
        }),
        ("accessors[0]: count", |r| r["accessors"][0]["count"] = json!(u64::MAX)),
        ("accessors[1]: count: is zero", |r| r["accessors"][1]["count"] = json!(0)),
        ("accessors[1]: count", |r| r["accessors"][1]["byteOffset"] = json!(u64::MAX)),
        ("accessors[0]: byteStride of its buffer view: is 4 bytes for elements of 12", |r| {
            r["bufferViews"][0]["byteStride"] = json!(4);
        }),
        ("bufferViews[0].byteStride", |r| r["bufferViews"][0]["byteStride"] = json!(0)),
        ("bufferViews[0]: ends at byte 18446744073709551651", |r| {
            r["bufferViews"][0]["byteOffset"] = json!(u64::MAX);
        }),
        ("buffers[0]: byteLength: is 18446744073709551615, but only 42 bytes", |r| {
            r["buffers"][0]["byteLength"] = json!(u64::MAX);
        }),
        ("buffers[0]: byteLength: is 43, but only 42 bytes", |r| {
            r["buffers"][0]["byteLength"] = json!(43);
        }),
        ("NORMAL: has 3 values, other attributes 2", |r| {
            let accessor = r["accessors"][0].clone();
            r["accessors"].as_array_mut().expect("is one").push(accessor);
            r["accessors"][2]["count"] = json!(2);
            r["meshes"][0]["primitives"][0]["attributes"] = json!({ "NORMAL": 0, "POSITION": 2 });
        }),
    ]);
}

#[test]
fn sparse_accessors() {
    fn sparse(root: &mut Value, count: u64, component: u64, index_offset: u64) {
        root["accessors"][0]["sparse"] = json!({
            "count": count,
            "indices": { "bufferView": 1, "byteOffset": index_offset, "componentType": component },
            "values": { "bufferView": 0 }
        });
    }
    // The view of the indices holds the bytes 0 0 1 0 2 0.
    refused([
        ("sparse: count: is zero", |r| sparse(r, 0, 5123, 0)),
        ("sparse: count: 4 elements end at byte 48", |r| sparse(r, 4, 5121, 0)),
        ("sparse: indices: must rise and stay below 3; one is 0", |r| sparse(r, 3, 5121, 0)),
        ("sparse: indices: must rise and stay below 3; one is 256", |r| sparse(r, 1, 5123, 1)),
        ("sparse: count: 2 elements end at byte 8", |r| sparse(r, 2, 5125, 0)),
        ("accessors[0]: count: is beyond the file", |r| {
            sparse(r, 1, 5121, 0);
            r["accessors"][0]["count"] = json!(4_000_000_000_u64);
            r["accessors"][0].as_object_mut().expect("is one").remove("bufferView");
        }),
    ]);
    let mut root = triangle();
    sparse(&mut root, 2, 5123, 2);
    let scene = load_json(&root).expect("indices 1 and 2");
    // Vertices 1 and 2 become copies of 0 and 1: no area is left.
    assert!(noted(&scene, "triangles without area left out: 1"), "{:?}", scene.notes);
}

#[test]
fn instances_beyond_memory() {
    let mut root = triangle();
    root["accessors"][1]["componentType"] = json!(5121);
    root["accessors"][1]["count"] = json!(6);
    let primitive = root["meshes"][0]["primitives"][0].clone();
    root["meshes"][0]["primitives"] = json!(vec![primitive; 4_000]);
    root["nodes"] = json!(vec![json!({ "mesh": 0 }); 4_000]);
    root["scenes"][0]["nodes"] = json!((0..4_000).collect::<Vec<_>>());
    let line = common::check_line(&load_json(&root).expect_err("144 million corners"));
    assert!(line.contains("144000000 vertices and indices"), "{line}");
}

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
        ("light: its colour times", |r| light(r, json!({ "type": "point", "intensity": 1e39 }))),
        ("light.spot: the angles", |r| {
            let spot = json!({ "innerConeAngle": 1.0, "outerConeAngle": 0.5 });
            light(r, json!({ "type": "spot", "spot": spot }));
        }),
        ("nodes[0]: transform", |r| {
            r["nodes"][0]["translation"] = json!([1e39, 0, 0]);
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
            let extensions = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 1e39 } });
            material(r, json!({ "emissiveFactor": [1, 1, 1], "extensions": extensions }));
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
    root["nodes"][0]["scale"] = json!([1e39, 1, 1]);
    let scene = load_json(&root).expect("loads without the triangle");
    assert!(noted(&scene, "triangles with non-finite vertices left out: 1"), "{:?}", scene.notes);
    // Finite vertices whose cross product is not: no normal could be computed.
    root["nodes"][0]["scale"] = json!([1e30, 1e30, 1]);
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
fn binary_containers() {
    let glb = |length: u32| [b"glTF".as_slice(), &2_u32.to_le_bytes(), &length.to_le_bytes()].concat();
    let cases = [
        ("GLB header", b"glTF".to_vec()),
        ("GLB header", glb(0)),
        ("GLB header", glb(11)),
        ("GLB header", glb(u32::MAX)),
        ("GLB chunks", glb(12)),
        ("GLB chunks", [glb(20).as_slice(), &[255, 255, 255, 255], b"JSON"].concat()),
        ("version 1", [b"glTF".as_slice(), &1_u32.to_le_bytes(), &12_u32.to_le_bytes()].concat()),
        ("JSON", Vec::new()),
        ("JSON", vec![0; 64]),
        ("JSON", b"{}".to_vec()),
    ];
    for (expected, bytes) in cases {
        let line = common::check_line(&load_bytes("glb", &bytes).expect_err("no glTF"));
        assert!(line.contains(expected), "{line}: not `{expected}`");
    }
    let line = common::check_line(&load("nowhere/scene.glb", None).expect_err("no file"));
    assert!(line.contains("nowhere/scene.glb: cannot be read"), "{line}");
    assert!(load(Path::new("src").join("x.gltf").to_str().expect("UTF-8"), None).is_err());
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
