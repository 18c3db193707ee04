//! References that are pictures of another method, and direct light that all pictures share.

use std::path::Path;

use crate::common::{manylights, refused, succeeded};
use manylights_metrics::RadianceImage;
use serde_json::Value;

const EXPERIMENT: &str = r#"
title = "Test"
question = "How far is it from another method?"
scenes = ["cornell"]
transport = "indirect-1"
references = [
    { name = "many-lights", method = { id = "vpl", parameters = { lights = 4096 } } },
    { name = "itself", method = { id = "vpl", parameters = { lights = 256 } } },
    "ignored",
]
errors = [0.01]
[[methods]]
id = "vpl"
parameters = { lights = [256, 1024] }
[[published]]
source = "nobody"
scene = "cornell"
method = { id = "vpl", parameters = { lights = 1024 } }
reference = "many-lights"
values = { rmse = 0.0, psnr = 40.0 }
[profiles.quick]
resolution = [24, 16]
reference_samples = 64
repetitions = 2
seeds = [1, 2]
"#;

/// Runs an experiment in the folder `out` beside its file.
fn run(folder: &Path, experiment: &str) {
    let path = |name: &str| folder.join(name).to_str().expect("UTF-8").to_owned();
    std::fs::write(path("experiment.toml"), experiment).expect("writable");
    let (file, out, cache) = (path("experiment.toml"), path("out"), path("cache"));
    let arguments = ["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache];
    succeeded(&manylights(&arguments));
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).expect(name)
}

fn cells(folder: &Path) -> Vec<Value> {
    let text = read(folder, "out/cells.jsonl");
    text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

fn picture(folder: &Path, cell: &Value) -> RadianceImage {
    let key = &cell["key"].as_str().expect("a key")[..16];
    let scene = cell["scene"].as_str().expect("a name");
    let path = folder.join(format!("out/cells/{scene}-{key}.exr"));
    RadianceImage::read_exr(&path).expect("a picture")
}

#[test]
fn another_method_may_be_the_reference() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let folder = folder.path();
    run(folder, EXPERIMENT);
    let cells = cells(folder);
    assert_eq!(cells.len(), 8, "two settings, two seeds, two repetitions");
    for cell in &cells {
        let lights = cell["parameters"]["lights"].as_f64().expect("a count");
        let display = |reference: &str| &cell["errors"][reference]["display"];
        let rmse = |reference| display(reference)["rmse"].as_f64().expect("an error");
        // Against itself, of the same seed, nothing is left; another seed would leave noise.
        if lights == 256.0 {
            assert_eq!(rmse("itself"), 0.0);
            assert!(display("itself")["psnr"].is_null(), "infinite");
        } else {
            assert!(rmse("itself") > 0.0);
        }
        assert!(rmse("many-lights") > 0.0 && rmse("ignored") > 0.0);
        for reference in ["itself", "many-lights"] {
            assert_eq!(cell["errors"][reference]["display_floor"], 0.0);
            assert_eq!(cell["references"][reference]["method"], "vpl");
        }
        assert_eq!(cell["references"]["ignored"], 64);
        assert!(cell["errors"]["ignored"]["display_floor"].as_f64().expect("a floor") > 0.0);
    }
    check_answer(folder);

    let lines = read(folder, "out/cells.jsonl");
    run(folder, EXPERIMENT);
    assert_eq!(read(folder, "out/cells.jsonl"), lines, "a finished run repeats nothing");

    // The same answer from the files alone, in place and brought elsewhere.
    let table = read(folder, "out/table.csv");
    let path = |name: &str| folder.join(name).to_str().expect("UTF-8").to_owned();
    succeeded(&manylights(&["report", &path("out")]));
    assert_eq!(read(folder, "out/table.csv"), table);
    succeeded(&manylights(&["merge", &path("out"), "--out", &path("merged")]));
    assert_eq!(read(folder, "merged/table.csv"), table);
}

