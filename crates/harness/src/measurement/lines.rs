//! The lines of `cells.jsonl`, those of older and newer formats among them.

use std::path::Path;

use serde::Deserialize;

use crate::error::{Failure, one_line};
use crate::measurement::cell::{Cell, FORMAT, first_format};
use crate::measurement::valid;
use crate::output::say;

/// A line that is a cell.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    /// What this program understands of it.
    pub(crate) cell: Cell,
    /// With its line break. Newer formats may say more than the cell holds.
    pub(crate) text: String,
}

/// What a file holds.
pub(crate) struct Contents {
    /// In the order of the file; a key may occur twice, the later line counts.
    pub(crate) lines: Vec<Line>,
    /// One line for each line that is not a cell, and why.
    pub(crate) problems: Vec<String>,
    /// What to know of those that are.
    pub(crate) notes: Vec<String>,
}

impl Contents {
    /// Says what to know of the file, and of each line that is not a cell what `becomes` of it. Gives
    /// the cells.
    pub(crate) fn told(self, becomes: &str) -> Vec<Cell> {
        self.notes.iter().for_each(say);
        self.problems.iter().for_each(|problem| say(format_args!("{problem}; {becomes}")));
        self.lines.into_iter().map(|line| line.cell).collect()
    }
}

/// The line of a cell.
pub(crate) fn line(cell: &Cell) -> String {
    serde_json::to_string(cell).expect("a cell is plain data") + "\n"
}

/// Reads the cells at `path`; none where there is no file. A line is not a cell where a run was killed
/// while writing it or where it was edited, and where it lacks what this program needs.
///
/// # Errors
/// One line where the file cannot be read.
pub(crate) fn read(path: &Path) -> Result<Contents, Failure> {
    let at = |error: std::io::Error| Failure::input(format!("{}: {error}", path.display()));
    let bytes = if path.exists() { std::fs::read(path).map_err(at)? } else { Vec::new() };
    let text = String::from_utf8_lossy(&bytes);
    let mut contents = Contents { lines: Vec::new(), problems: Vec::new(), notes: Vec::new() };
    let mut newest = FORMAT;
    for (number, text) in (1..).zip(text.split_inclusive('\n')) {
        // Without its line break, a line may be the start of a longer one.
        let whole = text.strip_suffix('\n').ok_or_else(|| "damaged".to_owned());
        match whole.and_then(parse) {
            Ok(cell) => {
                newest = newest.max(cell.format);
                contents.lines.push(Line { cell, text: text.to_owned() });
            }
            Err(reason) => {
                contents.problems.push(format!("{} line {number}: {reason}", path.display()));
            }
        }
    }
    if newest > FORMAT {
        contents.notes.push(format!(
            "{}: written in format {newest}, this program knows {FORMAT}: what it does not know is \
             left out",
            path.display()
        ));
    }
    Ok(contents)
}

/// What every format has.
#[derive(Deserialize)]
struct Head {
    #[serde(default = "first_format")]
    format: u32,
}

fn parse(text: &str) -> Result<Cell, String> {
    let Head { format } = serde_json::from_str(text).map_err(|_| "damaged".to_owned())?;
    let cell: Cell = serde_json::from_str(text).map_err(|error| {
        let reason = one_line(&error.to_string());
        // The place is that of a line within itself.
        let reason = reason.split(" at line ").next().unwrap_or_default();
        match reason.strip_prefix("missing field ") {
            Some(field) => format!("written in format {format}: has no {field}"),
            None if format > FORMAT => {
                format!("written in format {format}, this program knows {FORMAT}: {reason}")
            }
            None => format!("damaged: {reason}"),
        }
    })?;
    valid::check(&cell).map_err(|reason| format!("damaged: {reason}"))?;
    // What goes into the keys of the first format depends on a program that is gone, and what into
    // those of newer ones is not known here.
    if format == FORMAT && cell.key != cell.inputs.key(&cell.versions, &cell.provenance) {
        return Err("foreign: its key is not that of its inputs".to_owned());
    }
    Ok(cell)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::valid::tests::done_cell;

    fn read_text(text: &str) -> Contents {
        let folder = tempfile::tempdir().expect("temporary folder");
        let path = folder.path().join("cells.jsonl");
        std::fs::write(&path, text).expect("writable");
        read(&path).expect("readable")
    }

    #[test]
    fn foreign_and_damaged_lines_are_named_and_not_used() {
        let [good, other] = [done_cell(1), done_cell(2)];
        let foreign = line(&Cell { key: good.key.clone(), ..other });
        let killed = line(&good);
        let text = format!("{foreign}nonsense\n{}{}", line(&good), killed.trim_end());
        let contents = read_text(&text);
        assert_eq!(contents.lines, [Line { text: line(&good), cell: good }]);
        let [foreign, damaged, killed] = &contents.problems[..] else { panic!("three problems") };
        assert!(foreign.contains("line 1: foreign"), "{foreign}");
        assert!(damaged.contains("line 2: damaged"), "{damaged}");
        assert!(killed.contains("line 4: damaged"), "{killed}");
    }

    #[test]
    fn older_formats_are_read_or_say_what_they_lack() {
        let cell = done_cell(1);
        let mut value = serde_json::to_value(&cell).expect("plain data");
        let object = value.as_object_mut().expect("an object");
        for field in ["format", "versions", "checkpoints", "pass_seconds", "counters"] {
            object.remove(field).expect("there");
        }
        object["key"] = "0".repeat(64).into();
        let contents = read_text(&format!("{value}\n"));
        assert_eq!(contents.problems, [""; 0]);
        assert_eq!(contents.lines[0].cell.format, 1);
        assert_eq!(contents.lines[0].cell.inputs, cell.inputs);

        let lacking = value.to_string().replace("\"rel_p999\":0.9", "\"other\":0.9");
        let [problem] = &read_text(&format!("{lacking}\n")).problems[..] else { panic!("one") };
        assert!(problem.contains("line 1: written in format 1: has no `rel_p999`"), "{problem}");
    }

    #[test]
    fn newer_formats_are_read_as_far_as_they_are_known() {
        let cell = Cell { format: FORMAT + 1, ..done_cell(1) };
        let text = line(&cell).replacen('{', "{\"weather\":\"fine\",", 1);
        let contents = read_text(&text);
        assert_eq!(contents.lines, [Line { cell, text }]);
        let [note] = &contents.notes[..] else { panic!("one note") };
        assert!(note.contains("written in format 3, this program knows 2"), "{note}");
        // An unknown field of this format says nothing of a newer one.
        let contents = read_text(&line(&done_cell(1)).replacen('{', "{\"weather\":\"fine\",", 1));
        assert_eq!((contents.lines.len(), contents.notes.len()), (1, 0));
    }
}
