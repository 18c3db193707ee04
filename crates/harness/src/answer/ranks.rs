//! Places among rows whose differences may be chance.

use crate::answer::significance::Estimate;

/// The places that a row may have: no rule that gives each row one place can let all rows share a place whose
/// difference may be chance, since such differences add up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rank {
    /// From 1: behind all rows that are better by more than chance.
    pub(crate) best: usize,
    /// Before all rows that are worse by more than chance.
    pub(crate) worst: usize,
}

impl Rank {
    /// By how much its error exceeds that of each row it competes with, itself among them.
    pub(crate) fn among(excesses: impl Iterator<Item = Option<Estimate>>) -> Self {
        let (mut all, mut better, mut worse) = (0, 0, 0);
        for excess in excesses {
            all += 1;
            let known = excess.filter(|excess| !excess.holds_zero());
            better += usize::from(known.is_some_and(|excess| excess.value > 0.0));
            worse += usize::from(known.is_some_and(|excess| excess.value < 0.0));
        }
        Self { best: 1 + better, worst: all - worse }
    }
}

impl std::fmt::Display for Rank {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.best == self.worst {
            true => write!(f, "{}", self.best),
            false => write!(f, "{}–{}", self.best, self.worst),
        }
    }
}
