//! `cells.jsonl`: one line a finished cell, on disk before the next one starts.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::Path;

use crate::cell::Cell;
use crate::error::Failure;
use crate::output;

/// The cells of a directory of results.
pub(crate) struct Journal {
    file: File,
    cells: BTreeMap<String, Cell>,
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
        let mut kept = String::new();
        for (number, line) in (1..).zip(text.lines()) {
            match serde_json::from_str::<Cell>(line) {
                Ok(cell) => {
                    kept.push_str(line);
                    kept.push('\n');
                    cells.insert(cell.key.clone(), cell);
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
        let file = OpenOptions::new().create(true).append(true).open(&path).map_err(at)?;
        Ok(Self { file, cells })
    }

    /// The finished cell of this key.
    pub(crate) fn get(&self, key: &str) -> Option<&Cell> {
        self.cells.get(key)
    }

    /// Adds a finished cell.
    ///
    /// # Errors
    /// One line where the file cannot be written.
    pub(crate) fn append(&mut self, cell: &Cell) -> Result<(), Failure> {
        let mut line = serde_json::to_string(cell).expect("a cell is plain data");
        line.push('\n');
        self.file
            .write_all(line.as_bytes())
            .and_then(|()| self.file.sync_data())
            .map_err(|error| Failure::input(format!("cells.jsonl: {error}")))?;
        self.cells.insert(cell.key.clone(), cell.clone());
        Ok(())
    }
}
