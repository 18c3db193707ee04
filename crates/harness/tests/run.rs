//! `manylights run`: what it writes, and how it goes on after an interruption.

use std::path::Path;
use std::process::Output;

use crate::common::{manylights, refused, succeeded};
use manylights_metrics::{RadianceImage, compare_display, compare_linear};

const EXPERIMENT: &str = r#"
title = "Test"
question = "Does it run?"
scenes = ["cornell"]
transport = "indirect-1"
references = ["traced", "ignored"]
[[methods]]
id = "reference"
parameters = { samples = [16, 48] }
[profiles.quick]
resolution = [24, 16]
reference_samples = 64
repetitions = 2
seeds = [1, 2]
[exposures]
cornell = 2.0
"#;
/// Two settings, two seeds, two repetitions.
const CELLS: usize = 8;

fn run(folder: &Path) -> Output {
    let path = |name: &str| folder.join(name).to_str().expect("UTF-8").to_owned();
    let (file, out, cache) = (path("experiment.toml"), path("out"), path("cache"));
    manylights(&["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache])
}

fn lines(folder: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(folder.join("out/cells.jsonl")).expect("a journal");
    text.lines().map(str::to_owned).collect()
}

#[test]
fn a_run_writes_its_answer_and_goes_on_after_an_interruption() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let folder = folder.path();
    std::fs::write(folder.join("experiment.toml"), EXPERIMENT).expect("writable");
    let output = run(folder);
    succeeded(&output);
    assert!(output.stdout.is_empty(), "JSON only");
    check_files(folder);
    let first = lines(folder);
    assert_eq!(first.len(), CELLS);
    check_cells(&first);
    check_errors(folder, &first);

    succeeded(&run(folder));
    assert_eq!(lines(folder), first, "a finished run repeats nothing");

    // Killed while writing the last line.
    let text = std::fs::read(folder.join("out/cells.jsonl")).expect("a journal");
    std::fs::write(folder.join("out/cells.jsonl"), &text[..text.len() - 100]).expect("writable");
    let resumed = run(folder);
    succeeded(&resumed);
    let errors = String::from_utf8_lossy(&resumed.stderr);
    assert!(errors.contains(&format!("line {CELLS}: damaged")), "{errors}");
    let second = lines(folder);
    assert_eq!(second.len(), CELLS);
    assert_eq!(second[..CELLS - 1], first[..CELLS - 1], "the others are kept");

    // A damaged line in the middle.
    let mut damaged = second.clone();
    damaged[2].insert(10, '\u{1}');
    std::fs::write(folder.join("out/cells.jsonl"), damaged.join("\n")).expect("writable");
    let errors = run(folder).stderr;
    assert!(String::from_utf8_lossy(&errors).contains("line 3: damaged"));
    assert_eq!(lines(folder).len(), CELLS);
    check_cells(&lines(folder));
}

fn check_files(folder: &Path) {
    let out = folder.join("out");
    let text = |name: &str| std::fs::read_to_string(out.join(name)).expect(name);
    let markdown = text("table.md");
    assert!(markdown.contains("## cornell") && markdown.contains("noise floor"), "{markdown}");
    let (_, of_scene) = markdown.split_once("## cornell").expect("a scene");
    assert_eq!(of_scene.matches("reference samples=48").count(), 2, "{markdown}");
    let csv = text("table.csv");
    let columns: Vec<_> = csv.lines().map(|line| line.split(',').count()).collect();
    assert_eq!(columns.len(), 5, "a head, two settings, two references: {csv}");
    assert!(columns.iter().all(|&count| count == columns[0]), "{csv}");
    let curves = text("curves.svg");
    assert!(curves.contains("noise floor") && curves.ends_with("</svg>\n"), "not a figure");
    image::open(out.join("sheet-cornell.png")).expect("a sheet");
    let pictures = out.join("cells").read_dir().expect("pictures").count();
    let cells = 2 * 2 * 2; // an EXR and a PNG for each setting and seed
    assert_eq!(pictures, cells + 2 + 2, "layers of each setting; references");
}

fn check_cells(lines: &[String]) {
    let cells: Vec<serde_json::Value> =
        lines.iter().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    for cell in &cells {
        assert_eq!(cell["outcome"], "done");
        assert!(cell["step_seconds"].as_f64().expect("a time") > 0.0);
        assert!(cell["errors"]["ignored"]["linear_floor"].as_f64().expect("a floor") > 0.0);
        assert!(cell["provenance"]["adapter"].is_null(), "none is needed");
        let (n, rmse) =
            (&cell["parameters"]["samples"], &cell["errors"]["traced"]["linear"]["rmse"]);
        let scaled = rmse.as_f64().expect("an error") * n.as_f64().expect("a count").sqrt();
        let floor = cell["errors"]["traced"]["linear_floor"].as_f64().expect("a floor");
        // Noise falls with the root of the samples: that of n samples is that of 64 times √(64/n).
        // Over 24×16 pixels the noise of an estimate of variance is some 10 %; 2 is far outside.
        let expected = floor * 8.0;
        assert!((0.5..2.0).contains(&(scaled / expected)), "{scaled} is not near {expected}");
    }
}

/// Errors are those of the written pictures: of radiance, and of what is shown at the experiment's exposure.
fn check_errors(folder: &Path, lines: &[String]) {
    let read = |name: &str| {
        RadianceImage::read_exr(&folder.join("out/cells").join(name)).expect("a picture")
    };
    for line in lines {
        let cell: serde_json::Value = serde_json::from_str(line).expect("JSON");
        // Repetitions have the same picture.
        if cell["repetition"] != 0 {
            continue;
        }
        let key = cell["key"].as_str().expect("a key");
        let image = read(&format!("cornell-{}.exr", &key[..16]));
        for visibility in ["traced", "ignored"] {
            let reference = read(&format!("cornell-reference-{visibility}.exr"));
            let errors = &cell["errors"][visibility];
            let linear = compare_linear(&image, &reference).expect("comparable");
            let display = compare_display(&image, &reference, 2.0).expect("comparable");
            assert_eq!(errors["linear"], serde_json::to_value(linear).expect("plain data"));
            assert_eq!(errors["display"], serde_json::to_value(display).expect("plain data"));
        }
    }
}

#[test]
fn bad_experiments_are_refused_before_rendering() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let file = folder.path().join("experiment.toml");
    let file = file.to_str().expect("UTF-8");
    for (from, to, said) in [
        ("title", "titel", "did you mean `title`?"),
        ("\"cornell\"", "\"cornel\"", "cornell"),
        ("\"cornell\"", "\"cornell\", \"cornell\"", "listed twice"),
        ("\"reference\"", "\"referense\"", "did you mean `reference`?"),
        ("samples = [16", "sample = [16", "did you mean `samples`?"),
        ("[24, 16]", "[24, 0]", "sides must be 1"),
        ("title = ", "title ", "line 2"),
        ("profiles.quick", "profiles.paper", "[profiles.quick]"),
    ] {
        assert!(EXPERIMENT.contains(from), "{from}");
        std::fs::write(file, EXPERIMENT.replace(from, to)).expect("writable");
        let out = folder.path().join("out");
        let out = out.to_str().expect("UTF-8");
        refused(&["run", file, "--profile", "quick", "--out", out, "--cache", out], said);
    }
    refused(&["run", "missing.toml"], "missing.toml");
}

#[test]
fn unwritable_folders_are_refused_before_rendering() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let (file, good) = (path("experiment.toml"), path("good"));
    std::fs::write(&file, EXPERIMENT).expect("writable");
    let bad = format!("{file}/out");
    let start = ["run", &file, "--profile", "quick"];
    refused(&[&start[..], &["--out", &bad, "--cache", &good]].concat(), "choose another --out");
    refused(&[&start[..], &["--out", &good, "--cache", &bad]].concat(), "choose another --cache");
}
