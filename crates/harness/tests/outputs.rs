//! What is written never replaces what it is made from.

use std::path::{Path, PathBuf};

use crate::common::{manylights, succeeded};
use serde_json::json;
use tempfile::TempDir;

/// A folder with `a.gltf`: a triangle that glows, its numbers in the file `buffer`, and two pictures, of which
/// import reads the first alone.
struct Place {
    folder: TempDir,
}

impl Place {
    fn new(buffer: &str, texture: &str, normals: &str) -> Self {
        let place = Self { folder: tempfile::tempdir().expect("temporary folder") };
        let numbers = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0_f32];
        place.write(buffer, &numbers.map(f32::to_le_bytes).concat());
        for picture in [texture, normals] {
            place.write(picture, b"");
            let format = image::ImageFormat::Png;
            let texel = image::RgbImage::from_pixel(1, 1, image::Rgb([9, 8, 7]));
            texel.save_with_format(place.path(picture), format).expect("writable");
        }
        let root = json!({
            "asset": { "version": "2.0" },
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }],
            "materials": [{
                "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } },
                "normalTexture": { "index": 1 },
                "emissiveFactor": [1, 1, 1],
            }],
            "textures": [{ "source": 0 }, { "source": 1 }],
            "images": [{ "uri": texture }, { "uri": normals }],
            "accessors": [{ "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3 }],
            "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
            "buffers": [{ "byteLength": 36, "uri": buffer }],
        });
        place.write("a.gltf", root.to_string().as_bytes());
        place.write("a.toml", b"about = \"a\"\nsource = \"a.gltf\"");
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn text(&self, name: &str) -> String {
        self.path(name).to_str().expect("UTF-8").to_owned()
    }

    fn write(&self, name: &str, bytes: &[u8]) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().expect("has one")).expect("writable");
        std::fs::write(path, bytes).expect("writable");
    }

    /// An experiment of this scene.
    fn write_experiment(&self, name: &str) {
        let scene = self.text("a.gltf");
        let text = format!(
            "title = 'Test'\nquestion = 'What is lost?'\nscenes = ['{scene}']\n\
             transport = 'all'\nreferences = ['traced']\n\
             [[methods]]\nid = 'reference'\nparameters = {{ samples = [16] }}\n\
             [profiles.quick]\nresolution = [24, 16]\nreference_samples = 16\nrepetitions = 1\n\
             seeds = [1]\n"
        );
        self.write(name, text.as_bytes());
    }

    fn files(&self) -> Vec<(PathBuf, Vec<u8>)> {
        let mut files = Vec::new();
        let mut folders = vec![self.folder.path().to_owned()];
        while let Some(folder) = folders.pop() {
            for entry in folder.read_dir().expect("readable") {
                let path = entry.expect("readable").path();
                if path.is_dir() {
                    folders.push(path);
                } else {
                    files.push((path.clone(), std::fs::read(&path).expect("readable")));
                }
            }
        }
        files.sort();
        files
    }

    /// Asserts that the command is refused for the sake of this input and changes no file.
    fn keeps(&self, arguments: &[&str], input: &str, option: &str) {
        let before = self.files();
        let output = manylights(arguments);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {errors}");
        // Lines before the last are the scene's notes.
        let line = errors.lines().last().expect("a reason");
        let name = Path::new(input).file_name().and_then(|name| name.to_str()).expect("UTF-8");
        let said = line.contains(&format!("{name}, which is an input: choose another {option}"));
        assert!(said, "{arguments:?}: {line}");
        assert!(self.files() == before, "{arguments:?} changed a file");
    }

    fn renders(scene: &str, out: &str) -> Vec<String> {
        let words = ["render", "--method", "reference", "--resolution", "16x16", "--scene"];
        let arguments = words.into_iter().chain([scene, "-o", out]);
        arguments.map(str::to_owned).collect()
    }

    fn render_keeps(&self, scene: &str, out: &str, input: &str) {
        let arguments = Self::renders(&self.text(scene), &self.text(out));
        let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
        self.keeps(&arguments, input, "-o");
    }

    fn run_keeps(&self, experiment: &str, out: &str, input: &str) {
        let (file, out, cache) = (self.text(experiment), self.text(out), self.text("cache"));
        std::fs::create_dir_all(&cache).expect("writable");
        let arguments = ["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache];
        self.keeps(&arguments, input, "--out");
    }
}

