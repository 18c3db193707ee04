//! Real files: those that other loaders trip over, and the scenes of the papers.

use crate::common;
use std::path::{Path, PathBuf};

use glam::{Vec3, vec3};
use manylights_scene::{Light, Scene, load};

/// Paths below `folder` with one of the extensions, sorted.
fn files(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in folder.read_dir().unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
        let path = entry.expect("can be read").path();
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or("");
        if path.is_dir() {
            found.extend(files(&path, extensions));
        } else if extensions.contains(&extension) {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn load_path(path: &Path) -> Result<Scene, manylights_scene::LoadError> {
    load(path.to_str().expect("UTF-8"), Some(&common::assets()))
}

fn crafted(name: &str) -> Result<Scene, String> {
    let path = common::assets().join("gltf_robustness/crafted").join(name);
    load_path(&path).map_err(|error| common::check_line(&error))
}

#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn every_file_loads_or_is_refused_with_a_line() {
    let files = files(&common::assets().join("gltf_robustness"), &["gltf", "glb"]);
    assert!(files.len() > 100, "only {} files", files.len());
    let mut loaded = 0;
    for path in &files {
        match load_path(path) {
            Ok(scene) => {
                common::check_invariants(&scene, &path.display().to_string());
                loaded += 1;
            }
            Err(error) => {
                let line = common::check_line(&error);
                let name = path.file_name().and_then(|name| name.to_str()).expect("UTF-8");
                assert!(line.contains(name), "{line} does not name {name}");
            }
        }
    }
    // A loader that refuses everything would be robust too.
    assert!(loaded * 3 > files.len() * 2, "{loaded} of {}", files.len());
}

/// What the README of the folder says of each file.
#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn crafted_files_that_must_be_refused() {
    for (name, expected) in [
        ("bad_length.glb", "GLB header: states 2248 bytes, the file has 1248"),
        ("dangling_view.gltf", "accessors[0].bufferView"),
        ("huge_buffer_length.gltf", "is 4000000000, but only 36 bytes are there"),
        ("huge_view_offset.gltf", "bufferViews[0]: ends at byte"),
        ("idx_out_of_range.glb", "indices: one is 7, but there are 4 vertices"),
        ("required_unknown_extension.glb", "VENDOR_does_not_exist"),
        ("truncated.glb", "GLB header: states 1248 bytes, the file has 1208"),
        ("version_3.gltf", "glTF version 3.0"),
    ] {
        let line = crafted(name).expect_err(name);
        assert!(line.contains(expected), "{line}: not `{expected}`");
    }
}

/// The square [-1, 1]² of two triangles that face +z: most of the crafted files are that.
fn check_square(scene: &Scene, name: &str) {
    assert_eq!(scene.triangles.len(), 2, "{name}");
    for i in 0..2 {
        assert_eq!(scene.geometric_normal(i), Vec3::Z, "{name}");
    }
    assert!(scene.vertices.iter().all(|vertex| vertex.normal == Vec3::Z), "{name}");
    let (low, high) = scene.bounds();
    assert_eq!((low, high), (vec3(-1.0, -1.0, 0.0), vec3(1.0, 1.0, 0.0)), "{name}");
}

#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn crafted_files_that_are_squares() {
    for name in [
        "emissive_strength.glb",
        "idx_u8.glb",
        "idx_u16.glb",
        "idx_u32.glb",
        "interleaved.glb",
        "lights_punctual.glb",
        "mode_strip.glb",
        "neg_scale.glb",
        "no_material.glb",
        "noindex_nonormal.glb",
        "normalized_u8_uv_u16_color.glb",
        "zero_normals.glb",
    ] {
        check_square(&crafted(name).expect(name), name);
    }
}

#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn crafted_files_with_something_to_drop() {
    let noted = |scene: &Scene, note: &str| scene.notes.iter().any(|line| line == note);
    let scene = crafted("degenerate_triangles.glb").expect("loads");
    assert_eq!(scene.triangles.len(), 2);
    assert!(noted(&scene, "triangles without area left out: 2"));
    let scene = crafted("position_inf.glb").expect("loads");
    assert_eq!(scene.triangles.len(), 1);
    assert!(noted(&scene, "triangles with non-finite vertices left out: 1"));
    for name in ["mode_lines.glb", "mode_points.glb"] {
        let scene = crafted(name).expect(name);
        assert!(scene.triangles.is_empty());
        assert!(noted(&scene, "primitives of points or lines left out: 1"));
    }
    assert!(crafted("empty_scene.gltf").expect("loads").triangles.is_empty());
    let scene = crafted("no_scene.gltf").expect("loads");
    assert_eq!(scene.triangles.len(), 1);
    assert!(noted(&scene, "no scene defined, all root nodes drawn: 1"));
    let scene = crafted("sparse_positions.glb").expect("loads");
    assert_eq!(scene.bounds().1, vec3(2.0, 2.0, 0.0));
}

