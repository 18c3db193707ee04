//! glTF files that are broken or out to do harm in their structure, written into a temporary folder: each is
//! refused with one line, or loaded without what is wrong with it. None panics.

use crate::common;
use std::path::Path;

use crate::common::triangle::{data_uri, load_bytes, load_json, noted, refused, triangle};
use manylights_scene::load;
use serde_json::{Value, json};

#[test]
fn the_triangle_itself_loads() {
    let scene = load_json(&triangle()).expect("valid");
    common::check_invariants(&scene, "triangle");
    assert_eq!(scene.triangles.len(), 1);
    assert!(noted(&scene, "no camera: framed from outside"));
    assert!(noted(&scene, "no light: every picture is black"));
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
fn binary_containers() {
    let glb =
        |length: u32| [b"glTF".as_slice(), &2_u32.to_le_bytes(), &length.to_le_bytes()].concat();
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
