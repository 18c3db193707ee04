//! What is committed is read as it was written; what somebody spoilt ends in words.

use std::path::PathBuf;

use serde_json::{Value, json};

use super::*;
use crate::answer::regression;
use crate::answer::rows::{Row, SceneAnswer};
use crate::registry::METHODS;
use crate::show::curves::Figure;
use crate::show::table;

fn results() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../results")
}

fn experiment(folder: &Path, cells: &[Cell]) -> Experiment {
    let last = cells.last().expect("cells");
    let file = folder.join("experiment.toml");
    profile_of(last, &file, METHODS)
        .expect("readable")
        .unwrap_or_else(|| panic!("{} asks it", file.display()))
}

/// Fields by column: columns may be added.
fn fields(csv: &str) -> Vec<BTreeMap<String, String>> {
    let split = |line: &str| -> Vec<String> {
        // RFC 4180 without line breaks: a comma between two quotes is text.
        let mut quoted = false;
        let outside = line.split(|letter| {
            quoted ^= letter == '"';
            letter == ',' && !quoted
        });
        outside.map(str::to_owned).collect()
    };
    let mut lines = csv.lines().map(split);
    let head = lines.next().expect("a head");
    lines.map(|line| head.iter().cloned().zip(line).collect()).collect()
}

#[test]
fn committed_cells_give_the_committed_tables() {
    let mut tables = 0;
    for entry in results().read_dir().expect("results") {
        let folder = entry.expect("an entry").path();
        if !folder.join("cells.jsonl").exists() {
            continue;
        }
        let read = lines::read(&folder.join("cells.jsonl")).expect("readable");
        assert_eq!((read.problems.first(), read.notes.first()), (None, None));
        let cells = read.told("");
        let experiment = experiment(&folder, &cells);
        let (scenes, foreign) = scenes(&experiment, &cells).expect("one answer to each question");
        assert_eq!(foreign, 0, "{}", folder.display());
        let Ok(committed) = std::fs::read_to_string(folder.join("table.csv")) else { continue };
        let answers: Vec<SceneAnswer> =
            scenes.iter().map(|scene| SceneAnswer::of_cells(&experiment, scene)).collect();
        let csv = table::csv(&experiment, &answers);
        let (ours, theirs) = (fields(&csv), fields(&committed));
        assert_eq!(ours.len(), theirs.len(), "{}", folder.display());
        for (ours, theirs) in ours.iter().zip(&theirs) {
            // Bias is what pictures alone tell.
            for (column, value) in theirs.iter().filter(|(column, _)| !column.contains("_bias")) {
                if !column.contains("_deviation") {
                    assert_eq!(ours.get(column), Some(value), "{} {column}", folder.display());
                }
            }
        }
        answers.iter().for_each(|answer| ranks_agree_with_the_marks(&experiment, answer));
        if experiment.scale.seeds.len() == 1 {
            // With several seeds it has bias; the words around it may be put better.
            let machine = SceneCells::provenance(&scenes).expect("cells");
            let markdown = table::markdown(&experiment, &answers, machine);
            let committed = std::fs::read_to_string(folder.join("table.md")).expect("a table");
            let rows = |text: &str| -> Vec<String> {
                text.lines().filter(|line| line.starts_with('|')).map(str::to_owned).collect()
            };
            assert_eq!(rows(&markdown), rows(&committed), "{}", folder.display());
        }
        tables += 1;
    }
    assert!(tables >= 10, "{tables}");
}

/// What may be chance beside the baseline may have its place, and what may not has another.
fn ranks_agree_with_the_marks(experiment: &Experiment, answer: &SceneAnswer) {
    for reference in experiment.references.iter().map(|reference| &reference.name) {
        let ranks = answer.ranks(experiment, reference);
        let rank_of = |row: &Row| {
            let place = answer.rows.iter().position(|other| std::ptr::eq(other, row))?;
            ranks[place]
        };
        for row in &answer.rows {
            let Some(base) = answer.baseline(row) else { continue };
            let [budget, base_budget] =
                [row, base].map(|row| experiment.variants[row.variant].budget);
            let (Some(own), Some(other)) = (rank_of(row), rank_of(base)) else { continue };
            if budget != base_budget {
                continue;
            }
            let told = answer.excess(row, reference).filter(|excess| !excess.holds_zero());
            let agrees = match told {
                None => own.best <= other.worst && other.best <= own.worst,
                Some(_) => own != other,
            };
            let label = experiment.variants[row.variant].label();
            assert!(agrees, "{} {label} against {reference}: {own} and {other}", answer.scene);
        }
    }
}

