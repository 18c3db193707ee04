//! `cells.jsonl`: one line a finished cell, on disk before the next one starts.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::error::Failure;
use crate::measurement::cell::Cell;
use crate::output;

/// The cells of a directory of results, held against other processes.
pub(crate) struct Journal {
    path: PathBuf,
    file: File,
    cells: BTreeMap<String, Cell>,
    /// Keys in the order of the file.
    order: Vec<String>,
    /// Of the file: more than keys where cells ran again.
    lines: usize,
    /// Held until this process ends, however it ends.
    _lock: File,
}

impl Journal {
    /// Opens the journal of `directory`. Lines that are not a cell are reported, dropped from the
    /// file, and their cells run again.
    ///
    /// # Errors
    /// One line where the file cannot be read or written or another process works in the directory.
    pub(crate) fn open(directory: &Path) -> Result<Self, Failure> {
        let lock = lock(directory)?;
        let path = directory.join("cells.jsonl");
        let at = |error: std::io::Error| Failure::input(format!("{}: {error}", path.display()));
        let Contents { cells: lines, problems } = read(&path)?;
        for problem in &problems {
            eprintln!("{problem}; its cell runs again");
        }
        let (mut cells, mut order) = (BTreeMap::new(), Vec::new());
        let count = lines.len();
        let kept: String = lines.iter().map(line).collect();
        for cell in lines {
            // The later line of a key that failed and ran again counts.
            let key = cell.key.clone();
            if cells.insert(key.clone(), cell).is_none() {
                order.push(key);
            }
        }
        if !problems.is_empty() {
            output::write(&path, kept.as_bytes())?;
        }
        let file = open(&path).map_err(at)?;
        Ok(Self { path, file, cells, order, lines: count, _lock: lock })
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
        self.lines += 1;
        if self.cells.insert(cell.key.clone(), cell.clone()).is_none() {
            self.order.push(cell.key.clone());
        }
        Ok(())
    }

    /// Drops the cells that another build made of the same inputs on the same machine as `current`,
    /// and the earlier lines of cells that ran again. Gives the keys of the former.
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
        if !retired.is_empty() || self.lines > self.order.len() {
            let lines = self.order.iter().map(|key| line(&self.cells[key])).collect::<String>();
            output::write(&self.path, lines.as_bytes())?;
            self.lines = self.order.len();
            // The old handle is that of the file that was replaced.
            self.file = open(&self.path).map_err(Failure::input)?;
        }
        Ok(retired)
    }
}

/// The lines of a journal.
pub(crate) struct Contents {
    /// What could be read, in the order of the file; a key may occur twice, the later line counts.
    pub(crate) cells: Vec<Cell>,
    /// One line for each line that is not a cell.
    pub(crate) problems: Vec<String>,
}

/// Reads the cells at `path`; none where there is no file. A line is not a cell where a run was killed
/// while writing it, where it was edited, or where another version wrote it.
///
/// # Errors
/// One line where the file cannot be read.
pub(crate) fn read(path: &Path) -> Result<Contents, Failure> {
    let at = |error: std::io::Error| Failure::input(format!("{}: {error}", path.display()));
    let bytes = if path.exists() { std::fs::read(path).map_err(at)? } else { Vec::new() };
    let text = String::from_utf8_lossy(&bytes);
    let mut contents = Contents { cells: Vec::new(), problems: Vec::new() };
    let ends = text.is_empty() || text.ends_with('\n');
    let count = text.lines().count();
    for (number, line) in (1..).zip(text.lines()) {
        let place = || format!("{} line {number}", path.display());
        match serde_json::from_str::<Cell>(line) {
            // Without its line break, a line may be the start of a longer one.
            Ok(_) if number == count && !ends => {
                contents.problems.push(format!("{}: damaged, dropped", place()));
            }
            Ok(cell) if cell.key == cell.inputs.key(&cell.provenance) => contents.cells.push(cell),
            Ok(_) => {
                let reason = "foreign: its key is not that of its inputs; dropped";
                contents.problems.push(format!("{}: {reason}", place()));
            }
            Err(_) => contents.problems.push(format!("{}: damaged, dropped", place())),
        }
    }
    Ok(contents)
}

/// Two processes that append to one file, or replace it, would lose cells.
fn lock(directory: &Path) -> Result<File, Failure> {
    let path = directory.join(".lock");
    let at = |error: std::io::Error| Failure::input(format!("{}: {error}", path.display()));
    let file = OpenOptions::new().create(true).append(true).open(&path).map_err(at)?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(Failure::input(format!(
            "{}: another manylights works in this folder: wait for it or choose another --out",
            directory.display()
        ))),
        Err(TryLockError::Error(error)) => Err(at(error)),
    }
}

fn open(path: &Path) -> std::io::Result<File> {
    OpenOptions::new().create(true).append(true).open(path)
}

/// The line of a cell.
pub(crate) fn line(cell: &Cell) -> String {
    serde_json::to_string(cell).expect("a cell is plain data") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::cell::Outcome;
    use crate::measurement::inputs::Inputs;
    use crate::measurement::provenance::Provenance;
    use crate::question::plan::{Bounded, Budget};

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
            asked_visibility: None,
            resolution: [16, 16],
            exposure: 1.0,
            references: BTreeMap::new(),
            bounded: Bounded::Time,
            camera: None,
        };
        let outcome = Outcome::Declined { reason: "no".into() };
        Cell { key: inputs.key(&provenance), inputs, outcome, provenance }
    }

    #[test]
    fn foreign_and_damaged_lines_are_named_and_not_used() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let path = folder.path().join("cells.jsonl");
        let [good, other] = [cell(1, "p"), cell(2, "p")];
        let foreign = line(&Cell { key: good.key.clone(), ..other });
        let killed = line(&good);
        let text = format!("{foreign}nonsense\n{}{}", line(&good), killed.trim_end());
        std::fs::write(&path, text).expect("writable");
        let contents = read(&path).expect("readable");
        assert_eq!(contents.cells, std::slice::from_ref(&good));
        let [foreign, damaged, killed] = &contents.problems[..] else { panic!("three problems") };
        assert!(foreign.contains("line 1: foreign"), "{foreign}");
        assert!(damaged.contains("line 2: damaged"), "{damaged}");
        assert!(killed.contains("line 4: damaged"), "{killed}");
    }

    #[test]
    fn a_folder_has_one_owner_at_a_time() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let first = Journal::open(folder.path()).expect("free");
        let refused = Journal::open(folder.path()).err().expect("taken").to_string();
        assert!(refused.contains("another manylights works in this folder"), "{refused}");
        drop(first);
        assert!(Journal::open(folder.path()).is_ok());
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
        drop(journal);
        let journal = Journal::open(folder.path()).expect("the same journal");
        let keys = [&other, &new, &last].map(|cell| cell.key.clone());
        assert_eq!(journal.order, keys);
        assert_eq!(journal.get(&last.key), Some(&last));
        assert_eq!(journal.get(&old.key), None);
    }
}
