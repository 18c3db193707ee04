//! Methods over all scenes: how their errors and times stand to the baseline's.

use std::collections::BTreeMap;

use crate::answer::rows::{Medians, Row, SceneAnswer};
use crate::answer::series::{self, Reached, Series};
use crate::answer::significance::Estimate;
use crate::answer::statistics::{mean, variance};
use crate::question::experiment::Experiment;

/// A variant, run by one machine, over the scenes where it and the baseline have pictures.
pub(crate) struct Standing {
    /// Index into the experiment's variants.
    pub(crate) variant: usize,
    pub(crate) machine: String,
    /// By scene: of the RMSE, its noise subtracted, to the baseline's, where that is not zero.
    errors: BTreeMap<String, f64>,
    /// Geometric mean of the ratios.
    pub(crate) error: Option<Ratio>,
    /// Scenes on which it is better by more than chance, and worse.
    pub(crate) wins: [usize; 2],
    /// Of times.
    pub(crate) time: Option<Ratio>,
    /// Of relative squared error times time: what is left of a squared error that falls as the inverse of the time.
    pub(crate) cost: Option<Ratio>,
    /// Of the time in which its curve reaches the baseline's error to the baseline's time, over scenes where it does.
    pub(crate) time_to_error: Option<Ratio>,
}

/// A geometric mean of ratios.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ratio {
    pub(crate) value: f64,
    /// 95 % interval over scenes; none of fewer than [`FEWEST`].
    pub(crate) interval: Option<[f64; 2]>,
    pub(crate) scenes: usize,
}

impl Ratio {
    /// Of positive numbers.
    pub(crate) fn new(ratios: impl Iterator<Item = f64>) -> Option<Self> {
        let logarithms: Vec<f64> = ratios.map(f64::ln).filter(|value| value.is_finite()).collect();
        if logarithms.is_empty() {
            return None;
        }
        let value = mean(logarithms.iter().copied()).exp();
        let interval = over_scenes(&logarithms)
            .map(|Estimate { value, half }| [value - half, value + half].map(f64::exp));
        Some(Self { value, interval, scenes: logarithms.len() })
    }
}

/// Scenes from which something is said of others: of two, Student's interval spans orders of magnitude.
const FEWEST: usize = 3;

/// The mean with Student's interval.
fn over_scenes(values: &[f64]) -> Option<Estimate> {
    let count = values.len() as f64;
    let value = mean(values.iter().copied());
    let estimate = || Estimate::new(value, &[(variance(values) / count, values.len() - 1)]);
    (values.len() >= FEWEST).then(estimate)
}

impl Standing {
    /// All variants with a row, in the experiment's order.
    pub(crate) fn all(
        experiment: &Experiment,
        scenes: &[SceneAnswer],
        reference: &str,
    ) -> Vec<Self> {
        let curves = series::of_experiment(experiment, scenes);
        let mut rows: BTreeMap<(usize, &str), Vec<(&SceneAnswer, &Row)>> = BTreeMap::new();
        for scene in scenes {
            for row in &scene.rows {
                rows.entry((row.variant, &row.machine)).or_default().push((scene, row));
            }
        }
        let standing = |((variant, machine), rows): ((usize, &str), Vec<_>)| {
            Self::new((variant, machine), &rows, &curves, reference)
        };
        rows.into_iter().map(standing).collect()
    }

    fn new(
        (variant, machine): (usize, &str),
        rows: &[(&SceneAnswer, &Row)],
        curves: &[Series],
        reference: &str,
    ) -> Self {
        let pairs = || {
            rows.iter().filter_map(|(scene, row)| {
                Some((*scene, *row, row.medians()?, scene.baseline(row)?.medians()?))
            })
        };
        let ratio = |of: &dyn Fn(&Medians) -> f64| {
            Ratio::new(pairs().map(|(_, _, own, base)| of(own) / of(base)))
        };
        let rmse = |medians: &Medians| medians.samples[reference].mean_squared().sqrt();
        let relative =
            |medians: &Medians| medians.errors[reference].linear.rel_mse * medians.seconds.median;
        let told = pairs().filter_map(|(scene, row, ..)| {
            scene.excess(row, reference).filter(|excess| !excess.holds_zero())
        });
        let told: Vec<_> = told.collect();
        let count = |is: fn(&Estimate) -> bool| told.iter().filter(|excess| is(excess)).count();
        let curve = curves.iter().find(|curve| curve.has(variant, machine));
        let reached = pairs().filter_map(|(scene, _, _, base)| {
            let points = curve.filter(|curve| curve.is_a_line())?.points(scene, reference);
            match series::time_to_reach(&points, rmse(base)) {
                Reached::At(seconds) => Some(seconds / base.seconds.median),
                Reached::Before(_) | Reached::Never => None,
            }
        });
        let errors =
            pairs().map(|(scene, _, own, base)| (scene.scene.clone(), rmse(own) / rmse(base)));
        Self {
            variant,
            machine: machine.to_owned(),
            errors: errors.filter(|(_, ratio)| ratio.is_finite() && *ratio > 0.0).collect(),
            error: ratio(&rmse),
            wins: [count(|excess| excess.value < 0.0), count(|excess| excess.value > 0.0)],
            time: ratio(&|medians| medians.seconds.median),
            cost: ratio(&relative),
            time_to_error: Ratio::new(reached),
        }
    }

    /// Whether its errors cannot be told from another's over the scenes that both have, by the same interval; never of
    /// so few scenes that there is none.
    pub(crate) fn may_equal(&self, other: &Self) -> bool {
        let ratio = |(scene, own): (&String, &f64)| Some((own / other.errors.get(scene)?).ln());
        let ratios: Vec<f64> = self.errors.iter().filter_map(ratio).collect();
        over_scenes(&ratios).is_some_and(|estimate| estimate.holds_zero())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_have_the_interval_of_their_logarithms() {
        // scipy.stats.t.interval(0.95, 2, *stats of log([0.5, 0.8, 0.9])), exp of both ends.
        let Ratio { value, interval, scenes } =
            Ratio::new([0.5, 0.8, 0.9].into_iter()).expect("three");
        let [lower, upper] = interval.expect("of three");
        assert!((value - 0.711_379).abs() < 1e-5 && scenes == 3, "{value}");
        assert!(
            (lower - 0.328_55).abs() < 1e-4 && (upper - 1.540_3).abs() < 1e-3,
            "{lower} {upper}"
        );
        let one = Ratio::new([0.5].into_iter()).expect("one");
        assert_eq!((one.interval, one.scenes), (None, 1));
        assert_eq!(Ratio::new([0.0].into_iter()), None);
    }
}
