//! Cells condensed to one row for each variant on each scene.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use manylights_metrics::{Errors, METRICS};

use crate::answer::bias::{self, Bias};
use crate::answer::statistics::{Quartiles, median, paired_difference, quartiles};
use crate::error::Failure;
use crate::measurement::cell::{Cell, Checkpoint, Comparison, Done, Outcome};
use crate::measurement::inputs::ReferenceInputs;
use crate::measurement::scene_cells::SceneCells;
use crate::question::experiment::Experiment;
use crate::question::plan::Turn;
use crate::question::published::Quantity;
use crate::question::references::Reference;

/// A scene of the answer.
pub(crate) struct SceneAnswer {
    /// Its name.
    pub(crate) scene: String,
    /// One for each variant and machine, in the order of the experiment.
    pub(crate) rows: Vec<Row>,
    /// What it is compared with, by name.
    references: BTreeMap<String, ReferenceInputs>,
    /// Index of the variant that ratios refer to.
    baseline: usize,
}

/// A variant on a scene, run by one machine.
pub(crate) struct Row {
    /// Index into the experiment's variants.
    pub(crate) variant: usize,
    /// Which machine. Times of different ones are never compared.
    pub(crate) machine: String,
    /// What came out.
    pub(crate) result: RowResult,
}

/// What came out of a variant on a scene.
pub(crate) enum RowResult {
    /// Pictures.
    Done(Box<Medians>),
    /// The first reason that a cell gave.
    Declined(String),
    /// The first reason that a cell gave.
    Failed(String),
}

/// Medians over seeds and repetitions.
pub(crate) struct Medians {
    /// Of the work, over all runs.
    pub(crate) seconds: Quartiles,
    /// Timed runs.
    pub(crate) runs: usize,
    /// Of what the frames were baked from; 0 where nothing is baked.
    pub(crate) bake_seconds: f64,
    /// The same by pass, by the processor's own clock.
    pub(crate) bake_pass_seconds: BTreeMap<String, f64>,
    /// What the bake counted for the first seed.
    pub(crate) bake_counters: BTreeMap<String, u64>,
    /// Of the preparation.
    pub(crate) prepare_seconds: f64,
    /// Of each pass, by the processor's own clock.
    pub(crate) pass_seconds: BTreeMap<String, f64>,
    /// Value of the method's cost parameter, where it has one.
    pub(crate) amount: Option<f64>,
    /// What the method counted for the first seed.
    pub(crate) counters: BTreeMap<String, u64>,
    /// Key of the cell whose picture stands for the row: the first seed's.
    pub(crate) key: String,
    /// By name of the reference; medians over seeds.
    pub(crate) errors: BTreeMap<String, Comparison>,
    /// RMSE of sRGB values of each seed, by name of the reference.
    pub(crate) seed_rmse: BTreeMap<String, Vec<f64>>,
    /// By name of the reference, where there are two seeds or more.
    pub(crate) bias: BTreeMap<String, Bias>,
    /// The way to the picture: medians of time, errors of the first seed.
    pub(crate) checkpoints: Vec<Checkpoint>,
}

impl Row {
    /// The medians, where there are pictures.
    pub(crate) fn medians(&self) -> Option<&Medians> {
        match &self.result {
            RowResult::Done(medians) => Some(medians),
            _ => None,
        }
    }
}

impl SceneAnswer {
    /// Condenses the cells of a scene and its pictures, which are in `out`.
    ///
    /// # Errors
    /// One line where a picture cannot be read.
    pub(crate) fn new(
        experiment: &Experiment,
        scene: &SceneCells,
        out: &Path,
    ) -> Result<Self, Failure> {
        Self::with(experiment, scene, |cells| bias::of_cells(cells, scene, out))
    }

    /// The same with what `bias` says of the cells of a row that has pictures.
    fn with(
        experiment: &Experiment,
        scene: &SceneCells,
        bias: impl Fn(&[&(Turn, Cell)]) -> Result<BTreeMap<String, Bias>, Failure>,
    ) -> Result<Self, Failure> {
        let mut groups: BTreeMap<(usize, &str), Vec<&(Turn, Cell)>> = BTreeMap::new();
        for cell in &scene.cells {
            let machine = cell.1.provenance.machine.as_str();
            groups.entry((cell.0.variant, machine)).or_default().push(cell);
        }
        let row = |((variant, machine), cells): ((usize, &str), Vec<&(Turn, Cell)>)| {
            let mut result = result(&cells);
            if let RowResult::Done(medians) = &mut result {
                medians.bias = bias(&cells)?;
            }
            Ok::<_, Failure>(Row { variant, machine: machine.to_owned(), result })
        };
        let rows = groups.into_iter().map(row).collect::<Result<_, _>>()?;
        let references = scene.cells.first().map(|(_, cell)| cell.inputs.references.clone());
        Ok(Self {
            scene: scene.scene.clone(),
            rows,
            references: references.unwrap_or_default(),
            baseline: experiment.baseline,
        })
    }

