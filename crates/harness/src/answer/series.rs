//! Curves: the variants of an experiment that differ in one parameter alone, and what was measured
//! along them.

use std::collections::{BTreeMap, BTreeSet};

use manylights_method::Cost;
use plotters::style::RGBColor;

use crate::answer::error_column::ErrorColumn;
use crate::answer::rows::{Medians, Row, SceneAnswer};
use crate::answer::significance::Estimate;
use crate::measurement::cell::Checkpoint;
use crate::question::experiment::Experiment;
use crate::show::style::{Marker, method_style};

/// A curve.
pub(crate) struct Series {
    /// For legends: method and the parameters that all its variants share.
    pub(crate) name: String,
    /// Where its method stands in the registry.
    place: usize,
    /// Which of the curves of its method.
    pub(crate) nth: usize,
    /// Which machine's; a curve never joins the times of two.
    machine: String,
    /// Indices into the experiment's variants.
    variants: Vec<usize>,
    /// The cost, where its points differ in the amount of work, so that checkpoints lie on it.
    along: Option<Cost>,
    /// What the method counts of its work: lights asked for are not all lit.
    counter: Option<&'static str>,
}

/// A measurement on a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    /// What was counted of the method's cost parameter, or else its value, where it has one.
    pub(crate) amount: Option<f64>,
    /// Median time of the work, with its quartiles.
    pub(crate) seconds: [f64; 3],
    /// RMSE of sRGB values over all seeds without the noise of the reference, with its 95 % interval; or another
    /// error alone.
    pub(crate) error: [f64; 3],
}

/// The curves of an experiment, in the order of its variants, for each machine that ran cells.
pub(crate) fn of_experiment(experiment: &Experiment, scenes: &[SceneAnswer]) -> Vec<Series> {
    let rows = || scenes.iter().flat_map(|scene| &scene.rows);
    let machines: BTreeSet<&str> = rows().map(|row| row.machine.as_str()).collect();
    let mut list: Vec<Series> = Vec::new();
    let mut curves_of = BTreeMap::new();
    for &machine in &machines {
        for (index, variant) in experiment.variants.iter().enumerate() {
            if !rows().any(|row| row.variant == index && row.machine == machine) {
                continue;
            }
            let several = if machines.len() > 1 { format!(" @{machine}") } else { String::new() };
            let name = variant.series() + &several;
            if let Some(series) = list.iter_mut().find(|series| series.name == name) {
                series.variants.push(index);
                continue;
            }
            let method = variant.method.id();
            let nth = curves_of.entry(method).or_insert(0);
            let counter = variant.method.cost().map(|cost| cost.parameter);
            let along = variant.method.cost().filter(|cost| Some(cost.parameter) == variant.swept);
            let machine = machine.to_owned();
            list.push(Series {
                name,
                place: variant.place,
                nth: *nth,
                machine,
                variants: vec![index],
                along,
                counter,
            });
            *nth += 1;
        }
    }
    list
}

impl Series {
    /// Colour and marker, those of the method.
    pub(crate) fn style(&self) -> (RGBColor, Marker) {
        method_style(self.place)
    }

    /// Whether a variant that a machine ran lies on it.
    pub(crate) fn has(&self, variant: usize, machine: &str) -> bool {
        self.machine == machine && self.variants.contains(&variant)
    }

    /// Whether there is something between its points.
    pub(crate) fn is_a_line(&self) -> bool {
        self.variants.len() > 1
    }

    /// What was measured on a scene against a reference: in the order of the amount of work where
    /// that is what changes along the curve, else in that of the sweep.
    pub(crate) fn points(&self, scene: &SceneAnswer, reference: &str) -> Vec<Point> {
        let runs = self.runs(scene);
        let mut points: Vec<Point> =
            runs.iter().filter_map(|medians| self.point(medians, reference)).collect();
        if let Some(cost) = self.along {
            let known: Vec<Option<f64>> = points.iter().map(|point| point.amount).collect();
            let mut between = checkpoints(&runs, cost, reference);
            between.retain(|point| !known.contains(&point.amount));
            points.extend(between);
        }
        self.in_order(points)
    }

    /// The same with another error: of whole pictures alone, as the median over seeds, the noise of the
    /// reference included.
    pub(crate) fn points_by(
        &self,
        scene: &SceneAnswer,
        reference: &str,
        column: ErrorColumn,
    ) -> Vec<Point> {
        let point = |medians: &&Medians| {
            let error = column.of(medians.errors.get(reference)?)?;
            Some(Point { error: [error; 3], ..self.point(medians, reference)? })
        };
        self.in_order(self.runs(scene).iter().filter_map(point).collect())
    }

