//! Time budgets: how much work each variant may do on a scene.

use manylights_method::{Amounts, Error};
use manylights_scene::Scene;

use crate::answer::statistics::median;
use crate::error::Failure;
use crate::measurement::cell::{Cell, Outcome};
use crate::measurement::equal_time::{self, distance, miss};
use crate::measurement::inputs::{Inputs, Seen};
use crate::measurement::provenance::Provenance;
use crate::measurement::scene_run::SceneRun;
use crate::measurement::session::Session;
use crate::question::plan::{Bounded, Budget, Turn, Variant};

/// A median time this far from its budget, relatively, is corrected once more and marked in tables.
pub(crate) const TOLERANCE: f64 = 0.05;
/// Corrections of one scene at most: the machine's own noise may exceed [`TOLERANCE`].
const CORRECTIONS: usize = 5;
/// Runs that a time is the median of, once it is near its target.
const RUNS: usize = 3;

impl Session<'_> {
    /// Of each variant, the amount of work that a time budget repeats, where there is one to repeat.
    pub(crate) fn replayed_amounts(&self, scene: &Scene, camera: Option<&str>) -> Vec<Option<f64>> {
        let amount = |variant: &Variant| {
            let seen = Seen { scene: &scene.name, camera, content: "", exposure: scene.exposure };
            let asked = Inputs::new(self.experiment, variant, seen);
            let alike = |cell: &&Cell| {
                cell.inputs.view() == asked.view() && cell.inputs.label() == asked.label()
            };
            let mut cells = self.replayed.iter().filter(alike);
            let amounts = variant.amounts()?;
            cells.find_map(|cell| repeatable(cell, amounts))
        };
        self.experiment.variants.iter().map(amount).collect()
    }
}

impl SceneRun<'_, '_> {
    /// Takes the amount of a variant from the last finished cell that differs in seed and repetition
    /// alone, so that a run that goes on does the same work.
    pub(crate) fn recall_amount(
        &mut self,
        variant: usize,
        inputs: &Inputs,
        provenance: &Provenance,
    ) {
        let allowed = self.session.experiment.variants[variant].amounts();
        let Some(allowed) = allowed.filter(|_| self.amounts[variant].is_none()) else { return };
        let alike = |cell: &&Cell| {
            let Inputs { seed, repetition, .. } = cell.inputs;
            cell.provenance.same_machine(provenance)
                && Inputs { seed, repetition, ..inputs.clone() }.identity()
                    == cell.inputs.identity()
        };
        let mut cells = self.session.journal.cells().rev().filter(alike);
        self.amounts[variant] = cells.find_map(|cell| repeatable(cell, allowed));
    }

    /// Searches the amount of a variant with a time budget that has none yet. Where a try or the
    /// baseline that sets the time is declined or fails, so are the variant's cells.
    pub(crate) fn find_amount(&mut self, turn: Turn) {
        let variant = &self.session.experiment.variants[turn.variant];
        let amounts = variant.amounts().filter(|_| self.amounts[turn.variant].is_none());
        let Some(amounts) = amounts else { return };
        let found = self.search(turn, amounts);
        if variant.bounded != Bounded::Time {
            // The nearest of the search's tries is no fair measurement of its bake.
            self.session.bakes.forget(turn.variant);
        }
        match found {
            Ok(amount) => self.amounts[turn.variant] = Some(amount),
            Err(error) => {
                self.refused.insert(turn.variant, Outcome::refused(error));
            }
        }
    }

    fn search(&mut self, turn: Turn, amounts: Amounts) -> Result<f64, Error> {
        let experiment = self.session.experiment;
        let variant = &experiment.variants[turn.variant];
        let bounded = variant.bounded;
        let target = match variant.budget {
            Budget::Count => unreachable!("a count is not searched for"),
            Budget::Seconds(seconds) => seconds,
            Budget::Baseline => {
                let told = |reason| format!("the baseline, which sets the time: {reason}");
                let baseline = Turn { variant: experiment.baseline, ..turn };
                self.seconds(baseline, None, bounded).map_err(|error| match error {
                    Error::Declined(reason) => Error::Declined(told(reason)),
                    Error::Failed(reason) => Error::Failed(told(reason)),
                })?
            }
        };
        if target <= 0.0 {
            return Err(Error::Declined("the baseline, which sets the time, bakes nothing".into()));
        }
        let start = variant.parameters.real(amounts.parameter());
        let measured = |amount| self.time(turn, amount, bounded, target);
        equal_time::search(target, amounts, start, measured)
    }

