//! `table.md`, `table.tex` and `table.csv`.

mod across;
mod csv;
mod latex;
mod markdown;

use std::collections::BTreeSet;

use crate::answer::rows::{Medians, Row, RowResult, SceneAnswer};
use crate::answer::series::{self, Reached};
use crate::answer::significance::{Estimate, Sample};
use crate::answer::statistics::Quartiles;
use crate::measurement::equal_time::miss;
use crate::measurement::provenance::Provenance;
use crate::measurement::time_budget::TOLERANCE;
use crate::question::columns::Column;
use crate::question::experiment::Experiment;
use crate::question::plan::{Budget, Variant};
use crate::question::references::Reference;
use crate::show::numbers::{self, milliseconds, short};

pub(crate) use across::{across_scenes, verdicts};
pub(crate) use csv::csv;
pub(crate) use latex::latex;
pub(crate) use markdown::markdown;

/// A table of plain texts.
pub(crate) struct Table {
    /// What it holds.
    pub(crate) caption: String,
    /// Title of each column and whether it holds numbers.
    pub(crate) heading: Vec<(&'static str, bool)>,
    /// Lines of as many cells, or fewer where the rest is empty.
    pub(crate) lines: Vec<Vec<String>>,
}

/// What the experiment asked and what it was answered with.
pub(crate) fn head(experiment: &Experiment, machine: &Provenance) -> [String; 2] {
    let scale = &experiment.scale;
    let [width, height] = scale.resolution;
    let adapter = machine.adapter.as_ref().map_or_else(String::new, |adapter| {
        let field = |name: &str| adapter[name].as_str().unwrap_or_default().to_owned();
        format!("; adapter {} ({} {})", field("name"), field("driver"), field("driver_info"))
    });
    [
        format!(
            "Profile {}: {width}×{height} pixels, transport {}, {} timed runs for each of {} seed(s).",
            experiment.profile,
            experiment.transport,
            scale.repetitions,
            scale.seeds.len(),
        ),
        format!(
            "{}; {}, {} threads, {}{adapter}.",
            machine.program_name(),
            machine.cpu,
            machine.threads,
            machine.system,
        ),
    ]
}

/// The tables of a scene: one for each reference, then the times to reach an error.
pub(crate) fn of_scene(experiment: &Experiment, scene: &SceneAnswer) -> Vec<Table> {
    let references = experiment.references.iter();
    let mut tables: Vec<Table> =
        references.map(|reference| against(experiment, scene, reference)).collect();
    tables.extend(time_to_error(experiment, scene));
    tables
}

fn against(experiment: &Experiment, scene: &SceneAnswer, reference: &Reference) -> Table {
    let Reference { name, .. } = reference;
    let columns = shown(experiment, scene);
    let mut heading = vec![("rank", true), ("method", false)];
    heading.extend(
        columns
            .iter()
            .map(|column| (column.title(), !matches!(column, Column::Counts | Column::Passes))),
    );
    let ranks = scene.ranks(experiment, name);
    let lines = scene.rows.iter().zip(ranks).map(|(row, rank)| {
        let several = scene.rows.iter().any(|other| other.machine != row.machine);
        let machine = if several { format!(" @{}", row.machine) } else { String::new() };
        let label = experiment.variants[row.variant].label() + &machine;
        match &row.result {
            RowResult::Done(medians) => {
                let at = Place { experiment, scene, row, reference: name };
                let mut line = vec![rank.map_or_else(String::new, |rank| rank.to_string()), label];
                line.extend(columns.iter().map(|column| at.cell(*column, medians)));
                line
            }
            RowResult::Declined(reason) => {
                vec![String::new(), label, format!("declined: {reason}")]
            }
            RowResult::Failed(reason) => vec![String::new(), label, format!("FAILED: {reason}")],
        }
    });
    let floor = scene.floor(name).map(|(linear, display)| {
        let known = |floor: f64| match reference.is_path_traced() {
            true => short(floor),
            false => "—".to_owned(),
        };
        let mut line = vec![String::new(), "noise floor of the reference".to_owned()];
        line.extend(columns.iter().map(|column| match column {
            Column::Rmse => known(display),
            Column::RmseLinear => known(linear),
            _ => String::new(),
        }));
        line
    });
    Table {
        caption: format!("Against {name}: {}", scene.description(experiment, reference)),
        heading,
        lines: lines.chain(floor).collect(),
    }
}

/// The columns asked for, without the split of errors where there are too few seeds for it. A bake is
/// shown where there is one, and only there: no time is told without it.
fn shown(experiment: &Experiment, scene: &SceneAnswer) -> Vec<Column> {
    let any = |of: fn(&Medians) -> bool| scene.rows.iter().filter_map(Row::medians).any(of);
    let (split, baked) = (any(|row| !row.split.is_empty()), any(|row| row.bake_seconds > 0.0));
    let known = |row: &Medians| row.samples.values().any(|sample| sample.interval().is_some());
    let mut columns = experiment.columns.clone();
    if baked && !columns.contains(&Column::Bake) {
        let time = columns.iter().position(|&column| column == Column::Time);
        columns.insert(time.map_or(columns.len(), |time| time + 1), Column::Bake);
    }
    if !columns.contains(&Column::Interval) {
        let error = columns.iter().position(|&column| column == Column::Rmse);
        columns.splice(
            error.map_or(0..0, |error| error + 1..error + 1),
            error.map(|_| Column::Interval),
        );
    }
    columns.retain(|column| match column {
        Column::Interval => any(known),
        Column::Bias | Column::Deviation => split,
        Column::Bake => baked,
        _ => true,
    });
    columns
}

/// A row of a table.
struct Place<'t> {
    experiment: &'t Experiment,
    scene: &'t SceneAnswer,
    row: &'t Row,
    reference: &'t str,
}

