//! A small valid glTF file for tests to break.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use manylights_scene::{LoadError, Scene, load};
use serde_json::{Value, json};

use super::{check_invariants, check_line};

/// One triangle in the plane z = 0 with 16-bit indices: 36 + 6 bytes.
pub(crate) fn triangle() -> Value {
    triangle_with([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0])
}

pub(crate) fn triangle_with(positions: [f32; 9]) -> Value {
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

pub(crate) fn data_uri(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", STANDARD.encode(bytes))
}

pub(crate) fn load_bytes(extension: &str, bytes: &[u8]) -> Result<Scene, LoadError> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("hostile").with_extension(extension);
    std::fs::write(&path, bytes).expect("can write");
    load(path.to_str().expect("UTF-8"), None)
}

pub(crate) fn load_json(root: &Value) -> Result<Scene, LoadError> {
    load_bytes("gltf", root.to_string().as_bytes())
}

pub(crate) type Change = fn(&mut Value);

/// Asserts that the triangle with each change is refused with a line that names the place.
pub(crate) fn refused<const N: usize>(cases: [(&str, Change); N]) {
    for (expected, change) in cases {
        let mut root = triangle();
        change(&mut root);
        let line = match load_json(&root) {
            Err(error) => check_line(&error),
            Ok(_) => panic!("loaded, not refused with `{expected}`"),
        };
        assert!(line.contains("hostile.gltf: "), "{line}");
        assert!(line.contains(expected), "{line}: not `{expected}`");
    }
}

pub(crate) fn noted(scene: &Scene, note: &str) -> bool {
    scene.notes.iter().any(|line| line == note)
}

/// Changes the triangle and loads it.
pub(crate) fn load_with(change: impl FnOnce(&mut Value)) -> Scene {
    let mut root = triangle();
    change(&mut root);
    let scene = load_json(&root).unwrap_or_else(|error| panic!("{error}"));
    check_invariants(&scene, "import");
    scene
}

/// Adds an accessor over data of its own and returns its index.
pub(crate) fn accessor(
    root: &mut Value,
    component: u32,
    shape: &str,
    count: usize,
    bytes: &[u8],
) -> usize {
    let push = |root: &mut Value, list: &str, value: Value| {
        let list = root[list].as_array_mut().expect("is one");
        list.push(value);
        list.len() - 1
    };
    let buffer = json!({ "byteLength": bytes.len(), "uri": data_uri(bytes) });
    let buffer = push(root, "buffers", buffer);
    let view = json!({ "buffer": buffer, "byteLength": bytes.len() });
    let view = push(root, "bufferViews", view);
    let accessor = json!({
        "bufferView": view, "componentType": component, "type": shape, "count": count,
        "normalized": component != 5126 && shape != "SCALAR",
    });
    push(root, "accessors", accessor)
}

pub(crate) fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

pub(crate) fn attribute(root: &mut Value, name: &str, accessor: usize) {
    root["meshes"][0]["primitives"][0]["attributes"][name] = json!(accessor);
}

/// A PNG of 2 × 1 texels.
pub(crate) fn two_texels(left: [u8; 3], right: [u8; 3]) -> Value {
    let mut png = std::io::Cursor::new(Vec::new());
    let pixels = [left, right].concat();
    let image = image::RgbImage::from_raw(2, 1, pixels).expect("2 × 1 × 3 bytes");
    image.write_to(&mut png, image::ImageFormat::Png).expect("can encode");
    json!({ "uri": data_uri(&png.into_inner()) })
}