/// Tables name who made each reference, and nothing in them divides by zero.
fn check_answer(folder: &Path) {
    let markdown = read(folder, "out/table.md");
    for said in [
        "Against many-lights: vpl lights=4096, of the same seed:",
        "Against itself: vpl lights=256, of the same seed:",
        "Against ignored: path traced, visibility ignored, 64 samples a pixel:",
        "| vpl | itself | 0.0100 | ≤ ",
        "| nobody | cornell | vpl lights=1024 | many-lights | rmse | 0 |",
    ] {
        assert!(markdown.contains(said), "{said}: {markdown}");
    }
    // The baseline against itself.
    let first = |line: &str| line.starts_with("| 1") && line.contains("| vpl lights=256 |");
    assert!(markdown.lines().any(first), "{markdown}");
    let floors: Vec<_> = markdown.lines().filter(|line| line.contains("noise floor of")).collect();
    assert_eq!(floors.len(), 3, "{markdown}");
    assert!(floors[..2].iter().all(|line| line.contains("| — |")), "{floors:?}");
    assert!(!floors[2].contains('—'), "{floors:?}");
    for name in ["table.md", "table.csv", "table.tex", "curves.svg", "report.html"] {
        let text = read(folder, &format!("out/{name}"));
        // Numbers that are none; the page's scripts have names like these.
        let tables = if name == "report.html" { table_of(&text) } else { &text };
        assert!(!tables.contains("NaN"), "{name}");
    }
    let csv = read(folder, "out/table.csv");
    let against_itself =
        |line: &&str| line.contains("lights=256") && line.contains(",itself,done,1,");
    let zero = csv.lines().find(against_itself);
    let zero: Vec<_> = zero.expect("the row against itself").split(',').collect();
    let head: Vec<_> = csv.lines().next().expect("a head").split(',').collect();
    let value = |name: &str| zero[head.iter().position(|column| *column == name).expect(name)];
    for exact in ["display_rmse", "linear_rmse", "display_bias", "display_deviation"] {
        assert_eq!(value(exact), "0", "{exact}");
    }
    assert_eq!(value("display_psnr"), "inf");
    image::open(folder.join("out/sheet-cornell.png")).expect("a sheet");
}

/// The numbers of a page.
fn table_of(page: &str) -> &str {
    let (_, rest) = page.split_once("id=\"data\">").expect("data");
    rest.split_once("</script>").expect("their end").0
}

#[test]
fn a_reference_that_declines_is_refused_before_rendering() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let (file, out, cache) = (path("experiment.toml"), path("out"), path("cache"));
    let several = EXPERIMENT.replace("indirect-1", "indirect-2").replace("    \"ignored\",\n", "");
    std::fs::write(&file, several).expect("writable");
    let arguments = ["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache];
    refused(&arguments, "reference `many-lights` of cornell: computes one indirect bounce");
    assert_eq!(std::fs::read_to_string(path("out/cells.jsonl")).unwrap_or_default(), "");
}

/// The shared direct light is in the pictures of all methods, and in the references; what is left of
/// them is the estimate of one bounce, and so are the errors.
#[test]
fn direct_light_is_shared_by_all_pictures() {
    let experiment = |transport: &str| {
        format!(
            r#"
title = "Test"
question = "Is direct light the same for all?"
scenes = ["cornell"]
transport = "{transport}"
references = ["traced", "ignored"]
[[methods]]
id = "reference"
parameters = {{ samples = 32 }}
[[methods]]
id = "vpl"
parameters = {{ lights = 256 }}
[profiles.quick]
resolution = [24, 16]
reference_samples = 64
repetitions = 1
seeds = [1]
"#
        )
    };
    let [apart, together] = ["indirect-1", "direct+indirect-1"].map(|transport| {
        let folder = tempfile::tempdir().expect("temporary folder");
        run(folder.path(), &experiment(transport));
        folder
    });
    let [apart, together] = [apart.path(), together.path()];
    let scene = manylights_scene::load("cornell", None).expect("built in");
    let direct =
        manylights_path_tracer::direct_light(&scene, &scene.cameras[0], [24, 16]).expect("exact");
    assert!(direct.pixels.iter().any(|pixel| pixel[1] > 0.0));
    let sum = |estimate: &RadianceImage| {
        let parts = estimate.pixels.as_flattened().iter().zip(direct.pixels.as_flattened());
        parts.map(|(estimate, direct)| estimate + direct).collect::<Vec<f32>>()
    };
    let pairs = cells(apart).into_iter().zip(cells(together));
    for (estimate, whole) in pairs {
        assert_eq!(whole["transport"], "direct+indirect-1");
        assert_eq!(estimate["visibility"], whole["visibility"]);
        let [part, all] = [picture(apart, &estimate), picture(together, &whole)];
        assert_eq!(all.pixels.as_flattened(), sum(&part), "{}", whole["method"]);
        for reference in ["traced", "ignored"] {
            let rmse = |cell: &Value| {
                cell["errors"][reference]["linear"]["rmse"].as_f64().expect("an error")
            };
            let [a, b] = [rmse(&estimate), rmse(&whole)];
            assert!((a - b).abs() < 1e-5 * a, "radiance errs as without direct light: {a} {b}");
        }
    }
    for reference in ["traced", "ignored"] {
        let name = format!("out/cells/cornell-reference-{reference}.exr");
        let image = |folder: &Path| RadianceImage::read_exr(&folder.join(&name)).expect("kept");
        assert_eq!(image(together).pixels.as_flattened(), sum(&image(apart)));
    }
    let caches = [apart, together].map(|folder| {
        let entries = folder.join("cache").read_dir().expect("a cache");
        let mut names: Vec<_> = entries.map(|entry| entry.expect("an entry").file_name()).collect();
        names.sort();
        names
    });
    assert_eq!(caches[0], caches[1], "one bounce is traced once for both transports");
}