impl Place<'_> {
    fn cell(&self, column: Column, medians: &Medians) -> String {
        let errors = &medians.errors[self.reference];
        let base = self.scene.baseline(self.row).and_then(Row::medians);
        let ratio = |of: &dyn Fn(&Medians) -> f64| {
            base.map_or_else(String::new, |base| numbers::ratio(of(medians), of(base)))
        };
        let sample = &medians.samples[self.reference];
        let split = medians.split.get(self.reference);
        match column {
            Column::Counts => counts(medians),
            Column::Time => milliseconds(medians.seconds.median) + self.overrun(medians),
            Column::Quartiles => quartiles(medians.seconds),
            Column::Bake => milliseconds(medians.bake_seconds),
            Column::TimeRatio => ratio(&|row| row.seconds.median),
            Column::Rmse => short(sample.mean_squared().sqrt()),
            Column::Interval => sample.interval().map_or_else(String::new, interval),
            Column::RmseRatio => {
                ratio(&|row| row.samples[self.reference].mean_squared().sqrt())
                    + &self.ratio_interval(sample)
                    + self.insignificance()
            }
            Column::Bias => split.map_or_else(String::new, |split| part(split.squared_bias)),
            Column::Deviation => split.map_or_else(String::new, |split| part(split.variance)),
            Column::Psnr => format!("{:.2}", errors.display.psnr),
            Column::Ssim => format!("{:.4}", errors.display.ssim),
            Column::RmseLinear => {
                short((errors.linear.mse - errors.linear_floor.powi(2)).max(0.0).sqrt())
            }
            Column::Mae => short(errors.display.mae),
            Column::Flip => errors.display.flip.map_or_else(String::new, short),
            Column::RelMse => short(errors.linear.rel_mse),
            Column::RelMseTrimmed => errors.linear.rel_mse_trimmed.map_or_else(String::new, short),
            Column::Spikes => short(errors.linear.rel_p999),
            Column::Passes => passes(medians),
        }
    }

    /// Marks a time that misses its budget.
    fn overrun(&self, medians: &Medians) -> &'static str {
        let Variant { budget, bounded, .. } = self.experiment.variants[self.row.variant];
        let seconds =
            |medians: &Medians| bounded.seconds(medians.seconds.median, medians.bake_seconds);
        let budget = match budget {
            Budget::Count => return "",
            Budget::Seconds(seconds) => Some(seconds),
            Budget::Baseline => {
                let baseline = self.scene.baseline(self.row).and_then(Row::medians);
                baseline.map(seconds)
            }
        };
        let off = budget.map(|budget| miss(seconds(medians), budget));
        if off.is_some_and(|off| off > TOLERANCE) { "!" } else { "" }
    }

    /// Of the ratio to the baseline, where it is known.
    fn ratio_interval(&self, sample: &Sample) -> String {
        let base = self.scene.baseline(self.row).filter(|base| !std::ptr::eq(*base, self.row));
        let base = base.and_then(Row::medians).map(|base| &base.samples[self.reference]);
        let ends = base.and_then(|base| sample.ratio_to(base));
        ends.map_or_else(String::new, |ends| format!(" ({})", interval(ends)))
    }

    /// Marks a difference to the baseline that may be chance.
    fn insignificance(&self) -> &'static str {
        let is_baseline = self.row.variant == self.experiment.baseline;
        let excess = self.scene.excess(self.row, self.reference);
        // Of equal pictures nothing is chance.
        let may_be_chance = excess.is_none_or(|excess| excess.holds_zero() && !excess.is_zero());
        if !is_baseline && may_be_chance { " ≈" } else { "" }
    }
}