    /// One run where the time is far from `target`, the median of some where it is near.
    fn time(
        &mut self,
        turn: Turn,
        amount: f64,
        bounded: Bounded,
        target: f64,
    ) -> Result<f64, Error> {
        let first = self.once(turn, Some(amount), bounded)?;
        if distance(first, target) > 0.5 {
            return Ok(first);
        }
        self.seconds(turn, Some(amount), bounded)
    }

    fn seconds(&mut self, turn: Turn, amount: Option<f64>, bounded: Bounded) -> Result<f64, Error> {
        let runs = (0..RUNS).map(|_| self.once(turn, amount, bounded));
        let seconds: Vec<f64> = runs.collect::<Result<_, Error>>()?;
        Ok(median(seconds).expect("there are some"))
    }

    /// The time that a budget bounds, of a run with a bake of its own where it counts.
    fn once(&mut self, turn: Turn, amount: Option<f64>, bounded: Bounded) -> Result<f64, Error> {
        let bake = match bounded {
            Bounded::Time => 0.0,
            Bounded::BuildTime | Bounded::TotalTime => self.measure_bake(turn, amount)?.seconds,
        };
        let frame = match bounded {
            Bounded::BuildTime => 0.0,
            Bounded::Time | Bounded::TotalTime => {
                self.measure(turn, amount, &mut |_, _, _| Ok(()))?.step_seconds
            }
        };
        Ok(bounded.seconds(frame, bake))
    }

    /// Runs those variants again, with another amount, whose median time missed its budget: what was
    /// searched in one minute may not hold in the next.
    ///
    /// # Errors
    /// Those of [`Self::turns`].
    pub(crate) fn correct_times(&mut self, cells: &mut [(Turn, Cell)]) -> Result<(), Failure> {
        // A finished run repeats nothing, and where amounts are repeated times decide nothing.
        let searched = self.ran && self.session.replayed.is_empty();
        let corrections = if searched { CORRECTIONS } else { 0 };
        for _ in 0..corrections {
            let variants = 0..self.amounts.len();
            let missed: Vec<_> = variants
                .filter_map(|variant| Some((variant, self.missed(variant, cells)?)))
                .collect();
            if missed.is_empty() {
                break;
            }
            for &(variant, amount) in &missed {
                self.amounts[variant] = Some(amount);
            }
            let again = |turn: &Turn| missed.iter().any(|&(variant, _)| variant == turn.variant);
            let turns: Vec<Turn> = cells.iter().map(|(turn, _)| *turn).filter(again).collect();
            let mut fresh = self.turns(&turns)?.into_iter();
            for slot in cells.iter_mut().filter(|(turn, _)| again(turn)) {
                *slot = fresh.next().expect("one cell for each turn");
            }
        }
        Ok(())
    }

    /// A better amount for a variant whose median time missed its budget, where there is one.
    fn missed(&self, variant: usize, cells: &[(Turn, Cell)]) -> Option<f64> {
        let Variant { budget, bounded, .. } = self.session.experiment.variants[variant];
        let target = match budget {
            Budget::Count => return None,
            Budget::Seconds(seconds) => seconds,
            Budget::Baseline => median_seconds(self.session.experiment.baseline, bounded, cells)?,
        };
        let seconds = median_seconds(variant, bounded, cells)?;
        let amount = self.amounts[variant]?;
        let amounts = self.session.experiment.variants[variant].amounts()?;
        let better = amounts.nearest(amounts.work(amount) * target / seconds);
        (miss(seconds, target) > TOLERANCE && better != amount).then_some(better)
    }
}

/// The amount of work of a finished cell, where it is one of those that a time budget may choose.
fn repeatable(cell: &Cell, allowed: Amounts) -> Option<f64> {
    match &cell.outcome {
        Outcome::Done(done) => done.amount.filter(|&amount| allowed.contains(amount)),
        _ => None,
    }
}

fn median_seconds(variant: usize, bounded: Bounded, cells: &[(Turn, Cell)]) -> Option<f64> {
    median(cells.iter().filter(|(turn, _)| turn.variant == variant).filter_map(|(_, cell)| {
        match &cell.outcome {
            Outcome::Done(done) => Some(bounded.seconds(done.step_seconds, done.bake_seconds)),
            _ => None,
        }
    }))
}
