//! What time and accuracy of a method depend on.

use crate::parameters::{ParameterInfo, ParameterKind};

/// In which direction of a cost parameter the work grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Larger values are more work: a number of lights or samples.
    Up,
    /// Smaller values are more work: an accuracy, the error that is allowed.
    Down,
}

/// The parameter, a [`ParameterKind::Count`] or [`ParameterKind::Real`] of positive values, that time
/// and accuracy grow with. Where a budget names a time, its value is searched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost {
    /// Its name.
    pub parameter: &'static str,
    /// Where there is more work.
    pub grows: Direction,
}

impl Cost {
    /// What the work of an amount, a value of the parameter, is about proportional to: a count itself;
    /// of an accuracy its inverse square, for records that hold as far as the error allows number as
    /// the inverse of the area that each covers (Ward et al. 1988).
    pub fn work(self, amount: f64) -> f64 {
        match self.grows {
            Direction::Up => amount,
            Direction::Down => amount.powi(-2),
        }
    }
}

/// The amounts of work that a method allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amounts {
    cost: Cost,
    min: f64,
    max: f64,
    whole: bool,
}

impl Amounts {
    /// Those of a cost among these parameters; `None` where it is none of them, is no number or need not be
    /// positive.
    pub fn new(cost: Cost, infos: &[ParameterInfo]) -> Option<Self> {
        let (min, max, whole) = match infos.iter().find(|info| info.name == cost.parameter)?.kind {
            ParameterKind::Count { min, max, .. } => (min as f64, max as f64, true),
            ParameterKind::Real { min, max, .. } => (min, max, false),
            ParameterKind::Choice { .. } => return None,
        };
        (min > 0.0).then_some(Self { cost, min, max, whole })
    }

    /// The cost parameter.
    pub fn parameter(self) -> &'static str {
        self.cost.parameter
    }

    /// As [`Cost::work`].
    pub fn work(self, amount: f64) -> f64 {
        self.cost.work(amount)
    }

    /// The allowed amount that is nearest to so much [work](Self::work), a positive number.
    pub fn nearest(self, work: f64) -> f64 {
        let amount = match self.cost.grows {
            Direction::Up => work,
            Direction::Down => work.powf(-0.5),
        };
        let amount = if self.whole { amount.round() } else { amount };
        amount.clamp(self.min, self.max)
    }

    /// Whether an amount is one of them.
    pub fn contains(self, amount: f64) -> bool {
        (self.min..=self.max).contains(&amount) && (amount.fract() == 0.0 || !self.whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn amounts(kind: ParameterKind, grows: Direction) -> Option<Amounts> {
        let info = ParameterInfo { name: "n", formerly: None, introduced: None, help: "", kind };
        Amounts::new(Cost { parameter: "n", grows }, &[info])
    }

    #[test]
    fn counts_are_whole_and_grow_with_the_work() {
        let kind = ParameterKind::Count { default: 4, min: 2, max: 1 << 53 };
        let counts = amounts(kind, Direction::Up).expect("positive");
        let most = (1_u64 << 53) as f64;
        assert_eq!([0.1, 2.4, 2.6, 1e300].map(|work| counts.nearest(work)), [2.0, 2.0, 3.0, most]);
        assert!(counts.contains(2.0) && counts.contains(most));
        assert!([1.0, 2.5, -3.0, f64::NAN, 1e300].iter().all(|&amount| !counts.contains(amount)));
    }

    #[test]
    fn an_accuracy_shrinks_as_the_work_grows() {
        let kind = ParameterKind::Real { default: 0.1, min: 0.01, max: 1.0 };
        let errors = amounts(kind, Direction::Down).expect("positive");
        assert!(errors.work(0.1) > errors.work(0.2));
        assert_eq!([0.5, 4.0, 1e9].map(|work| errors.nearest(work)), [1.0, 0.5, 0.01]);
        assert!((errors.nearest(errors.work(0.3)) - 0.3).abs() < 1e-15);
        assert!(errors.contains(0.3) && !errors.contains(0.0));
    }

    #[test]
    fn what_cannot_be_a_cost_has_no_amounts() {
        let from_zero = ParameterKind::Real { default: 0.1, min: 0.0, max: 1.0 };
        assert_eq!(amounts(from_zero, Direction::Down), None);
        assert_eq!(
            amounts(ParameterKind::Choice { default: "a", words: &[] }, Direction::Up),
            None
        );
        assert_eq!(Amounts::new(Cost { parameter: "n", grows: Direction::Up }, &[]), None);
    }
}
