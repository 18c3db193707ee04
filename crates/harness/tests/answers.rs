//! Answers do not depend on the way to them: `report` and `merge` give what `run` gave, and a run what
//! another one gives, whatever caches hold.

use std::path::Path;

use crate::common::{manylights, refused, succeeded};

const EXPERIMENT: &str = r#"
title = "Test"
question = "Is it the same?"
scenes = ["cornell", "trio"]
transport = "indirect-1"
references = ["traced", "ignored"]
[[methods]]
id = "reference"
parameters = { samples = [1, 4] }
visibility = ["traced", "ignored"]
[profiles.quick]
resolution = [16, 16]
reference_samples = 4
repetitions = 2
seeds = [1, 2]
"#;

struct Place(tempfile::TempDir);

impl Place {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("temporary folder"))
    }

    fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().expect("UTF-8").to_owned()
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).expect(name)
    }

    fn write(&self, name: &str, text: &str) -> String {
        std::fs::write(self.path(name), text).expect("writable");
        self.path(name)
    }

    fn run(&self, experiment: &str, out: &str, cache: &str) {
        let file = self.write("asked.toml", experiment);
        let (out, cache) = (self.path(out), self.path(cache));
        let arguments = ["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache];
        succeeded(&manylights(&arguments));
    }

    fn tables(&self, out: &str) -> [String; 3] {
        ["table.csv", "table.md", "table.tex"].map(|name| self.read(&format!("{out}/{name}")))
    }
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("writable");
    for entry in from.read_dir().expect("a folder") {
        let entry = entry.expect("an entry").path();
        let target = to.join(entry.file_name().expect("a name"));
        match entry.is_dir() {
            true => copy(&entry, &target),
            false => drop(std::fs::copy(&entry, &target).expect("copied")),
        }
    }
}

#[test]
fn report_and_merge_give_what_the_run_gave() {
    let place = Place::new();
    place.run(EXPERIMENT, "out", "cache");
    let tables = place.tables("out");
    let rows = tables[0].lines().count();
    assert_eq!(rows, 1 + 2 * 2 * 4, "a head; scenes, references, settings with their visibility");

    succeeded(&manylights(&["report", &place.path("out")]));
    assert_eq!(place.tables("out"), tables);

    // Two folders, lines in turn; the second first.
    let journal = place.read("out/cells.jsonl");
    for (part, name) in ["even", "odd"].into_iter().enumerate() {
        copy(place.path("out").as_ref(), place.path(name).as_ref());
        let lines = journal.lines().skip(part).step_by(2);
        let lines: String = lines.map(|line| format!("{line}\n")).collect();
        place.write(&format!("{name}/cells.jsonl"), &lines);
    }
    let merged = place.path("merged");
    succeeded(&manylights(&["merge", &place.path("odd"), &place.path("even"), "--out", &merged]));
    assert_eq!(place.tables("merged"), tables);

    // The same run once more, under another name.
    let first = journal.lines().next().expect("a line");
    let (start, rest) = first.split_once("\"key\":\"").expect("a key");
    let twin = start.replace("\"format\":2", "\"format\":1") + "\"key\":\"" + &"0".repeat(64);
    place.write("out/cells.jsonl", &format!("{journal}{twin}{}\n", &rest[64..]));
    refused(&["report", &place.path("out")], "two cells of one run");
}

/// Values of a column of `table.csv`.
fn column(csv: &str, name: &str) -> Vec<String> {
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().expect("a head");
    let place = head.iter().position(|&title| title == name).expect(name);
    lines.map(|line| line[place].to_owned()).collect()
}

/// Cells of an older program lack FLIP and the trimmed error: they are read, and nothing is shown for these.
#[test]
fn all_metrics_are_shown_where_they_are_known() {
    let place = Place::new();
    let columns = "columns = [\"rmse\", \"mae\", \"flip\", \"rel-mse\", \"rel-mse-trimmed\"]\n";
    let experiment = EXPERIMENT.replace("\"cornell\", \"trio\"", "\"cornell\"");
    place.run(&experiment.replace("[[methods]]", &format!("{columns}[[methods]]")), "out", "cache");
    let [csv, markdown, _] = place.tables("out");
    assert!(markdown.contains("| MAE | FLIP | relMSE | relMSE trimmed |"), "{markdown}");
    let new = ["display_flip", "display_rel_mse_trimmed", "linear_rel_mse_trimmed"];
    for name in new {
        let known = |value: &String| value.parse::<f64>().is_ok_and(|value| value > 0.0);
        assert!(column(&csv, name).iter().all(known), "{name}: {csv}");
    }
    assert!(!csv.contains("linear_flip"), "FLIP is of what is shown");

    let out = place.path("out");
    let curves = || place.read("out/curves.svg");
    assert!(curves().contains("RMSE of sRGB values") && curves().contains("noise floor"));
    succeeded(&manylights(&["report", &out, "--metric", "display_flip"]));
    assert!(curves().contains("FLIP of sRGB values"));
    let circles = || curves().matches("<circle").count();
    assert_eq!(circles(), 2 + 2 * 2 * 4, "the legend; references, axes, variants");
    assert!(!curves().contains("RMSE of") && !curves().contains("noise floor"));
    assert!(place.read("out/report.html").contains("FLIP of sRGB values"));
    refused(&["report", &out, "--metric", "display_filp"], "did you mean `display_flip`?");

    let older = place.read("out/cells.jsonl").lines().map(without_new_metrics).collect::<String>();
    place.write("out/cells.jsonl", &older);
    succeeded(&manylights(&["report", &out, "--metric", "display_flip"]));
    assert_eq!(circles(), 2, "no point is known");
    let csv = place.read("out/table.csv");
    for name in new {
        assert!(column(&csv, name).iter().all(String::is_empty), "{name}: {csv}");
    }
    assert!(column(&csv, "display_rmse").iter().all(|value| !value.is_empty()), "{csv}");
}