#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn crafted_files_with_attributes() {
    let scene = crafted("emissive_strength.glb").expect("loads");
    assert_eq!(scene.materials[0].emission, vec3(20.0, 10.0, 5.0));

    // glTF's default material, by the letter of the specification.
    let material = &crafted("no_material.glb").expect("loads").materials[0];
    assert_eq!((material.base_color, material.metallic, material.roughness), (Vec3::ONE, 1.0, 1.0));

    // Each node is turned by 2 asin(0.1) about x: −z turns to (0, sin, −cos) of that angle.
    let scene = crafted("lights_punctual.glb").expect("loads");
    let angle = 2.0 * 0.1_f32.asin();
    let axis = vec3(0.0, angle.sin(), -angle.cos());
    let [
        Light::Point { position, intensity },
        Light::Spot { position: from, direction, intensity: on_axis, inner, outer },
        Light::Directional { direction: parallel, irradiance },
    ] = scene.lights[..]
    else {
        panic!("{:?}", scene.lights)
    };
    assert_eq!((position, intensity), (vec3(0.0, 0.0, 2.0), vec3(100.0, 0.0, 0.0)));
    assert_eq!((from, on_axis), (vec3(0.0, 1.0, 2.0), Vec3::splat(50.0)));
    assert_eq!((inner, outer), (0.2, 0.5));
    // The file's quaternion has six digits.
    assert!(direction.abs_diff_eq(axis, 1e-5) && parallel.abs_diff_eq(axis, 1e-5), "{direction}");
    assert_eq!(irradiance, vec3(3.0, 3.0, 1.5));
}

/// Triangles of MANIFEST.md less those without area, which import drops and counts.
#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn real_scenes_have_their_triangles() {
    for (file, triangles, dropped) in [
        ("BreakfastRoom", 269_538, 0),
        ("CornellBox", 36, 0),
        ("CornellBoxGlossyBack", 36, 0),
        ("DamagedHelmet", 15_452, 0),
        ("ModernHall_staircase2", 31_247, 2_432),
        ("Sibenik", 76_527, 3),
        ("SponzaCrytek", 262_267, 1),
        ("SponzaDabrovic", 66_445, 0),
    ] {
        let path = common::assets().join("scenes").join(file).with_extension("glb");
        let scene = load_path(&path).unwrap_or_else(|error| panic!("{error}"));
        common::check_invariants(&scene, file);
        assert_eq!(scene.triangles.len(), triangles - dropped, "{file}");
        let note = format!("triangles without area left out: {dropped}");
        assert_eq!(scene.notes.contains(&note), dropped > 0, "{file}: {:?}", scene.notes);
    }
}

/// The repository's own scene files.
fn scene_files() -> Vec<PathBuf> {
    files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes"), &["toml"])
}

#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn scene_files_load() {
    for path in scene_files() {
        let scene = load_path(&path).unwrap_or_else(|error| panic!("{error}"));
        let name = path.display().to_string();
        common::check_invariants(&scene, &name);
        let is_lit = !scene.lights.is_empty() || scene.all_area_lights().next().is_some();
        assert!(is_lit, "{name}");
        assert!(scene.cameras.iter().all(|camera| camera.name != "framed"), "{name}");
    }
}

/// Without the assets they say where to get them.
#[test]
fn scene_files_without_assets_say_what_is_missing() {
    let mut files = scene_files();
    files.retain(|path| std::fs::read_to_string(path).expect("a scene file").contains("asset:"));
    assert!(files.len() >= 5, "{files:?}");
    for path in files {
        let loaded = load(path.to_str().expect("UTF-8"), None).map(|scene| scene.name);
        let error = loaded.expect_err("needs an asset");
        let line = common::check_line(&error);
        assert!(line.contains("MANYLIGHTS_ASSETS"), "{line}");
    }
}
