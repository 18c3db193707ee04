//! Scenes that are put together from several files.

use std::path::Path;

use glam::{Vec3, vec3};
use image::{Rgb, RgbImage};
use manylights_scene::{Scene, load};
use serde_json::json;

use crate::common;
use crate::common::triangle::triangle;

const ABOUT: &str = "about = \"a test\"\n";

fn named<'a>(scene: &'a Scene, name: &str) -> &'a manylights_scene::Material {
    scene.materials.iter().find(|material| material.name == name).unwrap_or_else(|| {
        let names: Vec<_> = scene.materials.iter().map(|material| &material.name).collect();
        panic!("no `{name}` among {names:?}")
    })
}

#[test]
fn parts_alone_make_a_scene() {
    let text = format!(
        "{ABOUT}[[part]]\nsource = \"builtin:cornell\"\n[[part]]\nsource = \"builtin:trio\""
    );
    let scene = common::load_text(&text).expect("valid");
    common::check_invariants(&scene, "parts");
    let [cornell, trio] = ["cornell", "trio"].map(|name| load(name, None).expect("built in"));
    assert_eq!(scene.triangles.len(), cornell.triangles.len() + trio.triangles.len());
    assert_eq!(scene.exposure, 1.0);
    // Their lights and cameras are not the scene's.
    assert!(scene.lights.is_empty() && scene.area_lights.is_empty());
    assert_eq!(scene.cameras[0].name, "framed");
    for note in ["cornell: lights of a part left out: 1", "trio: cameras of a part left out: 1"] {
        assert!(scene.notes.iter().any(|line| line == note), "{:?}", scene.notes);
    }
    // The second part's triangles are its own, shifted.
    let first = cornell.triangles.len();
    for (i, triangle) in trio.triangles.iter().enumerate() {
        let here = scene.triangles[first + i];
        assert_eq!(scene.corners((first + i) as u32), trio.corners(i as u32));
        let name = &trio.materials[triangle.material as usize].name;
        assert_eq!(scene.materials[here.material as usize].name, format!("trio/{name}"));
    }
}

#[test]
fn lights_and_cameras_are_those_of_the_source() {
    let text = format!(
        "{ABOUT}source = \"builtin:cornell\"\n[[part]]\nsource = \"builtin:receivers\"\n\
         [[part]]\nsource = \"builtin:cornell\""
    );
    let scene = common::load_text(&text).expect("valid");
    let cornell = load("cornell", None).expect("built in");
    assert_eq!(scene.lights, cornell.lights);
    assert!(scene.area_lights.is_empty());
    assert_eq!(scene.cameras.len(), 1);
    // The source's materials keep their names; the part's are told from them.
    assert_eq!(named(&scene, "red").base_color, named(&scene, "cornell/red").base_color);
    assert!(scene.notes.contains(&"receivers: lights of a part left out: 5".to_owned()));
    // Without the source's lights there are none, of whatever kind.
    let text = format!("{ABOUT}source = \"builtin:receivers\"\nkeep_lights = false");
    assert!(common::load_text(&text).expect("valid").area_lights.is_empty());
}