#[test]
fn a_picture_never_replaces_what_its_scene_names() {
    let place = Place::new("mesh.exr", "paint.png", "bumps.png");
    for scene in ["a.gltf", "a.toml"] {
        place.render_keeps(scene, "paint.exr", "paint.png");
        place.render_keeps(scene, "bumps.exr", "bumps.png");
        place.render_keeps(scene, "mesh.exr", "mesh.exr");
    }
    std::fs::create_dir(place.path("x")).expect("writable");
    place.render_keeps("a.gltf", "x/../paint.exr", "paint.png");
    let arguments = Place::renders(&place.text("a.gltf"), &place.text("other.exr"));
    let inputs = place.files();
    succeeded(&manylights(&arguments.iter().map(String::as_str).collect::<Vec<_>>()));
    assert!(place.path("other.exr").exists() && place.path("other.png").exists());
    assert!(inputs.iter().all(|file| place.files().contains(file)), "an input changed");
}

#[cfg(unix)]
#[test]
fn links_are_the_files_that_they_lead_to() {
    let place = Place::new("mesh.bin", "paint.png", "bumps.png");
    std::os::unix::fs::symlink(place.path("paint.png"), place.path("soft.png")).expect("writable");
    std::fs::hard_link(place.path("bumps.png"), place.path("hard.png")).expect("writable");
    std::os::unix::fs::symlink(place.path("a.gltf"), place.path("scene.exr")).expect("writable");
    place.render_keeps("a.gltf", "soft.exr", "paint.png");
    place.render_keeps("a.gltf", "hard.exr", "bumps.png");
    place.render_keeps("a.gltf", "scene.exr", "a.gltf");
    // The scene names the link, and the output is where it leads.
    std::fs::rename(place.path("paint.png"), place.path("real.png")).expect("writable");
    std::os::unix::fs::symlink(place.path("real.png"), place.path("paint.png")).expect("writable");
    place.render_keeps("a.gltf", "real.exr", "paint.png");
}

#[test]
fn results_never_replace_the_question_or_its_scenes() {
    for input in ["curves.png", "sheet-a.png", "cells/old.png"] {
        let place = Place::new("mesh.bin", input, "bumps.png");
        place.write_experiment("experiment.toml");
        place.run_keeps("experiment.toml", "", input);
    }
    for input in ["report.html", "table.csv", "cells.jsonl"] {
        let place = Place::new(input, "paint.png", "bumps.png");
        place.write_experiment("experiment.toml");
        place.run_keeps("experiment.toml", "", input);
    }
    let place = Place::new("mesh.bin", "paint.png", "bumps.png");
    place.write_experiment("table.md");
    place.run_keeps("table.md", "", "table.md");
    let place = Place::new("experiment.toml", "paint.png", "bumps.png");
    place.write_experiment("mine.toml");
    place.run_keeps("mine.toml", "", "experiment.toml");
}

/// Results beside the question and its scenes are what is usual.
#[test]
fn results_may_lie_beside_the_question_and_its_scenes() {
    let place = Place::new("mesh.bin", "paint.png", "bumps.png");
    place.write_experiment("experiment.toml");
    let (file, cache) = (place.text("experiment.toml"), place.text("cache"));
    let inputs = place.files();
    for _ in 0..2 {
        succeeded(&manylights(&["run", &file, "--profile", "quick", "--cache", &cache]));
        assert!(place.path("sheet-a.png").exists() && place.path("report.html").exists());
        assert!(inputs.iter().all(|file| place.files().contains(file)), "an input changed");
    }
}

#[test]
fn a_baseline_never_replaces_what_its_scenes_name() {
    let place = Place::new("cells.jsonl", "paint.png", "bumps.png");
    place.write_experiment("experiment.toml");
    let baseline = place.text("");
    place.keeps(&["check", "--bless", "--baseline", &baseline], "cells.jsonl", "--baseline");
}

#[test]
fn merged_results_never_replace_what_is_merged() {
    let place = Place::new("mesh.bin", "paint.png", "bumps.png");
    for folder in ["ada", "bob"] {
        place.write_experiment(&format!("{folder}/experiment.toml"));
        place.write(&format!("{folder}/cells.jsonl"), b"damaged, and still somebody's\n");
        place.write(&format!("{folder}/cells/a-reference-traced.exr"), folder.as_bytes());
    }
    let [ada, bob] = ["ada", "bob"].map(|name| place.text(name));
    for out in [&ada, &bob] {
        place.keeps(&["merge", &ada, &bob, "--out", out], "cells.jsonl", "--out");
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&ada, place.path("link")).expect("writable");
        let link = place.text("link");
        place.keeps(&["merge", &ada, &bob, "--out", &link], "cells.jsonl", "--out");
        std::fs::create_dir(place.path("out")).expect("writable");
        std::os::unix::fs::symlink(place.path("bob/cells"), place.path("out/cells"))
            .expect("writable");
        place.keeps(&["merge", &ada, &bob, "--out", &place.text("out")], "cells", "--out");
    }
}
