//! `cells.jsonl`: one line a finished cell, on disk before the next one starts.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::cell::Cell;
use crate::error::Failure;
use crate::output;

/// The cells of a directory of results.
pub(crate) struct Journal {
    path: PathBuf,
    file: File,
    cells: BTreeMap<String, Cell>,
    /// Keys in the order of the file.
    order: Vec<String>,
}

impl Journal {
    /// Opens the journal of `directory`. Lines that cannot be read (a run was killed while writing
    /// one) are reported, dropped from the file, and their cells run again.
    ///
    /// # Errors
    /// One line where the file cannot be read or written.
    pub(crate) fn open(directory: &Path) -> Result<Self, Failure> {
        let path = directory.join("cells.jsonl");
        let at = |error: std::io::Error| Failure::input(format!("{}: {error}", path.display()));
        let bytes = if path.exists() { std::fs::read(&path).map_err(at)? } else { Vec::new() };
        let text = String::from_utf8_lossy(&bytes);
        let mut cells = BTreeMap::new();
        let mut order = Vec::new();
        let mut kept = String::new();
        for (number, line) in (1..).zip(text.lines()) {
            match serde_json::from_str::<Cell>(line) {
                Ok(cell) => {
                    kept.push_str(line);
                    kept.push('\n');
                    // The later line of a key that failed and ran again counts.
                    let key = cell.key.clone();
                    if cells.insert(key.clone(), cell).is_none() {
                        order.push(key);
                    }
                }
                Err(_) => eprintln!(
                    "{} line {number}: damaged, dropped; its cell runs again",
                    path.display()
                ),
            }
        }
        if kept.as_bytes() != bytes {
            output::write(&path, kept.as_bytes())?;
        }
        let file = open(&path).map_err(at)?;
        Ok(Self { path, file, cells, order })
    }

    /// The finished cell of this key.
    pub(crate) fn get(&self, key: &str) -> Option<&Cell> {
        self.cells.get(key)
    }

    /// All cells, in the order in which they were first written.
    pub(crate) fn cells(&self) -> impl DoubleEndedIterator<Item = &Cell> {
        self.order.iter().map(|key| &self.cells[key])
    }

    /// Adds a finished cell.
    ///
    /// # Errors
    /// One line where the file cannot be written.
    pub(crate) fn append(&mut self, cell: &Cell) -> Result<(), Failure> {
        self.file
            .write_all(line(cell).as_bytes())
            .and_then(|()| self.file.sync_data())
            .map_err(|error| Failure::input(format!("cells.jsonl: {error}")))?;
        if self.cells.insert(cell.key.clone(), cell.clone()).is_none() {
            self.order.push(cell.key.clone());
        }
        Ok(())
    }

    /// Drops the cells that another build made of the same inputs on the same machine as `current`.
    /// Gives their keys.
    ///
    /// # Errors
    /// One line where the file cannot be written.
    pub(crate) fn retire(&mut self, current: &[&Cell]) -> Result<Vec<String>, Failure> {
        let superseded = |cell: &Cell| {
            current.iter().any(|other| {
                other.key != cell.key
                    && other.inputs == cell.inputs
                    && other.provenance.same_machine(&cell.provenance)
            })
        };
        let (retired, kept): (Vec<String>, Vec<String>) =
            self.order.drain(..).partition(|key| superseded(&self.cells[key]));
        self.order = kept;
        if !retired.is_empty() {
            let lines = self.order.iter().map(|key| line(&self.cells[key])).collect::<String>();
            output::write(&self.path, lines.as_bytes())?;
            // The old handle is that of the file that was replaced.
            self.file = open(&self.path).map_err(Failure::input)?;
        }
        Ok(retired)
    }
}

fn open(path: &Path) -> std::io::Result<File> {
    OpenOptions::new().create(true).append(true).open(path)
}

fn line(cell: &Cell) -> String {
    serde_json::to_string(cell).expect("a cell is plain data") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cell::{Inputs, Outcome};
    use crate::plan::Budget;
    use crate::provenance::Provenance;

    fn cell(seed: u64, program: &str) -> Cell {
        let provenance = Provenance { program: program.into(), ..Provenance::here(None) };
        let inputs = Inputs {
            scene: "s".into(),
            scene_content: "c".into(),
            method: "m".into(),
            parameters: BTreeMap::new(),
            budget: Budget::Count,
            seed,
            repetition: 0,
            transport: "all".into(),
            resolution: [16, 16],
            exposure: 1.0,
            references: BTreeMap::new(),
        };
        let outcome = Outcome::Declined { reason: "no".into() };
        Cell { key: inputs.key(&provenance), inputs, outcome, provenance }
    }

    #[test]
    fn cells_of_an_older_build_are_retired_and_later_ones_still_written() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let [old, other, new, last] =
            [cell(1, "old"), cell(2, "old"), cell(1, "new"), cell(3, "new")];
        let mut journal = Journal::open(folder.path()).expect("a new journal");
        for cell in [&old, &other, &new] {
            journal.append(cell).expect("writable");
        }
        let retired = journal.retire(&[&new]).expect("writable");
        assert_eq!(retired, std::slice::from_ref(&old.key));
        journal.append(&last).expect("writable");
        let journal = Journal::open(folder.path()).expect("the same journal");
        let keys = [&other, &new, &last].map(|cell| cell.key.clone());
        assert_eq!(journal.order, keys);
        assert_eq!(journal.get(&last.key), Some(&last));
        assert_eq!(journal.get(&old.key), None);
    }
}
