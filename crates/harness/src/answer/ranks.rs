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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_share_the_places_that_chance_may_give_them() {
        // A, B and C differ by 1 each; what is off by 1 may be chance, by 2 not.
        let errors = [0.0, 1.0, 2.0];
        let ranks = errors.map(|own| {
            let excess = errors.map(|other| Some(Estimate { value: own - other, half: 1.5 }));
            Rank::among(excess.into_iter())
        });
        assert_eq!(ranks.map(|rank| rank.to_string()), ["1–2", "1–3", "2–3"]);
        // Where nothing is known of chance, any place is possible.
        assert_eq!(Rank::among([None, None].into_iter()), Rank { best: 1, worst: 2 });
    }
}