    /// Of cells without their pictures, which are not committed: nothing of bias is known.
    #[cfg(test)]
    pub(crate) fn of_cells(experiment: &Experiment, scene: &SceneCells) -> Self {
        Self::with(experiment, scene, |_| Ok(BTreeMap::new())).expect("no picture is read")
    }

    /// A reference for headings: who made it, and how.
    pub(crate) fn description(&self, experiment: &Experiment, reference: &Reference) -> String {
        let samples = match self.references.get(&reference.name) {
            Some(ReferenceInputs::Samples(samples)) => *samples,
            _ => experiment.scale.reference_samples,
        };
        reference.description(experiment.transport, samples)
    }

    /// The row of the baseline that the same machine ran.
    pub(crate) fn baseline(&self, row: &Row) -> Option<&Row> {
        let same = |other: &&Row| other.variant == self.baseline && other.machine == row.machine;
        self.rows.iter().find(same)
    }

    /// Whether the RMSE of a row differs from the baseline's by more than chance, seed by seed;
    /// `None` where there are too few seeds to tell, and where no seed differs at all.
    pub(crate) fn differs(&self, row: &Row, reference: &str) -> Option<bool> {
        let seeds = |row: &Row| row.medians()?.seed_rmse.get(reference).cloned();
        let pairs: Vec<_> = seeds(row)?.into_iter().zip(seeds(self.baseline(row)?)?).collect();
        if pairs.iter().all(|(row, baseline)| row == baseline) {
            return None;
        }
        paired_difference(&pairs).map(|(mean, half)| mean.abs() > half)
    }

    /// Noise of a reference as (radiance, sRGB); `None` where nothing was compared with it.
    pub(crate) fn floor(&self, reference: &str) -> Option<(f64, f64)> {
        self.rows.iter().find_map(|row| {
            let comparison = row.medians()?.errors.get(reference)?;
            Some((comparison.linear_floor, comparison.display_floor))
        })
    }

    /// Ranks by RMSE of sRGB values against a reference, best first. Rows that are closer to the
    /// best of their rank than the noise of the reference share it. `None` for rows without pictures.
    pub(crate) fn ranks(&self, reference: &str) -> Vec<Option<Rank>> {
        let floor = self.floor(reference).map_or(0.0, |(_, display)| display);
        let error = |row: &Row| Some(row.medians()?.errors.get(reference)?.display.rmse);
        let mut order: Vec<(usize, f64)> =
            self.rows.iter().enumerate().filter_map(|(i, row)| Some((i, error(row)?))).collect();
        order.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut ranks = vec![None; self.rows.len()];
        let mut start = 0;
        while start < order.len() {
            let same = order[start..].iter().take_while(|(_, e)| e - order[start].1 <= floor);
            let end = start + same.count();
            for &(index, _) in &order[start..end] {
                ranks[index] = Some(Rank { place: start + 1, shared: end - start > 1 });
            }
            start = end;
        }
        ranks
    }
}

impl Quantity {
    /// Ours.
    pub(crate) fn value(&self, of: &Medians, baseline: Option<&Medians>) -> Option<f64> {
        match self {
            Self::Error(metric, reference) => Some((metric.value)(&of.errors[reference].display)),
            Self::TimeRatio => Some(of.seconds.median / baseline?.seconds.median),
        }
    }
}

/// A place among the rows of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rank {
    /// From 1.
    pub(crate) place: usize,
    /// Others are closer than the noise of the reference.
    pub(crate) shared: bool,
}

fn result(cells: &[&(Turn, Cell)]) -> RowResult {
    let mut done = Vec::new();
    let mut declined = None;
    for (turn, cell) in cells {
        match &cell.outcome {
            Outcome::Done(cell_done) => done.push((turn, cell, cell_done.as_ref())),
            Outcome::Declined { reason } => declined = Some(reason.clone()),
            // One failure fails the row: a median of the rest would hide it.
            Outcome::Failed { reason } => return RowResult::Failed(reason.clone()),
        }
    }
    let seconds = quartiles(done.iter().map(|(_, _, done)| done.step_seconds));
    let (Some(seconds), Some(first)) = (seconds, done.first()) else {
        return RowResult::Declined(declined.unwrap_or_else(|| "no run".to_owned()));
    };
    // Repetitions of a seed have the same picture: they are not independent errors.
    let mut seeds = BTreeSet::new();
    let firsts = done.iter().filter(|(turn, ..)| seeds.insert(turn.seed));
    let pictures: Vec<&Done> = firsts.map(|(.., done)| *done).collect();
    let rmse = |reference: &String| {
        let seeds =
            pictures.iter().filter_map(|done| Some(done.errors.get(reference)?.display.rmse));
        (reference.clone(), seeds.collect())
    };
    let runs: Vec<&Done> = done.iter().map(|(.., done)| *done).collect();
    let middle = |seconds: fn(&Done) -> f64| {
        median(runs.iter().map(|done| seconds(done))).expect("there is a first")
    };
    RowResult::Done(Box::new(Medians {
        seconds,
        runs: runs.len(),
        bake_seconds: middle(|done| done.bake_seconds),
        bake_pass_seconds: pass_medians(&runs, |done| &done.bake_pass_seconds),
        bake_counters: first.2.bake_counters.clone(),
        prepare_seconds: middle(|done| done.prepare_seconds),
        pass_seconds: pass_medians(&runs, |done| &done.pass_seconds),
        amount: first.2.amount,
        seed_rmse: first.2.errors.keys().map(rmse).collect(),
        bias: BTreeMap::new(),
        checkpoints: checkpoints(&runs),
        counters: first.2.counters.clone(),
        key: first.1.key.clone(),
        errors: first.2.errors.keys().map(|r| (r.clone(), median_errors(&pictures, r))).collect(),
    }))
}

