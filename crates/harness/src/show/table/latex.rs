use std::fmt::Write as _;

use super::{Table, across_scenes, foot, head, of_scene, published, verdicts};
use crate::answer::rows::SceneAnswer;
use crate::measurement::provenance::Provenance;
use crate::question::experiment::Experiment;

/// The tables for papers: one `table` with booktabs rules for each, to be `\input`.
pub(crate) fn latex(
    experiment: &Experiment,
    scenes: &[SceneAnswer],
    machine: &Provenance,
) -> String {
    let [scale, program] = head(experiment, machine);
    let mut text = format!(
        "% {}\n% {scale}\n% {program}\n% Needs \\usepackage{{booktabs,textcomp}} and UTF-8 input.\n",
        experiment.title.replace('\n', " ")
    );
    for verdict in verdicts(experiment, scenes) {
        let _ = writeln!(text, "% {verdict}");
    }
    for table in across_scenes(experiment, scenes) {
        write_table(&mut text, &table.caption, &table);
    }
    for scene in scenes {
        for table in of_scene(experiment, scene) {
            write_table(
                &mut text,
                &format!("{}: {}", scene.scene, lowered(&table.caption)),
                &table,
            );
        }
    }
    if let Some(table) = published(experiment, scenes) {
        write_table(&mut text, &table.caption, &table);
    }
    let _ = writeln!(text, "% {}", foot(experiment));
    text
}

fn write_table(text: &mut String, caption: &str, table: &Table) {
    let columns = table.heading.len();
    let letters: String = table.heading.iter().map(|(_, n)| if *n { 'r' } else { 'l' }).collect();
    let titles: Vec<_> = table.heading.iter().map(|(title, _)| escaped(title)).collect();
    let _ = write!(
        text,
        "\n\\begin{{table}}\n\\centering\n\\caption{{{}}}\n\\begin{{tabular}}{{{letters}}}\n\\toprule\n\
         {} \\\\\n\\midrule\n",
        escaped(caption),
        titles.join(" & ")
    );
    for line in &table.lines {
        let mut cells: Vec<_> = line.iter().map(|cell| escaped(cell)).collect();
        let full = line.len() == columns;
        if let (false, Some(last)) = (full, cells.last_mut()) {
            // A reason in words runs across the rest of the line.
            *last = format!("\\multicolumn{{{}}}{{l}}{{{last}}}", columns - line.len() + 1);
        }
        let _ = writeln!(text, "{} \\\\", cells.join(" & "));
    }
    text.push_str("\\bottomrule\n\\end{tabular}\n\\end{table}\n");
}

fn lowered(caption: &str) -> String {
    let mut letters = caption.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

/// Text with TeX's own characters made plain, and what is not ASCII made TeX's.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => escaped.extend(['\\', letter]),
            '\\' => escaped.push_str("\\textbackslash{}"),
            '~' => escaped.push_str("\\textasciitilde{}"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '÷' => escaped.push_str("$\\div$"),
            '≈' => escaped.push_str("$\\approx$"),
            '≥' => escaped.push_str("$\\ge$"),
            '≤' => escaped.push_str("$\\le$"),
            '×' => escaped.push_str("$\\times$"),
            '–' => escaped.push_str("--"),
            '—' => escaped.push_str("---"),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_well_formed_tex() {
        let table = Table {
            caption: "A & B_c".into(),
            heading: vec![("method", false), ("÷ base", true), ("n", true)],
            lines: vec![
                vec!["a_b".into(), "1.5 ≈".into(), "3".into()],
                vec!["c".into(), "declined: 5 % of {x}".into()],
            ],
        };
        let mut text = String::new();
        write_table(&mut text, &table.caption, &table);
        let expected = "
\\begin{table}
\\centering
\\caption{A \\& B\\_c}
\\begin{tabular}{lrr}
\\toprule
method & $\\div$ base & n \\\\
\\midrule
a\\_b & 1.5 $\\approx$ & 3 \\\\
c & \\multicolumn{2}{l}{declined: 5 \\% of \\{x\\}} \\\\
\\bottomrule
\\end{tabular}
\\end{table}
";
        assert_eq!(text, expected);
    }
}
