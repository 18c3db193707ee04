//! Cells condensed to one row for each variant on each scene.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use manylights_metrics::Errors;

use crate::answer::bias::{self, Split};
use crate::answer::ranks::Rank;
use crate::answer::significance::{Estimate, Sample, SeedError};
use crate::answer::statistics::{Quartiles, mean, median, quartiles};
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
    /// By name of the reference, the noise of the reference included. Over seeds: the mean of squared errors, and
    /// RMSE and PSNR of that mean; medians of the other metrics.
    pub(crate) errors: BTreeMap<String, Comparison>,
    /// The same squared errors seed by seed, by name of the reference.
    pub(crate) samples: BTreeMap<String, Sample>,
    /// By name of the reference, where there are two seeds or more.
    pub(crate) split: BTreeMap<String, Split>,
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

    /// How much larger the squared error of another row is; `None` where there is too little to tell.
    fn excess_of(&self, other: &Self, reference: &str) -> Option<Estimate> {
        let sample = |row: &'_ Self| row.medians()?.samples.get(reference).cloned();
        sample(other)?.excess_over(&sample(self)?)
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
        Self::with(experiment, scene, |cells, medians| {
            bias::of_cells(cells, &medians.samples, scene, out)
        })
    }

    /// The same with the split of the errors of a row that has pictures.
    fn with(
        experiment: &Experiment,
        scene: &SceneCells,
        split: impl Fn(&Vec<&(Turn, Cell)>, &Medians) -> Result<BTreeMap<String, Split>, Failure>,
    ) -> Result<Self, Failure> {
        let mut groups: BTreeMap<(usize, &str), Vec<&(Turn, Cell)>> = BTreeMap::new();
        for cell in &scene.cells {
            let machine = cell.1.provenance.machine.as_str();
            groups.entry((cell.0.variant, machine)).or_default().push(cell);
        }
        let row = |((variant, machine), cells): ((usize, &str), Vec<&(Turn, Cell)>)| {
            let mut result = result(&cells, experiment.variants[variant].method.is_random());
            if let RowResult::Done(medians) = &mut result {
                medians.split = split(&cells, medians)?;
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
        Self::with(experiment, scene, |_, _| Ok(BTreeMap::new())).expect("no picture is read")
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

    /// How much larger the squared error of a row is than the baseline's; `None` where there is too little to tell.
    pub(crate) fn excess(&self, row: &Row, reference: &str) -> Option<Estimate> {
        self.baseline(row)?.excess_of(row, reference)
    }

    /// Noise of a reference as (radiance, sRGB); `None` where nothing was compared with it.
    pub(crate) fn floor(&self, reference: &str) -> Option<(f64, f64)> {
        self.rows.iter().find_map(|row| {
            let comparison = row.medians()?.errors.get(reference)?;
            Some((comparison.linear_floor, comparison.display_floor))
        })
    }

    /// Ranks by RMSE of sRGB values against a reference. `None` for rows without pictures. Rows compete within their
    /// budget alone.
    pub(crate) fn ranks(&self, experiment: &Experiment, reference: &str) -> Vec<Option<Rank>> {
        let budget = |row: &Row| {
            let variant = &experiment.variants[row.variant];
            (variant.budget, variant.bounded)
        };
        let rivals: Vec<_> = self.rows.iter().filter(|row| row.medians().is_some()).collect();
        let rank = |row: &Row| {
            let same = rivals.iter().filter(|other| budget(other) == budget(row));
            row.medians().map(|_| Rank::among(same.map(|other| other.excess_of(row, reference))))
        };
        self.rows.iter().map(rank).collect()
    }
}

impl Quantity {
    /// Ours.
    pub(crate) fn value(&self, of: &Medians, baseline: Option<&Medians>) -> Option<f64> {
        match self {
            Self::Error(metric, reference) => (metric.value)(&of.errors[reference].display),
            Self::TimeRatio => Some(of.seconds.median / baseline?.seconds.median),
        }
    }
}

fn result(cells: &[&(Turn, Cell)], is_random: bool) -> RowResult {
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
    let pictures: Vec<(u64, &Done)> = firsts.map(|(turn, _, done)| (turn.seed, *done)).collect();
    let names = || first.2.errors.keys().cloned();
    let samples = names().map(|name| (name.clone(), sample(&pictures, &name, is_random)));
    let errors = names().map(|name| (name.clone(), errors_over_seeds(&pictures, &name)));
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
        samples: samples.collect(),
        split: BTreeMap::new(),
        checkpoints: checkpoints(&runs),
        counters: first.2.counters.clone(),
        key: first.1.key.clone(),
        errors: errors.collect(),
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

fn sample(pictures: &[(u64, &Done)], reference: &str, is_random: bool) -> Sample {
    let compared =
        pictures.iter().filter_map(|(seed, done)| Some((*seed, done.errors.get(reference)?)));
    let error = |(seed, comparison): (u64, &Comparison)| SeedError {
        seed,
        squared: comparison.display.mse,
        tiles: comparison.tiles.clone(),
    };
    let floor =
        pictures[0].1.errors.get(reference).map_or(0.0, |comparison| comparison.display_floor);
    Sample { seeds: compared.map(error).collect(), is_random, floor }
}

fn errors_over_seeds(pictures: &[(u64, &Done)], reference: &str) -> Comparison {
    let comparisons: Vec<&Comparison> =
        pictures.iter().filter_map(|(_, done)| done.errors.get(reference)).collect();
    let middle = |value: &dyn Fn(&Comparison) -> f64| {
        median(comparisons.iter().map(|c| value(c))).expect("every picture is compared with it")
    };
    let known = |value: &dyn Fn(&Comparison) -> Option<f64>| {
        median(comparisons.iter().map(|c| value(c)).collect::<Option<Vec<_>>>()?)
    };
    let errors = |side: fn(&Comparison) -> &Errors| {
        let mse = mean(comparisons.iter().map(|c| side(c).mse));
        // That of a seed is a constant less its own logarithm.
        let positive = comparisons.iter().map(|c| side(c)).find(|errors| errors.mse > 0.0);
        let psnr = |errors: &Errors| errors.psnr + 10.0 * (errors.mse / mse).log10();
        Errors {
            rmse: mse.sqrt(),
            mse,
            psnr: positive.map_or(f64::INFINITY, psnr),
            mae: middle(&|c| side(c).mae),
            ssim: middle(&|c| side(c).ssim),
            rel_mse: middle(&|c| side(c).rel_mse),
            smape: middle(&|c| side(c).smape),
            rel_p999: middle(&|c| side(c).rel_p999),
            rel_mse_trimmed: known(&|c| side(c).rel_mse_trimmed),
            flip: known(&|c| side(c).flip),
        }
    };
    Comparison {
        linear: errors(|c| &c.linear),
        display: errors(|c| &c.display),
        linear_floor: middle(&|c| c.linear_floor),
        display_floor: middle(&|c| c.display_floor),
        tiles: None,
    }
}