/// Scaled, then turned about x, y and z, then moved; normals stay orthogonal to what they are of.
#[test]
fn transforms_move_points_and_turn_normals() {
    let text = |transform: &str| {
        format!("{ABOUT}[[part]]\nsource = \"builtin:trio\"\ntransform = {{ {transform} }}")
    };
    let trio = load("trio", None).expect("built in");
    let moved = common::load_text(&text(
        "translation = [10, 20, 30], rotation = [90, 0, 90], scale = [1, 2, 4]",
    ))
    .expect("valid");
    common::check_invariants(&moved, "moved");
    // About x by 90°: (x, y, z) → (x, −z, y); then about z: (x, y, z) → (−y, x, z).
    let turned = |v: Vec3| vec3(v.z, v.x, v.y);
    for (before, after) in trio.vertices.iter().zip(&moved.vertices) {
        let expected = vec3(10.0, 20.0, 30.0) + turned(before.position * vec3(1.0, 2.0, 4.0));
        assert!(after.position.distance(expected) < 1e-5, "{after:?}, expected {expected}");
        let normal = turned((before.normal / vec3(1.0, 2.0, 4.0)).normalize());
        assert!(after.normal.distance(normal) < 1e-6, "{after:?}, expected {normal}");
    }
    for triangle in 0..moved.triangles.len() as u32 {
        let normal = moved.vertices[moved.triangles[triangle as usize].vertices[0] as usize].normal;
        assert!(moved.geometric_normal(triangle).dot(normal) > 0.5, "triangle {triangle}");
    }
    // About y alone, the middle one: z turns to x.
    let moved = common::load_text(&text("rotation = [0, 90, 0]")).expect("valid");
    let [before, after] = [&trio, &moved].map(|scene| scene.vertices[7].position);
    assert!(after.distance(vec3(before.z, before.y, -before.x)) < 1e-6, "{before} → {after}");
}

#[test]
fn materials_replace_all_of_their_part() {
    let text = format!(
        "{ABOUT}source = \"builtin:trio\"\n\
         [[part]]\nsource = \"builtin:trio\"\nmaterial = {{ base_color = [0.1, 0.2, 0.3], roughness = 0.7 }}\n\
         [[part]]\nsource = \"builtin:trio\"\nmaterial = {{ preset = \"teflon\" }}\n\
         [material.\"trio-2/brass\"]\npreset = \"gold-paint\"\n\
         [material.brass]\nroughness = 0.9"
    );
    let scene = common::load_text(&text).expect("valid");
    let trio = load("trio", None).expect("built in");
    let [own, coloured, teflon] = std::array::from_fn(|i| {
        &scene.materials[i * trio.materials.len()..][..trio.materials.len()]
    });
    for (material, before) in own.iter().zip(&trio.materials) {
        assert_eq!((&material.name, material.base_color), (&before.name, before.base_color));
    }
    assert_eq!(named(&scene, "brass").roughness, 0.9);
    for material in coloured {
        assert_eq!((material.base_color, material.roughness), (vec3(0.1, 0.2, 0.3), 0.7));
    }
    let preset =
        |name| manylights_scene::presets::PRESETS.iter().find(|preset| preset.name == name);
    for material in teflon {
        let name = if material.name == "trio-2/brass" { "gold-paint" } else { "teflon" };
        assert_eq!(material.given, preset(name).map(|preset| preset.brdf()), "{}", material.name);
    }
}