fn passes(medians: &Medians) -> String {
    let passes = medians.pass_seconds.iter();
    let passes = passes.map(|(name, &seconds)| format!("{name} {}", milliseconds(seconds)));
    passes.collect::<Vec<_>>().join(", ")
}

fn counts(medians: &Medians) -> String {
    let counts = medians.counters.iter().map(|(name, n)| format!("{n} {name}"));
    counts.collect::<Vec<_>>().join(", ")
}

fn interval([lower, upper]: [f64; 2]) -> String {
    format!("{}–{}", short(lower), short(upper))
}

/// A part of an error with its interval, where there are seeds enough for it.
fn part(squared: Estimate) -> String {
    let [root, lower, upper] = squared.roots();
    match squared.half.is_finite() {
        true => format!("{} ({})", short(root), interval([lower, upper])),
        false => short(root),
    }
}

fn quartiles(seconds: Quartiles) -> String {
    format!("{}–{}", milliseconds(seconds.lower), milliseconds(seconds.upper))
}

/// Milliseconds that each curve takes to each error, against each reference; `None` where the
/// experiment names no error.
pub(crate) fn time_to_error(experiment: &Experiment, scene: &SceneAnswer) -> Option<Table> {
    if experiment.errors.is_empty() {
        return None;
    }
    let mut lines = Vec::new();
    for reference in experiment.references.iter().map(|reference| &reference.name) {
        for curve in series::of_experiment(experiment, std::slice::from_ref(scene)) {
            let points = curve.points(scene, reference);
            for &error in &experiment.errors {
                let time = match series::time_to_reach(&points, error) {
                    Reached::At(seconds) => milliseconds(seconds),
                    Reached::Before(seconds) => format!("≤ {}", milliseconds(seconds)),
                    Reached::Never => "not reached".to_owned(),
                };
                lines.push(vec![curve.name.clone(), reference.clone(), short(error), time]);
            }
        }
    }
    Some(Table {
        caption: "Time to reach an error, between the points of the curves".to_owned(),
        heading: vec![("method", false), ("reference", false), ("RMSE", true), ("time ms", true)],
        lines,
    })
}