/// The median time of each pass of the first run over all runs.
fn pass_medians(
    runs: &[&Done],
    seconds: fn(&Done) -> &BTreeMap<String, f64>,
) -> BTreeMap<String, f64> {
    let passes = seconds(runs[0]).keys().filter_map(|pass| {
        let times = runs.iter().filter_map(|done| seconds(done).get(pass).copied());
        Some((pass.clone(), median(times)?))
    });
    passes.collect()
}

/// The first run's, at the median times of all runs.
fn checkpoints(runs: &[&Done]) -> Vec<Checkpoint> {
    let at = |(index, checkpoint): (usize, &Checkpoint)| {
        let times = runs.iter().filter_map(|done| Some(done.checkpoints.get(index)?.step_seconds));
        Some(Checkpoint { step_seconds: median(times)?, ..checkpoint.clone() })
    };
    runs[0].checkpoints.iter().enumerate().filter_map(at).collect()
}

fn median_errors(pictures: &[&Done], reference: &str) -> Comparison {
    let comparisons: Vec<Comparison> =
        pictures.iter().filter_map(|done| done.errors.get(reference).copied()).collect();
    let of = |value: &dyn Fn(&Comparison) -> f64| {
        median(comparisons.iter().map(value)).expect("every picture is compared with it")
    };
    let errors = |side: &dyn Fn(&Comparison) -> Errors| Errors {
        rmse: of(&|c| side(c).rmse),
        mse: of(&|c| side(c).mse),
        mae: of(&|c| side(c).mae),
        psnr: of(&|c| side(c).psnr),
        ssim: of(&|c| side(c).ssim),
        rel_mse: of(&|c| side(c).rel_mse),
        smape: of(&|c| side(c).smape),
        rel_p999: of(&|c| side(c).rel_p999),
    };
    Comparison {
        linear: errors(&|c| c.linear),
        display: errors(&|c| c.display),
        linear_floor: of(&|c| c.linear_floor),
        display_floor: of(&|c| c.display_floor),
    }
}

/// The value of each metric, for files that hold them all.
pub(crate) fn values(errors: &Errors) -> impl Iterator<Item = (&'static str, f64)> {
    METRICS.iter().map(move |metric| (metric.id, (metric.value)(errors)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: f64 = 0.01;

    fn errors(rmse: f64) -> Errors {
        let [mae, psnr, ssim, rel_mse, smape, rel_p999] = [0.0; 6];
        Errors { rmse, mse: rmse * rmse, mae, psnr, ssim, rel_mse, smape, rel_p999 }
    }

    fn row_of(variant: usize, result: RowResult) -> Row {
        Row { variant, machine: "m".into(), result }
    }

    fn row(variant: usize, rmse: f64) -> Row {
        let comparison = Comparison {
            linear: errors(rmse),
            display: errors(rmse),
            linear_floor: 0.0,
            display_floor: FLOOR,
        };
        let seconds = Quartiles { lower: 1.0, median: 1.0, upper: 1.0 };
        let errors = BTreeMap::from([("traced".to_owned(), comparison)]);
        let counters = BTreeMap::new();
        let medians = Medians {
            seconds,
            runs: 1,
            bake_seconds: 0.0,
            bake_pass_seconds: BTreeMap::new(),
            bake_counters: BTreeMap::new(),
            prepare_seconds: 0.0,
            pass_seconds: BTreeMap::new(),
            amount: Some(1.0),
            counters,
            key: String::new(),
            errors,
            seed_rmse: BTreeMap::from([("traced".to_owned(), vec![rmse, rmse + 0.001 * rmse])]),
            bias: BTreeMap::new(),
            checkpoints: Vec::new(),
        };
        row_of(variant, RowResult::Done(Box::new(medians)))
    }

    #[test]
    fn rows_closer_than_the_floor_share_a_rank() {
        let declined = row_of(3, RowResult::Declined("no".into()));
        let rows = vec![row(0, 0.5), row(1, 0.105), row(2, 0.1), declined, row(4, 0.2)];
        let references = BTreeMap::new();
        let answer = SceneAnswer { scene: "s".into(), rows, references, baseline: 0 };
        let ranks = answer.ranks("traced");
        let rank = |place, shared| Some(Rank { place, shared });
        assert_eq!(ranks, [rank(4, false), rank(1, true), rank(1, true), None, rank(3, false)]);
    }
}