    fn in_order(&self, mut points: Vec<Point>) -> Vec<Point> {
        if let Some(cost) = self.along {
            points.sort_by(|a, b| work(cost, a.amount).total_cmp(&work(cost, b.amount)));
        }
        points
    }

    fn point(&self, medians: &Medians, reference: &str) -> Option<Point> {
        let sample = medians.samples.get(reference)?;
        let rmse = sample.mean_squared().sqrt();
        let [lower, upper] = sample.interval().unwrap_or([rmse; 2]);
        let seconds = medians.seconds;
        let counted = self.counter.and_then(|counter| medians.counters.get(counter));
        Some(Point {
            amount: counted.map(|&count| count as f64).or(medians.amount),
            seconds: [seconds.median, seconds.lower, seconds.upper],
            error: [rmse, lower, upper],
        })
    }

    /// The bias that more work leaves: that of the most work, where it is more than chance.
    pub(crate) fn plateau(&self, scene: &SceneAnswer, reference: &str) -> Option<f64> {
        let most = |a: &&&Medians, b: &&&Medians| {
            let work =
                |medians: &Medians| self.along.map_or(0.0, |cost| work(cost, medians.amount));
            work(a).total_cmp(&work(b))
        };
        let runs = self.runs(scene);
        let Estimate { value, half } = runs.iter().max_by(most)?.split.get(reference)?.squared_bias;
        (self.along.is_some() && value > half).then(|| value.sqrt())
    }

    /// What its variants measured on a scene, in their order.
    fn runs<'s>(&self, scene: &'s SceneAnswer) -> Vec<&'s Medians> {
        let run = |&variant: &usize| {
            let same = |row: &&Row| row.variant == variant && row.machine == self.machine;
            scene.rows.iter().find(same)?.medians()
        };
        self.variants.iter().filter_map(run).collect()
    }
}

/// As [`Cost::work`]; of a file that keeps an amount back, none.
fn work(cost: Cost, amount: Option<f64>) -> f64 {
    amount.map_or(0.0, |amount| cost.work(amount))
}

/// The way of the longest run.
fn checkpoints(runs: &[&Medians], cost: Cost, reference: &str) -> Vec<Point> {
    let work = |medians: &Medians| work(cost, medians.amount);
    let longest = runs.iter().max_by(|a, b| work(a).total_cmp(&work(b)));
    let Some(longest) = longest else { return Vec::new() };
    let point = |checkpoint: &Checkpoint| {
        let floor = longest.samples.get(reference)?.floor;
        let squared = checkpoint.display_rmse.get(reference)?.powi(2) - floor.powi(2);
        let rmse = squared.max(0.0).sqrt();
        let seconds = [checkpoint.step_seconds; 3];
        Some(Point { amount: Some(checkpoint.amount), seconds, error: [rmse; 3] })
    };
    longest.checkpoints.iter().filter_map(point).collect()
}

/// When a curve reaches an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Reached {
    /// After so many seconds, between its points on a log-log scale.
    At(f64),
    /// Before its first point, or before one without any error, which took so many seconds.
    Before(f64),
    /// Not within its points.
    Never,
}

/// When a curve first falls to an error.
pub(crate) fn time_to_reach(points: &[Point], error: f64) -> Reached {
    let Some(reached) = points.iter().position(|point| point.error[0] <= error) else {
        return Reached::Never;
    };
    let end = points[reached];
    let Some(start) = reached.checked_sub(1).map(|before| points[before]) else {
        return Reached::Before(end.seconds[0]);
    };
    if end.error[0] == 0.0 {
        // No logarithm leads there.
        return Reached::Before(end.seconds[0]);
    }
    let share = (start.error[0] / error).ln() / (start.error[0] / end.error[0]).ln();
    Reached::At(start.seconds[0] * (end.seconds[0] / start.seconds[0]).powf(share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_read_off_exactly() {
        // RMSE = t^(−1/2).
        let at = |t: f64| Point { amount: Some(1.0), seconds: [t; 3], error: [t.powf(-0.5); 3] };
        let points = [at(1.0), at(4.0), at(100.0)];
        let Reached::At(seconds) = time_to_reach(&points, 0.2) else { panic!("reached") };
        assert!((seconds - 25.0).abs() < 1e-9, "{seconds}");
        assert_eq!(time_to_reach(&points, 2.0), Reached::Before(1.0));
        assert_eq!(time_to_reach(&points, 0.05), Reached::Never);
        assert_eq!(time_to_reach(&[], 0.05), Reached::Never);
        let perfect = Point { amount: Some(1.0), seconds: [9.0; 3], error: [0.0; 3] };
        assert_eq!(time_to_reach(&[at(1.0), perfect], 0.05), Reached::Before(9.0));
    }
}