/// Ours beside the numbers of papers; `None` where the experiment names none.
pub(crate) fn published(experiment: &Experiment, scenes: &[SceneAnswer]) -> Option<Table> {
    if experiment.published.is_empty() {
        return None;
    }
    let line = |published: &crate::question::published::Published| {
        let scene = scenes.iter().find(|scene| scene.scene == published.scene);
        let same = |row: &&Row| row.variant == published.variant;
        let row = scene.and_then(|scene| Some((scene, scene.rows.iter().find(same)?)));
        let ours = row.and_then(|(scene, row)| {
            let baseline = scene.baseline(row).and_then(Row::medians);
            published.quantity.value(row.medians()?, baseline)
        });
        let [metric, reference] = published.quantity.names();
        vec![
            published.source.clone(),
            published.scene.clone(),
            experiment.variants[published.variant].label(),
            reference,
            metric,
            short(published.value),
            ours.map_or_else(|| "none".to_owned(), short),
            ours.map_or_else(String::new, |ours| numbers::ratio(ours, published.value)),
        ]
    };
    Some(Table {
        caption: "Beside the published values".to_owned(),
        heading: vec![
            ("source", false),
            ("scene", false),
            ("method", false),
            ("reference", false),
            ("metric", false),
            ("theirs", true),
            ("ours", true),
            ("÷", true),
        ],
        lines: experiment.published.iter().map(line).collect(),
    })
}

/// What the numbers mean.
pub(crate) fn foot(experiment: &Experiment) -> String {
    let mut text = format!(
        "Time: wall clock of the work (median and quartiles), on the adapter warmed up, without preparation, \
         read-back, metrics and files. Base: `{}`. RMSE, PSNR and SSIM are of sRGB values at the \
         scene's exposure, RMSE linear of radiance in W·m⁻²·sr⁻¹. The RMSE is \
         of all seeds together, the noise of the reference subtracted (as squares; not so in PSNR, SSIM and \
         `table.csv`, which has all metrics), with its 95 % interval. Ranks are by RMSE within a budget, each from \
         one behind the rows that are better by more than chance to those before the rows that are worse: 2–4 may \
         be any of these.",
        experiment.variants[experiment.baseline].label()
    );
    if experiment.columns.iter().any(|column| {
        matches!(column, Column::Mae | Column::Flip | Column::RelMse | Column::RelMseTrimmed)
    }) {
        text.push_str(
            " MAE and FLIP (Andersson et al. 2020) are of sRGB values, relMSE of radiance, trimmed without the \
             largest 0.1 % of its terms: medians over seeds, the noise of the reference included.",
        );
    }
    if experiment.transport != experiment.transport.estimated() {
        text.push_str(" Direct light is exact and the same in all pictures; no time includes it.");
    }
    if experiment.variants.iter().any(|variant| variant.method.baking().is_some()) {
        text.push_str(
            " Bake: wall clock of what further frames reuse, made once for a scene and for each camera, \
             seed or amount of work that it depends on; no part of the time.",
        );
    }
    if experiment.scale.seeds.len() > 1 {
        text.push_str(
            " RMSE² = bias² + deviation² over seeds; intervals of both, and of the ratio of an RMSE to the base's, by the jackknife.",
        );
    }
    if experiment.columns.contains(&Column::RmseRatio) {
        text.push_str(
            " ≈: the difference to the base may be chance, by the same rule as ranks: 95 % interval of the paired \
             difference of squared errors over seeds (over tiles of the picture where a method with chance has one \
             seed) and over the noise of the reference.",
        );
    }
    if experiment.variants.iter().any(|variant| variant.budget != Budget::Count) {
        text.push_str(
            " !: the time misses its budget by more than 5 %, since the method's work comes in steps \
             or the machine's pace changed between search and run.",
        );
        let methods = experiment.variants.iter().map(|variant| variant.method);
        let ids: BTreeSet<_> =
            methods.filter(|method| method.cost().is_none()).map(|method| method.id()).collect();
        if !ids.is_empty() {
            let ids: Vec<_> = ids.into_iter().collect();
            text += &format!(
                " No amount of work sets the time of {}: it is what it is.",
                ids.join(", ")
            );
        }
    }
    text
}
