//! What moved between two sets of cells of the same experiment.
//!
//! Counts and pictures are deterministic, and compared bit for bit where processor, system and driver
//! are the same. Counts and errors are compared everywhere, seed by seed: the spread over seeds, which
//! is far larger than a regression, cancels. Times are compared where that is asked for ([`times`]).

pub(crate) mod times;

use std::collections::BTreeMap;

use crate::measurement::cell::{Cell, Done, Outcome};
use crate::measurement::provenance::Provenance;

/// Differences below this part of a number are rounding of other processors and drivers: a choice,
/// for want of a second driver to measure it on.
const ROUNDING: f64 = 1e-3;

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

/// The cells whose pictures stand for a variant on a scene, those of its first seed, by its name.
pub(crate) fn pictured(cells: &[Cell]) -> BTreeMap<String, &Cell> {
    let firsts = groups(cells).into_iter().filter_map(|(name, group)| {
        let (_, cell) = group.into_iter().next()?;
        matches!(cell.outcome, Outcome::Done(_)).then_some((name, cell))
    });
    firsts.collect()
}

fn groups(cells: &[Cell]) -> BTreeMap<String, Group<'_>> {
    let mut groups: BTreeMap<String, Group<'_>> = BTreeMap::new();
    for cell in cells.iter().filter(|cell| cell.inputs.repetition == 0) {
        let name = format!("{} {}", cell.inputs.view(), cell.inputs.label());
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
    if pairs.iter().all(|(old, _, new, _)| same_digits(&old.provenance, &new.provenance)) {
        let why = "deterministic on this processor and driver";
        if let Some((a, b)) = changed(&|_, done| format!("{:?}", counts(done))) {
            moved.push(row(name, "counts", &a, &b, why));
        }
        if let Some((a, b)) = changed(&|_, done| done.image_sha256.clone()) {
            moved.push(row(name, "picture", &a[..12], &b[..12], why));
        }
    }
    for (old, a, _, b) in pairs {
        compare_numbers(name, old.inputs.seed, &numbers(a), &numbers(b), moved);
    }
}

/// Counts of the frame and of its bake by name.
fn counts(done: &Done) -> BTreeMap<String, u64> {
    let baked = done.bake_counters.iter().map(|(name, &count)| (format!("baked {name}"), count));
    done.counters.iter().map(|(name, &count)| (name.clone(), count)).chain(baked).collect()
}

/// Counts and errors by name.
fn numbers(done: &Done) -> BTreeMap<String, f64> {
    let counts = counts(done).into_iter().map(|(name, count)| (name, count as f64));
    let errors = done.errors.iter();
    let errors =
        errors.map(|(reference, errors)| (format!("RMSE ({reference})"), errors.display.rmse));
    counts.chain(errors).collect()
}

/// The same seed draws the same numbers everywhere: what is left between processors is rounding.
fn compare_numbers(
    name: &str,
    seed: u64,
    before: &BTreeMap<String, f64>,
    now: &BTreeMap<String, f64>,
    moved: &mut Vec<Moved>,
) {
    for (quantity, &a) in before {
        let Some(&b) = now.get(quantity) else {
            moved.push(row(name, quantity, &format!("{a:.6}"), "absent", "it is not measured"));
            continue;
        };
        let within = (b - a).abs() <= ROUNDING * a.abs();
        if !within {
            let why = match a {
                0.0 => "it was nothing".to_owned(),
                _ => format!("by {:+.2} %, where rounding explains 0.1 %", 100.0 * (b / a - 1.0)),
            };
            let quantity = format!("{quantity}, seed {seed}");
            moved.push(row(name, &quantity, &format!("{a:.6}"), &format!("{b:.6}"), &why));
        }
    }
}

fn words(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Done(_) => "a picture".to_owned(),
        Outcome::Declined { reason } => format!("declined: {reason}"),
        Outcome::Failed { reason } => format!("failed: {reason}"),
    }
}