fn without_new_metrics(line: &str) -> String {
    let mut cell: serde_json::Value = serde_json::from_str(line).expect("JSON");
    let comparisons = cell["errors"].as_object_mut().expect("an object").values_mut();
    for comparison in comparisons {
        for space in ["linear", "display"] {
            let errors = comparison[space].as_object_mut().expect("an object");
            errors.remove("flip");
            assert!(errors.remove("rel_mse_trimmed").is_some());
        }
    }
    format!("{cell}\n")
}

#[test]
fn caches_decide_nothing() {
    let place = Place::new();
    let experiment = &EXPERIMENT.replace("\"cornell\", \"trio\"", "\"cornell\"");
    place.run(experiment, "cold", "cache");
    let more = experiment.replace("reference_samples = 4", "reference_samples = 256");
    place.run(&more, "more", "cache");
    place.run(experiment, "warm", "cache");
    let errors = |out: &str| -> Vec<String> {
        let text = place.read(&format!("{out}/cells.jsonl"));
        let cells = text.lines().map(|line| {
            let cell: serde_json::Value = serde_json::from_str(line).expect("JSON");
            cell["errors"].to_string()
        });
        cells.collect()
    };
    assert_eq!(errors("cold"), errors("warm"));
    assert_ne!(errors("cold"), errors("more"));
    // Two slices of 16, not the 4 that were asked for.
    assert!(place.read("warm/table.md").contains("32 samples a pixel"));

    // A finished run renders nothing, whatever became of the cache.
    let (journal, tables) = (place.read("warm/cells.jsonl"), place.tables("warm"));
    place.run(experiment, "warm", "empty");
    assert_eq!(place.read("warm/cells.jsonl"), journal);
    assert_eq!(place.tables("warm"), tables);
    let rendered = Path::new(&place.path("empty")).read_dir().expect("a folder").count();
    assert_eq!(rendered, 0, "references or direct light");

    // But not with the reference of another profile in its place.
    let other = place.path("more/cells/cornell-reference-traced.exr");
    std::fs::copy(other, place.path("warm/cells/cornell-reference-traced.exr")).expect("copied");
    refused(&["report", &place.path("warm")], "not the reference that the cells");
    place.run(experiment, "warm", "empty");
    assert_eq!(place.tables("warm"), tables);
    succeeded(&manylights(&["report", &place.path("warm")]));
}

#[test]
fn another_question_does_not_replace_an_answer() {
    let place = Place::new();
    place.run(EXPERIMENT, "out", "cache");
    let tables = place.tables("out");
    let file = place.write("other.toml", &EXPERIMENT.replace("\"Test\"", "\"Other\""));
    let arguments = ["run", &file, "--profile", "quick", "--out", &place.path("out")];
    refused(&arguments, "choose another --out");
    assert_eq!(place.tables("out"), tables);
    assert_eq!(place.read("out/experiment.toml"), EXPERIMENT);
}

#[test]
fn what_no_scene_or_seed_answers_is_refused() {
    let place = Place::new();
    let published = "[[published]]\nsource = \"x\"\nscene = \"cornel\"\nreference = \"traced\"\n\
                     method = { id = \"reference\", parameters = { samples = 1 } }\n\
                     values = { rmse = 0.1 }\n";
    let crop = "[[crops]]\nscene = \"cornel\"\nrectangle = [0.5, 0.5, 0.25, 0.25]\n";
    let exposure = "[exposures]\ncornel = 2.0\n";
    for (text, said) in [
        (
            format!("{EXPERIMENT}{published}"),
            "published: unknown scene `cornel`: did you mean `corn",
        ),
        (format!("{EXPERIMENT}{crop}"), "crops: unknown scene `cornel`: did you mean `cornell`?"),
        (
            format!("{EXPERIMENT}{exposure}"),
            "exposures: unknown scene `cornel`: did you mean `corn",
        ),
        // With cameras, pictures are those of the views.
        (
            EXPERIMENT
                .replace("\"cornell\", \"trio\"", "\"atrium\"")
                .replace("transport", "cameras = [\"nave\", \"aisle\"]\ntransport")
                + &crop.replace("cornel", "atrium-nav"),
            "crops: unknown scene `atrium-nav`: did you mean `atrium-nave`?",
        ),
        (EXPERIMENT.replace("[1, 2]", "[1, 1]"), "seeds: `1` is listed twice"),
    ] {
        let file = place.write("asked.toml", &text);
        refused(&["run", &file, "--profile", "quick", "--out", &place.path("out")], said);
        refused(&["plan", &file, "--profile", "quick"], said);
    }
}

#[test]
fn exact_pictures_have_no_ratio_of_errors() {
    let place = Place::new();
    let direct = EXPERIMENT
        .replace("\"indirect-1\"", "\"direct\"")
        .replace("\"traced\", \"ignored\"", "\"traced\"");
    place.run(&direct.replace("\"cornell\", \"trio\"", "\"cornell\""), "out", "cache");
    let [csv, markdown, latex] = place.tables("out");
    for text in [&csv, &markdown, &latex] {
        assert!(!text.contains("NaN"), "{text}");
    }
    let (_, of_scene) = markdown.split_once("## cornell").expect("a scene");
    let rows: Vec<&str> = of_scene.lines().filter(|line| line.contains("| reference ")).collect();
    assert_eq!(rows.len(), 2, "{markdown}");
    for row in rows {
        assert!(row.contains("| 0 | 0–0 | — |") && !row.contains('≈'), "{row}");
    }
}
