//! `render` and `run` on scenes that come from elsewhere; see README.md, Scenes.

use crate::common::{json, manylights, succeeded};
use manylights_metrics::RadianceImage;

const SCENES: [&str; 3] = ["sponza", "breakfast-room", "sibenik"];

#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn render() {
    let folder = tempfile::tempdir().expect("temporary folder");
    for scene in SCENES {
        let path = folder.path().join(format!("{scene}.exr"));
        let out = path.to_str().expect("UTF-8");
        let size = ["--resolution", "32x24", "--set", "lights=256"];
        let arguments = ["render", "--scene", scene, "--method", "vpl", "-o", out];
        succeeded(&manylights(&[&arguments[..], &size[..]].concat()));
        let image = RadianceImage::read_exr(&path).expect("a picture");
        let lit = image.pixels.iter().filter(|pixel| pixel[1] > 0.0).count();
        assert!(lit > 32 * 24 / 2, "{scene}: {lit} pixels are lit");
        assert!(path.with_extension("png").exists());
    }
}

#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn run() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let experiment = folder.path().join("experiment.toml");
    let text = r#"
title = "Real scenes"
question = "Do they run, and does a lamp of triangles come with a reason?"
scenes = ["sponza", "breakfast-room", "sibenik", "modern-hall"]
transport = "indirect-1"
references = ["traced", "ignored"]
[[methods]]
id = "vpl"
parameters = { lights = [64] }
[profiles.quick]
resolution = [24, 18]
reference_samples = 32
repetitions = 1
seeds = [1]
"#;
    std::fs::write(&experiment, text).expect("writable");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let (file, out, cache) = (path("experiment.toml"), path("out"), path("cache"));
    let arguments = ["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache];
    succeeded(&manylights(&arguments));
    let table = std::fs::read_to_string(path("out/table.md")).expect("a table");
    for scene in SCENES {
        assert!(table.contains(&format!("## {scene}")), "{table}");
        assert!(folder.path().join(format!("out/sheet-{scene}.png")).exists());
    }
    assert!(table.contains("declined: needs point-like primary lights"), "{table}");
}

#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn the_list_names_them() {
    let list = json(&["list", "scenes", "--json"]);
    for scene in SCENES {
        assert!(list.to_string().contains(scene), "{list}");
    }
}