/// Whether the same program gives the same bits in both places.
pub(crate) fn same_digits(a: &Provenance, b: &Provenance) -> bool {
    let driver = |p: &Provenance| {
        let fields = ["name", "driver", "driver_info"];
        p.adapter.as_ref().map(|adapter| fields.map(|field| adapter[field].clone()))
    };
    (&a.system, &a.cpu) == (&b.system, &b.cpu) && driver(a) == driver(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::cell::Comparison;
    use crate::measurement::inputs::Inputs;
    use crate::question::plan::{Bounded, Budget};
    use manylights_metrics::Errors;

    pub(super) fn cell(seed: u64, rmse: f64, program: &str) -> Cell {
        let [mse, mae, psnr, ssim, rel_mse, smape, rel_p999] = [0.0; 7];
        let (rel_mse_trimmed, flip) = (None, None);
        let errors =
            Errors { rmse, mse, mae, psnr, ssim, rel_mse, smape, rel_p999, rel_mse_trimmed, flip };
        let comparison = Comparison {
            linear: errors,
            display: errors,
            linear_floor: 0.0,
            display_floor: 0.0,
            tiles: None,
        };
        let done = Done {
            amount: Some(4.0),
            visibility: None,
            bake_seconds: 0.0,
            bake_pass_seconds: BTreeMap::new(),
            bake_counters: BTreeMap::new(),
            bake_shared: false,
            prepare_seconds: 0.0,
            step_seconds: 1.0,
            pass_seconds: BTreeMap::new(),
            counters: BTreeMap::from([("lights".into(), 1000)]),
            image_sha256: format!("{rmse:064}"),
            errors: BTreeMap::from([("traced".into(), comparison)]),
            checkpoints: Vec::new(),
        };
        let inputs = Inputs {
            scene: "s".into(),
            scene_content: "0123456789abcdef".into(),
            method: "m".into(),
            parameters: BTreeMap::new(),
            budget: Budget::Count,
            seed,
            repetition: 0,
            transport: "all".into(),
            asked_visibility: None,
            resolution: [16, 16],
            exposure: 1.0,
            references: BTreeMap::new(),
            bounded: Bounded::Time,
            camera: None,
        };
        let provenance = Provenance { cpu: program.into(), ..Provenance::here(None) };
        Cell::new(inputs, Outcome::Done(Box::new(done)), BTreeMap::new(), provenance)
    }

    fn quantities(before: &[Cell], now: &[Cell]) -> Vec<String> {
        compare(before, now).into_iter().map(|moved| moved.quantity).collect()
    }

    #[test]
    fn on_the_same_processor_every_bit_counts() {
        let [a, b] = [cell(1, 0.5, "here"), cell(1, 0.5 + 1e-9, "here")];
        assert_eq!(quantities(std::slice::from_ref(&a), std::slice::from_ref(&a)), [""; 0]);
        assert_eq!(quantities(&[a], &[b]), ["picture"]);
    }

    #[test]
    fn on_another_processor_errors_may_round() {
        let before = [cell(1, 0.5, "here"), cell(2, 0.7, "here")];
        let rounded = [cell(1, 0.5 + 1e-6, "there"), cell(2, 0.7 - 1e-6, "there")];
        assert_eq!(quantities(&before, &rounded), [""; 0]);
        // Far less than the spread over seeds, and still seen.
        let wrong = [cell(1, 0.502, "there"), cell(2, 0.7, "there")];
        assert_eq!(quantities(&before, &wrong), ["RMSE (traced), seed 1"]);
        let mut broken = cell(2, 0.7, "there");
        if let Outcome::Done(done) = &mut broken.outcome {
            done.counters.insert("lights".into(), 1010);
        }
        let now = [cell(1, 0.5, "there"), broken];
        assert_eq!(quantities(&before, &now), ["lights, seed 2"]);
        assert_eq!(quantities(&before, &[cell(1, 0.5, "there")]), ["seed 2"]);
    }

    #[test]
    fn outcomes_and_cells_that_come_and_go_are_named() {
        let a = cell(1, 0.5, "here");
        let declined = Cell { outcome: Outcome::Declined { reason: "no".into() }, ..a.clone() };
        assert_eq!(quantities(std::slice::from_ref(&a), &[declined]), ["outcome"]);
        assert_eq!(quantities(std::slice::from_ref(&a), &[]), ["cell"]);
        assert_eq!(quantities(&[], &[a]), ["cell"]);
    }
}