/// A triangle of glTF with a texture of one color.
fn write_textured(folder: &Path, name: &str, color: [u8; 3]) {
    let mut root = triangle();
    root["images"] = json!([{ "uri": format!("{name}.png") }]);
    root["textures"] = json!([{ "source": 0 }]);
    root["materials"] = json!([{ "name": "paint", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
    root["meshes"][0]["primitives"][0]["material"] = json!(0);
    std::fs::write(folder.join(name).with_extension("gltf"), root.to_string()).expect("can write");
    RgbImage::from_pixel(1, 1, Rgb(color))
        .save(folder.join(name).with_extension("png"))
        .expect("can write");
}

#[test]
fn textures_notes_and_sources_come_along() {
    let (folder, path) = common::write(&format!(
        "{ABOUT}source = \"red.gltf\"\n[[part]]\nsource = \"green.gltf\"\n[[part]]\nsource = \"asset:red.gltf\""
    ));
    write_textured(folder.path(), "red", [255, 0, 0]);
    write_textured(folder.path(), "green", [0, 255, 0]);
    let scene = load(path.to_str().expect("UTF-8"), Some(folder.path())).expect("valid");
    common::check_invariants(&scene, "textures");
    let color = |name: &str| named(&scene, name).base_color_at(&scene.textures, glam::Vec2::ZERO);
    let colors = ["paint", "green/paint", "red/paint"].map(color);
    assert_eq!(colors, [Vec3::X, Vec3::Y, Vec3::X]);
    let note = "primitives without normals, flat ones computed: 1";
    for note in [note.to_owned(), format!("green: {note}"), format!("red: {note}")] {
        assert!(scene.notes.contains(&note), "{note}: {:?}", scene.notes);
    }
    let names: Vec<_> =
        scene.sources.iter().map(|path| path.file_name().expect("a file").to_owned()).collect();
    assert_eq!(
        names,
        ["red.gltf", "red.png", "hall.toml", "green.gltf", "green.png", "red.gltf", "red.png"]
    );
}

#[test]
fn wrong_parts_are_refused_with_their_line() {
    let part = |rest: &str| format!("{ABOUT}\n[[part]]\nsource = \"builtin:cornell\"\n{rest}");
    let transform = |rest: &str| part(&format!("transform = {{ {rest} }}"));
    let cases = [
        ("hall.toml: has neither a source nor a part", "add source", ABOUT.to_owned()),
        (
            "hall.toml:3: part: scale = 0 is out of range",
            "use a number from",
            transform("scale = [1, 0, 1]"),
        ),
        ("hall.toml:3: part: scale = -1 is", "use a number from", transform("scale = [1, 1, -1]")),
        ("part: scale = NaN is", "use a number from", transform("scale = [1, 1, nan]")),
        ("part: rotation is not finite", "finite", transform("rotation = [inf, 0, 0]")),
        ("part: translation is not finite", "finite", transform("translation = [0, nan, 0]")),
        (
            "part: translation = 1000000",
            "from -1000000000",
            transform("translation = [0, 1e18, 0]"),
        ),
        (
            "hall.toml:5: unknown field `translate`",
            "`translation`?",
            transform("translate = [0, 0, 1]"),
        ),
        ("unknown field `materials`", "`material`?", part("materials = 1")),
        ("hall.toml:3: part: roughness = 2", "from 0 to 1", part("material = { roughness = 2 }")),
        (
            "hall.toml:3: part: unknown preset `x`",
            "did you mean",
            part("material = { preset = \"x\" }"),
        ),
        ("missing field `source`", "correct", format!("{ABOUT}[[part]]\n")),
        (
            "hall.toml:2: part: ",
            "did you mean `trio`?",
            format!("{ABOUT}[[part]]\nsource = \"builtin:trios\""),
        ),
        (
            "nowhere.glb: cannot be read",
            "check",
            format!("{ABOUT}[[part]]\nsource = \"nowhere.glb\""),
        ),
        (
            "no assets folder is set",
            "MANYLIGHTS_ASSETS",
            format!("{ABOUT}[[part]]\nsource = \"asset:a.glb\""),
        ),
        (
            "unknown material `cornell/wite`",
            "`cornell/white`?",
            part("[material.\"cornell/wite\"]"),
        ),
    ];
    for (problem, remedy, text) in cases {
        let line = common::check_line(&common::load_text(&text).expect_err(&text));
        assert!(
            line.contains(problem) && line.contains(remedy),
            "{line}: not `{problem}`, `{remedy}`"
        );
    }
}

/// What a transform leaves of triangles in single precision.
#[test]
fn triangles_that_lose_their_area_are_noted() {
    let scale = "transform = { translation = [1e6, 0, 0], scale = [1e-9, 1, 1] }";
    let text = format!("{ABOUT}[[part]]\nsource = \"builtin:cornell\"\n{scale}");
    let scene = common::load_text(&text).expect("valid");
    common::check_invariants(&scene, "flattened");
    // Only what faces along x keeps an area: two walls, and the four sides of the turned blocks.
    assert_eq!(scene.triangles.len(), 2 * 2 + 2 * (4 * 2));
    let note = "cornell: triangles without area after the transform left out: 14";
    assert!(scene.notes.contains(&note.to_owned()), "{:?}", scene.notes);
}
