use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::answer::error_column::ErrorColumn;
use crate::answer::ranks::Rank;
use crate::answer::rows::{Row, RowResult, SceneAnswer};
use crate::answer::significance::Estimate;
use crate::question::experiment::Experiment;
use crate::question::plan::{Budget, Variant};

/// Columns before those of the metrics.
const COLUMNS: usize = 30;

/// The table for programs: one line for each scene, variant and reference.
pub(crate) fn csv(experiment: &Experiment, scenes: &[SceneAnswer]) -> String {
    let mut text = String::from(
        "scene,method,parameters,time_budget,bounded,machine,reference,outcome,rank_best,rank_worst,amount,runs,seconds,\
         seconds_lower,seconds_upper,pass_seconds,bake_seconds,bake_pass_seconds,prepare_seconds,linear_floor,display_floor,display_error,\
         display_error_lower,display_error_upper,display_bias,display_bias_lower,display_bias_upper,display_deviation,\
         display_deviation_lower,display_deviation_upper",
    );
    for column in ErrorColumn::all() {
        let _ = write!(text, ",{column}");
    }
    text.push('\n');
    for scene in scenes {
        for reference in experiment.references.iter().map(|reference| &reference.name) {
            for (row, rank) in scene.rows.iter().zip(scene.ranks(experiment, reference)) {
                text.push_str(&csv_line(experiment, &scene.scene, row, rank, reference));
                text.push('\n');
            }
        }
    }
    text
}

fn csv_line(
    experiment: &Experiment,
    scene: &str,
    row: &Row,
    rank: Option<Rank>,
    reference: &str,
) -> String {
    let variant = &experiment.variants[row.variant];
    let mut fields = vec![
        quoted(scene),
        variant.method.id().to_owned(),
        quoted(&parameters(variant)),
        budget(variant.budget),
        bounded(variant).to_owned(),
        quoted(&row.machine),
        reference.to_owned(),
    ];
    match &row.result {
        RowResult::Done(medians) => {
            let comparison = &medians.errors[reference];
            let rank = rank.expect("rows with pictures are ranked");
            fields.extend(["done".into(), rank.best.to_string(), rank.worst.to_string()]);
            let amount = medians.amount.map_or_else(String::new, |amount| amount.to_string());
            fields.extend([amount, medians.runs.to_string()]);
            let seconds = medians.seconds;
            let sample = &medians.samples[reference];
            let split = medians.split.get(reference);
            let times = [seconds.median, seconds.lower, seconds.upper];
            fields.extend(times.map(|number| number.to_string()));
            fields.push(quoted(&passes(&medians.pass_seconds)));
            fields.push(medians.bake_seconds.to_string());
            fields.push(quoted(&passes(&medians.bake_pass_seconds)));
            let numbers =
                [medians.prepare_seconds, comparison.linear_floor, comparison.display_floor];
            fields.extend(numbers.map(|number| number.to_string()));
            fields.push(sample.mean_squared().sqrt().to_string());
            let ends = sample.interval().map(|ends| ends.map(|end| end.to_string()));
            fields.extend(ends.unwrap_or_default());
            fields.extend(roots(split.map(|split| split.squared_bias)));
            fields.extend(roots(split.map(|split| split.variance)));
            fields.extend(ErrorColumn::all().map(|column| {
                column.of(comparison).map_or_else(String::new, |value| value.to_string())
            }));
        }
        RowResult::Declined(reason) => fields.push(quoted(&format!("declined: {reason}"))),
        RowResult::Failed(reason) => fields.push(quoted(&format!("failed: {reason}"))),
    }
    fields.resize(COLUMNS + ErrorColumn::all().count(), String::new());
    fields.join(",")
}

/// The root of a square and both ends of its interval, where they are known.
fn roots(squared: Option<Estimate>) -> [String; 3] {
    squared.map_or_else(Default::default, |squared| match squared.half.is_finite() {
        true => squared.roots().map(|root| root.to_string()),
        false => [squared.roots()[0].to_string(), String::new(), String::new()],
    })
}

/// As `name=seconds`, separated by spaces of which names have none.
fn passes(seconds: &BTreeMap<String, f64>) -> String {
    let passes =
        seconds.iter().map(|(name, seconds)| format!("{}={seconds}", name.replace(' ', "-")));
    passes.collect::<Vec<_>>().join(" ")
}

/// Without the one that a time budget sets.
fn parameters(variant: &Variant) -> String {
    let set = variant.parameters.iter().filter(|(name, _)| !variant.is_searched(name));
    set.map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(" ")
}

/// Which time a budget bounds.
fn bounded(variant: &Variant) -> &'static str {
    match variant.budget {
        Budget::Count => "",
        Budget::Seconds(_) | Budget::Baseline => variant.bounded.word(),
    }
}

fn budget(budget: Budget) -> String {
    match budget {
        Budget::Count => String::new(),
        Budget::Seconds(seconds) => seconds.to_string(),
        Budget::Baseline => "baseline".to_owned(),
    }
}

/// RFC 4180.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
