//! The bench: time budgets, jobs for other machines, regression check, exports.

use std::collections::BTreeSet;

use crate::common::{json, manylights, manylights_on, refused, spawn, succeeded};
use serde_json::Value;

const EXPERIMENT: &str = r#"
title = "Test"
question = "Does it run?"
scenes = ["cornell", "trio"]
transport = "indirect-1"
references = ["traced"]
errors = [0.2, 1e-9]
[[methods]]
id = "reference"
parameters = { samples = [16, 64] }
[[methods]]
id = "reference"
budget = "time"
[[published]]
source = "nobody"
scene = "trio"
method = { id = "reference", parameters = { samples = 16 } }
reference = "traced"
values = { psnr = 20.0 }
[profiles.quick]
resolution = [24, 16]
reference_samples = 64
repetitions = 2
seeds = [1, 2]
times = [0.02, "baseline"]
"#;

/// A folder with an experiment, and what the command line says of it.
struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn new(experiment: &str) -> Self {
        let folder = tempfile::tempdir().expect("temporary folder");
        std::fs::write(folder.path().join("experiment.toml"), experiment).expect("writable");
        Self { folder }
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).to_str().expect("UTF-8").to_owned()
    }

    fn run(&self, out: &str, more: &[&str]) {
        let (file, out, cache) = (self.path("experiment.toml"), self.path(out), self.path("cache"));
        let start = ["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache];
        succeeded(&manylights(&[&start[..], more].concat()));
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).expect(name)
    }

    fn cells(&self, out: &str) -> Vec<Value> {
        let text = self.read(&format!("{out}/cells.jsonl"));
        text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
    }
}

#[test]
fn time_budgets_set_the_amount_of_work_and_tables_show_it() {
    let place = Place::new(EXPERIMENT);
    place.run("out", &[]);
    let cells = place.cells("out");
    let timed = || cells.iter().filter(|cell| cell["budget"] != "count");
    for scene in ["cornell", "trio"] {
        for budget in [serde_json::json!({ "seconds": 0.02 }), Value::from("baseline")] {
            let alike = timed().filter(|c| c["scene"] == scene && c["budget"] == budget);
            // By key: corrections write a cell again.
            let last: std::collections::BTreeMap<String, u64> = alike
                .map(|c| (c["key"].to_string(), c["amount"].as_u64().expect("an amount")))
                .collect();
            assert_eq!(last.len(), 4, "two seeds, two repetitions");
            let amounts: BTreeSet<_> = last.values().collect();
            assert_eq!(amounts.len(), 1, "all runs of a variant do the same work: {amounts:?}");
        }
    }
    assert!(timed().all(|cell| cell["parameters"].get("samples").is_none()));

    let markdown = place.read("out/table.md");
    for said in ["reference time=20.0 ms", "reference time=baseline", "bias", "deviation"] {
        assert!(markdown.contains(said), "{said}: {markdown}");
    }
    assert!(markdown.contains("| reference | traced | 1.00e-9 | not reached |"), "{markdown}");
    assert!(markdown.contains("| nobody | trio | reference samples=16 | traced | psnr | 20.0 |"));
    assert!(place.read("out/table.tex").contains("\\toprule"));
    let png = image::open(place.path("out/curves.png")).expect("a figure");
    assert!(png.width() > 1000);

    place.run("out", &[]);
    assert_eq!(place.cells("out"), cells, "a finished run repeats nothing");
}

#[test]
fn long_runs_have_checkpoints_on_the_way() {
    let place = Place::new(EXPERIMENT);
    place.run("out", &[]);
    let long = |cell: &&Value| cell["parameters"]["samples"] == 64.0;
    for cell in place.cells("out").iter().filter(long) {
        let points = cell["checkpoints"].as_array().expect("a list");
        let amounts: Vec<_> = points.iter().map(|point| point["amount"].as_u64()).collect();
        assert_eq!(amounts, [Some(16), Some(32)], "doubling, the end left to the cell itself");
        let error = |point: &Value| point["display_rmse"]["traced"].as_f64().expect("an error");
        assert!(error(&points[0]) > error(&points[1]), "more samples, less noise");
    }
}

