//! What import changed, dropped or made up, counted.

use std::collections::BTreeMap;

/// Notes in the order of their words; the same note twice adds up.
#[derive(Debug, Default)]
pub(super) struct Notes(BTreeMap<String, u64>);

impl Notes {
    /// Adds to the count of something; zero leaves no trace.
    pub(super) fn count(&mut self, what: impl Into<String>, number: u64) {
        if number > 0 {
            *self.0.entry(what.into()).or_default() += number;
        }
    }

    /// `what: number`, a line each.
    pub(super) fn into_lines(self) -> Vec<String> {
        let line =
            |(what, number): (String, u64)| format!("{}: {number}", crate::error::one_line(&what));
        self.0.into_iter().map(line).collect()
    }
}
