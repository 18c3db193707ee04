use std::fmt::Write as _;

use super::{Table, across_scenes, foot, head, of_scene, published, verdicts};
use crate::answer::rows::SceneAnswer;
use crate::measurement::provenance::Provenance;
use crate::question::experiment::Experiment;

/// The tables for people.
pub(crate) fn markdown(
    experiment: &Experiment,
    scenes: &[SceneAnswer],
    machine: &Provenance,
) -> String {
    let [scale, program] = head(experiment, machine);
    let Experiment { title, question, .. } = experiment;
    let mut text = format!("# {title}\n\n{question}\n\n{scale}\n{program}\n");
    let _ = write!(text, "\n## Over all scenes\n");
    for verdict in verdicts(experiment, scenes) {
        let _ = write!(text, "\n{verdict}\n");
    }
    for table in across_scenes(experiment, scenes) {
        write_table(&mut text, &table);
    }
    for scene in scenes {
        let _ = write!(text, "\n## {}\n", scene.scene);
        for table in of_scene(experiment, scene) {
            write_table(&mut text, &table);
        }
    }
    if let Some(table) = published(experiment, scenes) {
        text.push_str("\n## Published values\n");
        write_table(&mut text, &table);
    }
    let _ = write!(text, "\n{}\n", foot(experiment));
    text
}

fn write_table(text: &mut String, table: &Table) {
    let titles: Vec<_> = table.heading.iter().map(|(title, _)| *title).collect();
    let rules: Vec<_> =
        table.heading.iter().map(|(_, n)| if *n { "---:" } else { "---" }).collect();
    let _ =
        write!(text, "\n{}:\n\n| {} |\n|{}|\n", table.caption, titles.join(" | "), rules.join("|"));
    for line in &table.lines {
        // A reason must not break the table.
        let mut cells: Vec<_> = line.iter().map(|cell| cell.replace('|', "\\|")).collect();
        cells.resize(titles.len(), String::new());
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
}