#[test]
fn jobs_do_the_whole_experiment_piece_by_piece() {
    let counts = EXPERIMENT.replace("[[methods]]\nid = \"reference\"\nbudget = \"time\"\n", "");
    let place = Place::new(&counts);
    place.run("whole", &[]);
    let file = place.path("experiment.toml");
    let jobs = json(&["plan", &file, "--profile", "quick", "--json"]);
    let jobs = jobs.as_array().expect("a list");
    assert_eq!(jobs.len(), 4, "two scenes, two settings");
    for (index, job) in jobs.iter().enumerate() {
        let worker = ["first", "second"][index % 2];
        place.run(worker, &["--cell", job["key"].as_str().expect("a key")]);
    }
    let merged = place.path("pieces");
    succeeded(&manylights(&[
        "merge",
        &place.path("first"),
        &place.path("second"),
        "--out",
        &merged,
    ]));
    assert_eq!(errors(&place.read("pieces/table.csv")), errors(&place.read("whole/table.csv")));
    let pictures = |out: &str| -> BTreeSet<(String, String)> {
        let cells = place.cells(out);
        cells.iter().map(|c| (c["key"].to_string(), c["image_sha256"].to_string())).collect()
    };
    assert_eq!(pictures("pieces"), pictures("whole"));
    let out = place.path("pieces");
    refused(&["run", &file, "--profile", "quick", "--out", &out, "--cell", "0"], "not a key");
}

