//! What moved between two sets of cells of the same experiment.
//!
//! Three classes: counts and pictures are deterministic, and compared bit for bit where processor,
//! system and driver are the same; errors are statistical, and compared by their spread over seeds;
//! times are never compared here.

use std::collections::BTreeMap;

use crate::cell::{Cell, Done, Outcome};
use crate::provenance::Provenance;

/// Differences of errors below this part of their size are rounding of other processors.
const ROUNDING: f64 = 1e-3;
/// Standard errors that a mean may move by chance.
const SIGMAS: f64 = 4.0;

/// A quantity that moved.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub(crate) struct Moved {
    /// Scene and variant.
    pub(crate) cell: String,
    /// What.
    pub(crate) quantity: String,
    /// Its value in the baseline.
    pub(crate) before: String,
    /// Its value now.
    pub(crate) now: String,
    /// Why it counts.
    pub(crate) why: String,
}

/// The cells of a variant on a scene, by seed; repetitions have the same picture.
type Group<'c> = BTreeMap<u64, &'c Cell>;

/// Compares `now` with `before`.
pub(crate) fn compare(before: &[Cell], now: &[Cell]) -> Vec<Moved> {
    let (before, now) = (groups(before), groups(now));
    let mut moved = Vec::new();
    for (name, group) in &before {
        match now.get(name) {
            Some(current) => compare_group(name, group, current, &mut moved),
            None => moved.push(row(name, "cell", "present", "absent", "it is no longer run")),
        }
    }
    for name in now.keys().filter(|name| !before.contains_key(*name)) {
        moved.push(row(name, "cell", "absent", "present", "the baseline does not know it"));
    }
    moved
}

fn groups(cells: &[Cell]) -> BTreeMap<String, Group<'_>> {
    let mut groups: BTreeMap<String, Group<'_>> = BTreeMap::new();
    for cell in cells.iter().filter(|cell| cell.inputs.repetition == 0) {
        let name = format!("{} {}", cell.inputs.scene, cell.inputs.label());
        groups.entry(name).or_default().insert(cell.inputs.seed, cell);
    }
    groups
}

fn row(cell: &str, quantity: &str, before: &str, now: &str, why: &str) -> Moved {
    let [cell, quantity, before, now, why] = [cell, quantity, before, now, why].map(str::to_owned);
    Moved { cell, quantity, before, now, why }
}

fn compare_group(name: &str, before: &Group<'_>, now: &Group<'_>, moved: &mut Vec<Moved>) {
    let mut pairs = Vec::new();
    for (seed, old) in before {
        let Some(new) = now.get(seed) else {
            moved.push(row(name, &format!("seed {seed}"), "present", "absent", "it is not run"));
            continue;
        };
        match (&old.outcome, &new.outcome) {
            (Outcome::Done(a), Outcome::Done(b)) => {
                pairs.push((*old, a.as_ref(), *new, b.as_ref()));
            }
            (a, b) if a == b => {}
            (a, b) => {
                moved.push(row(name, "outcome", &words(a), &words(b), "it ends in another way"));
            }
        }
    }
    let changed = |of: &dyn Fn(&Cell, &Done) -> String| {
        let values = pairs.iter().map(|(old, a, new, b)| (of(old, a), of(new, b)));
        values.into_iter().find(|(a, b)| a != b)
    };
    if let Some((a, b)) = changed(&|cell, _| cell.inputs.scene_content.clone()) {
        moved.push(row(name, "scene", &a[..12], &b[..12], "the scene is another one"));
    }
    let exact = pairs.iter().all(|(old, _, new, _)| same_digits(&old.provenance, &new.provenance));
    if exact {
        let why = "deterministic on this processor and driver";
        if let Some((a, b)) = changed(&|_, done| format!("{:?}", done.counters)) {
            moved.push(row(name, "counts", &a, &b, why));
        }
        if let Some((a, b)) = changed(&|_, done| done.image_sha256.clone()) {
            moved.push(row(name, "picture", &a[..12], &b[..12], why));
        }
    }
    compare_errors(name, &pairs, moved);
}

fn words(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Done(_) => "a picture".to_owned(),
        Outcome::Declined { reason } => format!("declined: {reason}"),
        Outcome::Failed { reason } => format!("failed: {reason}"),
    }
}

/// Whether the same program gives the same bits in both places.
fn same_digits(a: &Provenance, b: &Provenance) -> bool {
    let driver = |p: &Provenance| {
        let fields = ["name", "driver", "driver_info"];
        p.adapter.as_ref().map(|adapter| fields.map(|field| adapter[field].clone()))
    };
    (&a.system, &a.cpu) == (&b.system, &b.cpu) && driver(a) == driver(b)
}

fn compare_errors(name: &str, pairs: &[(&Cell, &Done, &Cell, &Done)], moved: &mut Vec<Moved>) {
    let Some((_, first, ..)) = pairs.first() else { return };
    for reference in first.errors.keys() {
        let rmse = |done: &Done| Some(done.errors.get(reference)?.display.rmse);
        let before = Sample::new(pairs.iter().filter_map(|(_, a, ..)| rmse(a)));
        let now = Sample::new(pairs.iter().filter_map(|(.., b)| rmse(b)));
        let allowed = SIGMAS * before.error.hypot(now.error) + ROUNDING * before.mean;
        if (now.mean - before.mean).abs() > allowed {
            moved.push(Moved {
                cell: name.to_owned(),
                quantity: format!("RMSE ({reference})"),
                before: format!("{:.5}", before.mean),
                now: format!("{:.5}", now.mean),
                why: format!("more than {allowed:.5}, what {} seeds let expect", pairs.len()),
            });
        }
    }
}

/// Mean and its standard error.
struct Sample {
    mean: f64,
    error: f64,
}

impl Sample {
    fn new(values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.collect();
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let error = if n > 1.0 { (squares / (n - 1.0) / n).sqrt() } else { 0.0 };
        Self { mean, error }
    }
}