/// The generator of Steele, Lea and Flood (2014), "Fast splittable pseudorandom number generators".
struct SplitMix(u64);

impl SplitMix {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % bound as u64) as usize
    }
}

/// Another value, or none, at a random place of a line.
fn spoil(value: &mut Value, random: &mut SplitMix) {
    match value {
        Value::Object(fields) if !fields.is_empty() => {
            let name = fields.keys().nth(random.below(fields.len())).expect("within").clone();
            match random.below(8) {
                0 => drop(fields.remove(&name)),
                1 => drop(fields.insert("new".into(), json!(1))),
                _ => spoil(&mut fields[&name], random),
            }
        }
        Value::Array(items) if !items.is_empty() && random.below(2) == 0 => {
            let index = random.below(items.len());
            spoil(&mut items[index], random);
        }
        leaf => {
            let absurd = [
                json!(null),
                json!(0),
                json!(-1.5),
                json!(1e308),
                json!(5e-324),
                json!(u64::MAX),
                json!(""),
                json!("\u{7f}|\n../"),
                json!("done"),
                json!([]),
                json!({}),
                json!(true),
            ];
            *leaf = absurd[random.below(absurd.len())].clone();
        }
    }
}

fn spoilt(line: &str, random: &mut SplitMix) -> String {
    match random.below(4) {
        0 => {
            let cut = random.below(line.len());
            String::from_utf8_lossy(&line.as_bytes()[..cut]).into_owned()
        }
        1 => {
            let mut bytes = line.as_bytes().to_vec();
            let index = random.below(bytes.len());
            bytes[index] ^= 1 << random.below(7);
            String::from_utf8_lossy(&bytes).into_owned()
        }
        _ => {
            let mut value: Value = serde_json::from_str(line).expect("JSON");
            (0..=random.below(3)).for_each(|_| spoil(&mut value, random));
            if let (0, Value::Object(fields)) = (random.below(2), &mut value) {
                // Its key vouches for nothing then.
                fields.insert("format".into(), json!(1));
            }
            value.to_string()
        }
    }
}

#[test]
fn spoilt_lines_end_in_words() {
    let folder = results().join("real-scenes");
    let path = folder.join("cells.jsonl");
    let text = std::fs::read_to_string(&path).expect("readable");
    let good = lines::read(&path).expect("readable").told("");
    let experiment = experiment(&folder, &good);
    let directory = tempfile::tempdir().expect("temporary folder");
    let path = directory.path().join("cells.jsonl");
    let mut random = SplitMix(1);
    let (mut refused, mut used) = (0, 0);
    for _ in 0..400 {
        let mut changed: Vec<String> = text.lines().map(str::to_owned).collect();
        let index = random.below(changed.len());
        changed[index] = spoilt(&changed[index], &mut random);
        std::fs::write(&path, changed.join("\n") + "\n").expect("writable");
        let read = lines::read(&path).expect("readable");
        for said in read.problems.iter().chain(&read.notes) {
            assert_eq!(said.lines().count(), 1, "{said}");
            refused += 1;
        }
        let cells: Vec<Cell> = read.lines.into_iter().map(|line| line.cell).collect();
        // As `check` and `report` do.
        regression::compare(&cells, &good);
        regression::compare(&good, &cells);
        match scenes(&experiment, &cells) {
            Err(reason) => assert_eq!(reason.lines().count(), 1, "{reason}"),
            Ok((scenes, _)) => {
                used += 1;
                let answers: Vec<SceneAnswer> =
                    scenes.iter().map(|scene| SceneAnswer::of_cells(&experiment, scene)).collect();
                let machine = SceneCells::provenance(&scenes).expect("cells");
                let texts = [
                    table::csv(&experiment, &answers),
                    table::markdown(&experiment, &answers, machine),
                    table::latex(&experiment, &answers, machine),
                    Figure::new(&experiment, &answers, None).svg().expect("a figure"),
                ];
                assert!(texts.iter().all(|text| !text.contains("NaN")));
            }
        }
    }
    assert!(refused > 100 && used > 300, "{refused} lines refused, {used} files used");
}
