//! `cells.jsonl`: one line a finished cell, on disk before the next one starts.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::error::Failure;
use crate::measurement::cell::Cell;
use crate::measurement::lines::{self, Line, line};
use crate::output::{self, say};

/// The cells of a directory of results, held against other processes.
pub(crate) struct Journal {
    path: PathBuf,
    file: File,
    lines: BTreeMap<String, Line>,
    /// Keys in the order of the file.
    order: Vec<String>,
    /// Of the file: more than keys where cells ran again.
    written: usize,
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
        let lines::Contents { lines: found, problems, notes } = lines::read(&path)?;
        notes.iter().for_each(say);
        for problem in &problems {
            say(format_args!("{problem}; dropped, its cell runs again"));
        }
        if !problems.is_empty() {
            let kept: String = found.iter().map(|line| line.text.as_str()).collect();
            output::write(&path, kept.as_bytes())?;
        }
        let file = open(&path).map_err(at)?;
        let (lines, order) = (BTreeMap::new(), Vec::new());
        let mut journal = Self { path, file, lines, order, written: 0, _lock: lock };
        found.into_iter().for_each(|line| journal.keep(line));
        Ok(journal)
    }

    /// The finished cell of this key.
    pub(crate) fn get(&self, key: &str) -> Option<&Cell> {
        self.lines.get(key).map(|line| &line.cell)
    }

    /// All cells, in the order in which they were first written.
    pub(crate) fn cells(&self) -> impl DoubleEndedIterator<Item = &Cell> {
        self.order.iter().map(|key| &self.lines[key].cell)
    }

    /// Adds a finished cell.
    ///
    /// # Errors
    /// One line where the file cannot be written.
    pub(crate) fn append(&mut self, cell: &Cell) -> Result<(), Failure> {
        self.append_line(Line { cell: cell.clone(), text: line(cell) })
    }

    /// As [`Self::append`], word for word.
    ///
    /// # Errors
    /// One line where the file cannot be written.
    pub(crate) fn append_line(&mut self, line: Line) -> Result<(), Failure> {
        self.file
            .write_all(line.text.as_bytes())
            .and_then(|()| self.file.sync_data())
            .map_err(|error| Failure::input(format!("cells.jsonl: {error}")))?;
        self.keep(line);
        Ok(())
    }

    /// The later line of a key that failed and ran again counts.
    fn keep(&mut self, line: Line) {
        self.written += 1;
        let key = line.cell.key.clone();
        if self.lines.insert(key.clone(), line).is_none() {
            self.order.push(key);
        }
    }

    /// Drops the cells of the machine that made `current` which answer the same for another version of a
    /// method, state of the scene or driver: no run uses them again, and a report knows one answer. Drops
    /// the earlier lines of cells that ran again, too. Gives the keys of the former.
    ///
    /// # Errors
    /// One line where the file cannot be written.
    pub(crate) fn retire(&mut self, current: &[&Cell]) -> Result<Vec<String>, Failure> {
        let superseded = |cell: &Cell| {
            current.iter().any(|other| {
                other.key != cell.key
                    && other.provenance.machine == cell.provenance.machine
                    && other.inputs.turn_identity() == cell.inputs.turn_identity()
            })
        };
        let (retired, kept): (Vec<String>, Vec<String>) =
            self.order.drain(..).partition(|key| superseded(&self.lines[key].cell));
        self.order = kept;
        if !retired.is_empty() || self.written > self.order.len() {
            let lines =
                self.order.iter().map(|key| self.lines[key].text.as_str()).collect::<String>();
            output::write(&self.path, lines.as_bytes())?;
            self.written = self.order.len();
            // The old handle is that of the file that was replaced.
            self.file = open(&self.path).map_err(Failure::input)?;
        }
        Ok(retired)
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::valid::tests::done_cell;
    use crate::measurement::versions::Versions;

    fn cell(seed: u64, version: u32) -> Cell {
        let Cell { inputs, outcome, provenance, .. } = done_cell(seed);
        Cell::new(inputs, outcome, Versions::from([("method".into(), version)]), provenance)
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
    fn cells_of_an_older_version_are_retired_and_later_ones_still_written() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let [old, other, new, last] = [cell(1, 1), cell(2, 1), cell(1, 2), cell(3, 2)];
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

    #[test]
    fn what_a_newer_program_wrote_is_kept_as_it_is() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let path = folder.path().join("cells.jsonl");
        let text = line(&cell(1, 1)).replacen('{', "{\"weather\":\"fine\",", 1);
        std::fs::write(&path, format!("{text}nonsense\n")).expect("writable");
        let mut journal = Journal::open(folder.path()).expect("a journal");
        journal.append(&cell(2, 1)).expect("writable");
        journal.append(&cell(2, 1)).expect("writable");
        journal.retire(&[]).expect("writable");
        let kept = std::fs::read_to_string(&path).expect("a journal");
        assert_eq!(kept, text + &line(&cell(2, 1)));
    }
}