#[test]
fn a_run_that_is_killed_ten_times_gives_the_same_table() {
    let counts = EXPERIMENT.replace("[[methods]]\nid = \"reference\"\nbudget = \"time\"\n", "");
    let place = Place::new(&counts);
    place.run("undisturbed", &[]);
    let whole = place.cells("undisturbed").len();
    let (file, out, cache) = (place.path("experiment.toml"), place.path("out"), place.path("new"));
    let arguments = ["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache];
    let journal = place.path("out/cells.jsonl");
    let lines = || std::fs::read_to_string(&journal).unwrap_or_default().lines().count();
    let mut killed = 0;
    for kill in 0..10 {
        let mut child = spawn(&arguments);
        // Each run goes on where the last one ended; later ones are killed ever longer after a line.
        let enough = whole * kill / 10;
        while lines() < enough && child.try_wait().expect("it was started").is_none() {
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        std::thread::sleep(std::time::Duration::from_millis(3 * kill as u64));
        child.kill().expect("a process of ours");
        child.wait().expect("it was started");
        killed += usize::from(lines() < whole);
    }
    assert!(killed >= 3, "killed on the way {killed} times");
    succeeded(&manylights(&arguments));
    assert_eq!(errors(&place.read("out/table.csv")), errors(&place.read("undisturbed/table.csv")));
}

/// The lines of a table without what the clock says.
fn errors(csv: &str) -> BTreeSet<Vec<String>> {
    let mut lines = csv.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().expect("a head");
    let told = |(name, _): &(&String, String)| !name.contains("seconds");
    lines.map(|line| head.iter().zip(line).filter(told).map(|(_, cell)| cell).collect()).collect()
}

#[test]
fn rows_of_several_machines_keep_their_own_baseline() {
    let counts = EXPERIMENT.replace("[[methods]]\nid = \"reference\"\nbudget = \"time\"\n", "");
    let place = Place::new(&counts.replace("\"cornell\", ", ""));
    let file = place.path("experiment.toml");
    for machine in ["ada", "bob"] {
        let (out, cache) = (place.path(machine), place.path("cache"));
        let arguments = ["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache];
        succeeded(&manylights_on(machine, &arguments));
    }
    let merged = place.path("merged");
    succeeded(&manylights(&["merge", &place.path("ada"), &place.path("bob"), "--out", &merged]));
    let table = place.read("merged/table.md");
    for machine in ["ada", "bob"] {
        let base = format!("| reference samples=16 @{machine} |");
        let line = table.lines().find(|line| line.contains(&base)).expect(&base);
        // The base of its own machine: both ratios are one.
        assert_eq!(line.matches("| 1.00 |").count(), 2, "{line}");
    }
    let other = Place::new(&counts);
    other.run("out", &[]);
    let (other, merged) = (other.path("out"), merged.as_str());
    refused(&["merge", &other, "--out", merged], "only results of one experiment");
}

#[test]
fn a_check_passes_on_an_unchanged_tree_and_names_what_moved() {
    let place = Place::new(
        &EXPERIMENT
            .replace("[[methods]]\nid = \"reference\"\nbudget = \"time\"\n", "")
            .replace("\"cornell\", ", ""),
    );
    let baseline = place.folder.path().to_str().expect("UTF-8").to_owned();
    refused(&["check", "--baseline", &baseline], "no baseline: make one with --bless");
    succeeded(&manylights(&["check", "--baseline", &baseline, "--bless"]));
    assert_eq!(json(&["check", "--baseline", &baseline, "--json"]), serde_json::json!([]));

    // Two repetitions of two seeds tell too little of how far times spread.
    refused(&["check", "--baseline", &baseline, "--times"], "has 4 times over those of `reference");
    refused(&["check", "--baseline", &baseline, "--times", "--bless"], "--bless");

    // As if a picture had been another one: the check must name the cell.
    let text = place.read("cells.jsonl");
    let first: Value = serde_json::from_str(text.lines().next().expect("a line")).expect("JSON");
    let hash = first["image_sha256"].as_str().expect("a hash");
    std::fs::write(place.path("cells.jsonl"), text.replace(hash, &"0".repeat(64)))
        .expect("writable");
    let output = manylights(&["check", "--baseline", &baseline]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{errors}");
    assert!(errors.contains("trio reference samples=16  picture"), "{errors}");
    assert!(errors.contains("--bless"), "{errors}");

    // A second baseline beside it, which holds: only the first is named.
    let other = place.path("other");
    std::fs::create_dir(&other).expect("writable");
    let experiment = place.read("experiment.toml");
    std::fs::write(place.path("other/experiment.toml"), experiment).expect("writable");
    std::fs::write(place.path("other/cells.jsonl"), text).expect("writable");
    let output = manylights(&["check", "--baseline", &other, &baseline]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{errors}");
    assert!(errors.contains(&format!("{other}: nothing moved")), "{errors}");
    assert!(errors.contains(&format!("--baseline {baseline} --bless")), "{errors}");
}

#[test]
fn a_check_repeats_the_amounts_of_time_budgets() {
    let place = Place::new(&EXPERIMENT.replace("\"cornell\", ", ""));
    let baseline = place.folder.path().to_str().expect("UTF-8").to_owned();
    succeeded(&manylights(&["check", "--baseline", &baseline, "--bless"]));
    assert_eq!(json(&["check", "--baseline", &baseline, "--json"]), serde_json::json!([]));

    // An amount that no search finds: the check must take it, and say what that moves.
    let mut cells: Vec<Value> = place
        .read("cells.jsonl")
        .lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect();
    for cell in cells.iter_mut().filter(|cell| cell["budget"] != "count") {
        cell["amount"] = 7.into();
    }
    let lines: String = cells.iter().map(|cell| format!("{cell}\n")).collect();
    std::fs::write(place.path("cells.jsonl"), lines).expect("writable");
    let output = manylights(&["check", "--baseline", &baseline, "--json"]);
    let moved: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let counts = |moved: &&Value| moved["quantity"] == "counts";
    let counts: Vec<_> = moved.as_array().expect("a list").iter().filter(counts).collect();
    assert_eq!(counts.len(), 2, "both budgets: {moved}");
    for moved in counts {
        assert!(moved["now"].as_str().expect("text").contains("\"samples\": 7"), "{moved}");
    }
}

#[test]
fn each_camera_has_its_own_table_and_pictures() {
    let counts = EXPERIMENT.replace("[[methods]]\nid = \"reference\"\nbudget = \"time\"\n", "");
    let views = counts
        .replace("[\"cornell\", \"trio\"]", "[\"atrium\"]\ncameras = [\"nave\", \"aisle\"]")
        .replace("scene = \"trio\"", "scene = \"atrium-aisle\"");
    let place = Place::new(&views);
    place.run("out", &[]);
    let markdown = place.read("out/table.md");
    for said in ["## atrium-nave", "## atrium-aisle", "| nobody | atrium-aisle |"] {
        assert!(markdown.contains(said), "{said}: {markdown}");
    }
    assert!(!markdown.contains("bake ms"), "nothing is baked: {markdown}");
    let cells = place.cells("out");
    let hashes = |camera: &str| -> BTreeSet<String> {
        let seen = cells.iter().filter(|cell| cell["camera"] == camera);
        seen.map(|cell| cell["image_sha256"].to_string()).collect()
    };
    let [nave, aisle] = ["nave", "aisle"].map(hashes);
    assert!(nave.len() == 4 && aisle.len() == 4 && nave.is_disjoint(&aisle));
    let table = place.read("out/table.csv");
    let out = place.path("out");
    succeeded(&manylights(&["report", &out]));
    assert_eq!(place.read("out/table.csv"), table, "read back as it was written");

    let file = place.path("experiment.toml");
    let jobs = json(&["plan", &file, "--profile", "quick", "--json"]);
    let jobs = jobs.as_array().expect("a list");
    let of_aisle = |job: &&Value| job["camera"] == "aisle";
    let job = jobs.iter().find(of_aisle).expect("a job of the second camera");
    place.run("piece", &["--cell", job["key"].as_str().expect("a key")]);
    let piece = place.cells("piece");
    assert!(piece.len() == 4 && piece.iter().all(|cell| cell["camera"] == "aisle"));
    assert!(piece.iter().all(|cell| cells.iter().any(|other| cell["key"] == other["key"])));
    std::fs::write(&file, views.replace("\"aisle\"]", "\"aisel\"]")).expect("writable");
    let arguments = ["run", &file, "--profile", "quick", "--out", &out, "--cache", &out];
    refused(&arguments, "aisle");
}

#[test]
fn results_are_exported_for_trackers() {
    let place = Place::new(EXPERIMENT);
    place.run("out", &[]);
    let out = place.path("out");
    let bencher = json(&["export", &out, "--format", "bencher"]);
    let metric = &bencher["cornell/reference samples=16"]["rmse-traced"];
    let bound = |name: &str| metric[name].as_f64().expect("a number");
    assert!(bound("lower_value") <= bound("value") && bound("value") <= bound("upper_value"));
    let list = json(&["export", &out, "--format", "github-action-benchmark"]);
    let entry = &list.as_array().expect("a list")[0];
    assert!(["name", "unit", "value", "range"].iter().all(|key| entry.get(key).is_some()));
    refused(&["export", "missing", "--format", "bencher"], "no cells");
}

#[test]
fn shells_are_completed() {
    for shell in ["bash", "zsh", "fish", "powershell"] {
        let output = manylights(&["completions", shell]);
        succeeded(&output);
        assert!(String::from_utf8_lossy(&output.stdout).contains("manylights"));
    }
}

#[test]
fn help_has_no_colour_where_nobody_looks() {
    let output = manylights(&["run", "--help"]);
    succeeded(&output);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("Examples:") && !text.contains('\u{1b}'), "{text}");
}
