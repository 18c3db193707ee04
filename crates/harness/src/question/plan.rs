//! What an experiment runs, and in which order.

use std::collections::BTreeMap;

use manylights_method::{Amounts, Method, Parameters};
use manylights_scene::{Transport, Visibility};
use serde::{Deserialize, Serialize};

use crate::question::recorded_value::RecordedValue;
use crate::show::numbers::milliseconds;

/// What a run may cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Budget {
    /// The work that the parameters say.
    Count,
    /// Seconds. The value of the method's cost parameter is searched for.
    Seconds(f64),
    /// The seconds that the experiment's baseline takes on the same scene.
    Baseline,
}

/// Which time a budget bounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Bounded {
    /// That of one frame, without what it was baked from.
    #[default]
    Time,
    /// That of the bake.
    BuildTime,
    /// That of both.
    TotalTime,
}

impl Bounded {
    /// As experiment files name it.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::BuildTime => "build_time",
            Self::TotalTime => "total_time",
        }
    }

    /// Whether it is that of one frame.
    pub(crate) fn is_time(&self) -> bool {
        *self == Self::Time
    }

    /// The seconds that it bounds, of a frame and of its bake.
    pub(crate) fn seconds(self, frame: f64, bake: f64) -> f64 {
        match self {
            Self::Time => frame,
            Self::BuildTime => bake,
            Self::TotalTime => frame + bake,
        }
    }
}

/// A method with all its parameters set.
#[derive(Clone)]
pub(crate) struct Variant {
    /// From the registry.
    pub(crate) method: &'static dyn Method,
    /// Where it stands in the registry.
    pub(crate) place: usize,
    /// All of its parameters. Of one with a time budget, the cost parameter is where the search
    /// starts.
    pub(crate) parameters: Parameters,
    /// The parameter along which a curve runs: the first one declared that the experiment sweeps,
    /// else the cost parameter, if there is one.
    pub(crate) swept: Option<&'static str>,
    /// Of the last segment.
    pub(crate) visibility: Visibility,
    /// What it may cost.
    pub(crate) budget: Budget,
    /// Which of its times that is.
    pub(crate) bounded: Bounded,
}

impl Variant {
    /// Method and the parameters that differ from their defaults or are swept; the budget.
    pub(crate) fn label(&self) -> String {
        let bounded = self.bounded.word();
        let budget = match self.budget {
            Budget::Count => return self.text(|_| true),
            Budget::Seconds(seconds) => format!(" {bounded}={} ms", milliseconds(seconds)),
            Budget::Baseline => format!(" {bounded}=baseline"),
        };
        self.text(|name| !self.is_searched(name)) + &budget
    }

    /// As the label, without the swept parameter: variants that share it form one curve.
    pub(crate) fn series(&self) -> String {
        self.text(|name| Some(name) != self.swept && !self.is_searched(name))
    }

    /// Among what a time budget searches the value of the cost parameter; `None` where the parameters say
    /// all.
    pub(crate) fn amounts(&self) -> Option<Amounts> {
        let cost = self.method.cost().filter(|_| self.budget != Budget::Count)?;
        let amounts = Amounts::new(cost, self.method.parameters());
        Some(amounts.expect("a test of the registry holds costs to be positive numbers"))
    }

    /// Whether the value of a parameter is found by the harness.
    pub(crate) fn is_searched(&self, name: &str) -> bool {
        self.amounts().is_some_and(|amounts| amounts.parameter() == name)
    }

    /// Values of the parameters that decide a picture: without one that the harness finds, and without those
    /// that are as before there was such a parameter, so that results from then are still found.
    pub(crate) fn given(&self) -> BTreeMap<String, RecordedValue> {
        let infos = self.method.parameters();
        let is_as_before = |name: &str, value| {
            infos.iter().any(|info| info.name == name && info.is_as_before(value))
        };
        let given = self
            .parameters
            .iter()
            .filter(|&(name, value)| !self.is_searched(name) && !is_as_before(name, value));
        given.map(|(name, value)| (name.to_owned(), value.into())).collect()
    }

    /// The visibility, where it is not the method's own.
    pub(crate) fn unusual_visibility(&self) -> Option<Visibility> {
        Some(self.visibility).filter(|&visibility| visibility != self.method.visibility())
    }

    /// Refuses a visibility where the transport leaves no choice.
    ///
    /// # Errors
    /// One line.
    pub(crate) fn check_visibility(&self, transport: Transport) -> Result<(), String> {
        if transport.visibility().is_none() && self.unusual_visibility().is_some() {
            return Err(format!("`{}`: {}", self.label(), no_choice(transport)));
        }
        Ok(())
    }

    fn text(&self, wanted: impl Fn(&str) -> bool) -> String {
        let default = Parameters::new(self.method.parameters(), []).expect("nothing to refuse");
        let mut words = vec![self.method.id().to_owned()];
        for ((name, value), (_, usual)) in self.parameters.iter().zip(default.iter()) {
            if wanted(name) && (value != usual || Some(name) == self.swept) {
                words.push(format!("{name}={value}"));
            }
        }
        words.extend(self.unusual_visibility().map(|chosen| format!("visibility={chosen}")));
        words.join(" ")
    }
}

/// Why visibility cannot be chosen.
pub(crate) fn no_choice(transport: Transport) -> String {
    format!(
        "visibility is a choice of direct, indirect-1 and direct+indirect-1, not of {transport}"
    )
}

impl PartialEq for Variant {
    fn eq(&self, other: &Self) -> bool {
        self.method.id() == other.method.id()
            && self.parameters == other.parameters
            && self.visibility == other.visibility
            && self.budget == other.budget
            && self.bounded == other.bounded
    }
}

impl std::fmt::Debug for Variant {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.label())
    }
}

/// One timed run of a variant on a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Turn {
    /// Index into the experiment's variants.
    pub(crate) variant: usize,
    /// Same seed, same picture.
    pub(crate) seed: u64,
    /// Which of the timed runs.
    pub(crate) repetition: u32,
}

/// The runs of one scene. Variants take turns, so that a slow minute of the machine hits them all.
pub(crate) fn interleaved(variants: &[usize], seeds: &[u64], repetitions: u32) -> Vec<Turn> {
    let mut turns = Vec::new();
    for repetition in 0..repetitions {
        for &seed in seeds {
            let turn = |&variant: &usize| Turn { variant, seed, repetition };
            turns.extend(variants.iter().map(turn));
        }
    }
    turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variants_take_turns() {
        let turns = interleaved(&[0, 1], &[7], 2);
        let order: Vec<_> = turns.iter().map(|turn| (turn.repetition, turn.variant)).collect();
        assert_eq!(order, [(0, 0), (0, 1), (1, 0), (1, 1)]);
    }
}
