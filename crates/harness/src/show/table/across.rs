//! The first table of an answer: methods over all scenes, and a sentence made from it.

use super::{Table, interval};
use crate::answer::across::{Ratio, Standing};
use crate::answer::rows::SceneAnswer;
use crate::question::experiment::Experiment;
use crate::question::plan::Budget;
use crate::show::numbers::{milliseconds, short};

/// One for each reference.
pub(crate) fn across_scenes(experiment: &Experiment, scenes: &[SceneAnswer]) -> Vec<Table> {
    let heading = vec![
        ("method", false),
        ("RMSE ÷ base", true),
        ("95 %", true),
        ("better – worse", true),
        ("time ÷ base", true),
        ("error² × time ÷ base", true),
        ("time to base's RMSE ÷ base", true),
    ];
    let table = |reference: &str| {
        let line = |standing: &Standing| {
            let value =
                |ratio: Option<Ratio>| ratio.map_or_else(String::new, |ratio| short(ratio.value));
            let [better, worse] = standing.wins;
            vec![
                label(experiment, standing, scenes),
                value(standing.error),
                standing.error.and_then(|error| error.interval).map_or_else(String::new, interval),
                format!("{better} – {worse}"),
                value(standing.time),
                value(standing.cost),
                standing
                    .time_to_error
                    .map_or_else(String::new, |ratio| reached(ratio, scenes.len())),
            ]
        };
        let standings = Standing::all(experiment, scenes, reference);
        Table {
            caption: format!("All {} scene(s), against {reference}", scenes.len()),
            heading: heading.clone(),
            lines: standings.iter().map(line).collect(),
        }
    };
    experiment.references.iter().map(|reference| table(&reference.name)).collect()
}

/// Of a variant, and whose where several machines ran it.
fn label(experiment: &Experiment, standing: &Standing, scenes: &[SceneAnswer]) -> String {
    let mut machines = scenes.iter().flat_map(|scene| &scene.rows).map(|row| &row.machine);
    let several = machines.any(|machine| *machine != standing.machine);
    let machine = if several { format!(" @{}", standing.machine) } else { String::new() };
    experiment.variants[standing.variant].label() + &machine
}

/// Names the scenes where a curve gets there, unless it does on all.
fn reached(ratio: Ratio, scenes: usize) -> String {
    match ratio.scenes == scenes {
        true => short(ratio.value),
        false => format!("{} (on {})", short(ratio.value), ratio.scenes),
    }
}

/// What the tables say, a sentence for each reference and budget: who has the least error where times are alike,
/// else who has the least squared error times time.
pub(crate) fn verdicts(experiment: &Experiment, scenes: &[SceneAnswer]) -> Vec<String> {
    let of_reference = |reference: &str| {
        let standings = Standing::all(experiment, scenes, reference);
        let mut budgets: Vec<Budget> = Vec::new();
        for standing in &standings {
            let budget = experiment.variants[standing.variant].budget;
            if !budgets.contains(&budget) {
                budgets.push(budget);
            }
        }
        let sentence = |budget: &Budget| {
            let rivals = standings
                .iter()
                .filter(|standing| experiment.variants[standing.variant].budget == *budget);
            sentence(experiment, scenes, (reference, *budget), &rivals.collect::<Vec<_>>())
        };
        budgets.iter().filter_map(sentence).collect::<Vec<_>>()
    };
    experiment.references.iter().flat_map(|reference| of_reference(&reference.name)).collect()
}

fn sentence(
    experiment: &Experiment,
    scenes: &[SceneAnswer],
    (reference, budget): (&str, Budget),
    rivals: &[&Standing],
) -> Option<String> {
    let name = |standing: &Standing| format!("`{}`", label(experiment, standing, scenes));
    let base = experiment.variants[experiment.baseline].label();
    if rivals.len() < 2 {
        return None;
    }
    let all = format!("over {} scene(s) against {reference}", scenes.len());
    let least = |of: fn(&Standing) -> Option<Ratio>| {
        let known = rivals.iter().filter_map(|rival| Some((*rival, of(rival)?)));
        known.min_by(|a, b| a.1.value.total_cmp(&b.1.value))
    };
    let within = match budget {
        Budget::Count => {
            let (best, cost) = least(|rival| rival.cost)?;
            return Some(format!(
                "Of what was run {all}, {} has the least relative squared error times time: {} of that of `{base}`.",
                name(best),
                short(cost.value),
            ));
        }
        Budget::Seconds(seconds) => format!("In {} ms", milliseconds(seconds)),
        Budget::Baseline => "In the base's time".to_owned(),
    };
    let (best, error) = least(|rival| rival.error)?;
    let range = error.interval.map_or_else(String::new, |ends| format!(" ({})", interval(ends)));
    let [better, worse] = best.wins;
    let equals =
        rivals.iter().filter(|rival| !std::ptr::eq(**rival, best) && rival.may_equal(best));
    let equals: Vec<_> = equals.map(|rival| name(rival)).collect();
    let rest = match equals.is_empty() {
        true => String::new(),
        false => format!(" Over the scenes it cannot be told from {}.", equals.join(", ")),
    };
    Some(format!(
        "{within} {all}, {} has the least error: {}{range} times the RMSE of `{base}`, better on {better} and worse \
         on {worse} of the scenes.{rest}",
        name(best),
        short(error.value),
    ))
}
