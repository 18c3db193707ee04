//! Whether a line of `cells.jsonl` can be what a run wrote. Keys vouch for what was asked; this is for
//! what came out, which files, tables and figures take on trust.

use std::collections::BTreeMap;

use manylights_metrics::Errors;

use crate::error::one_line;
use crate::measurement::cell::{Cell, Checkpoint, Comparison, Done, Outcome};
use crate::measurement::inputs::{Inputs, ReferenceInputs};
use crate::measurement::tiles::{TILES, Tiles};
use crate::question::plan::Budget;
use crate::question::settings;
use crate::registry::METHODS;

/// More than any run takes, 30 years.
const MOST_SECONDS: f64 = 1e9;
/// More than any run does.
const MOST_WORK: f64 = 1e20;
/// More than any error of radiance: the square of the largest 32-bit float.
const MOST_ERROR: f64 = 1.2e77;
/// More decibels than two such numbers can be apart.
const MOST_DECIBELS: f64 = 2000.0;

/// Refuses a cell that no run writes.
///
/// # Errors
/// One line that names the field.
pub(crate) fn check(cell: &Cell) -> Result<(), String> {
    let Cell { key, inputs, outcome, provenance, .. } = cell;
    let hashes = [("key", key), ("scene_content", &inputs.scene_content)];
    hashes.into_iter().try_for_each(|(name, text)| hash(name, text))?;
    // They become part of the names of files.
    for name in inputs.camera.iter().chain([&inputs.scene]).chain(inputs.references.keys()) {
        if name.is_empty() || name.contains(['/', '\\']) || is_broken(name) {
            return Err(format!("`{}` is not a name", one_line(name)));
        }
    }
    if provenance.machine.is_empty() || is_broken(&provenance.machine) {
        return Err("`machine` is not a name".into());
    }
    settings::check_resolution(inputs.resolution)?;
    if let Budget::Seconds(seconds) = inputs.budget {
        within("budget", seconds, f64::MIN_POSITIVE, MOST_SECONDS)?;
    }
    within("exposure", inputs.exposure.into(), f64::MIN_POSITIVE, f32::MAX.into())?;
    match outcome {
        Outcome::Done(done) if done.amount.is_none() && has_amount(inputs) => {
            Err("`amount` is missing".into())
        }
        Outcome::Done(done) => check_done(done, &inputs.references),
        Outcome::Declined { reason } | Outcome::Failed { reason } if reason.trim().is_empty() => {
            Err("`reason` is empty".into())
        }
        Outcome::Declined { .. } | Outcome::Failed { .. } => Ok(()),
    }
}

/// Whether its method has a cost, as any has whose amount was searched; of a method that this program does not
/// know nothing else can be said.
fn has_amount(inputs: &Inputs) -> bool {
    let method = METHODS.iter().find(|method| method.id() == inputs.method);
    matches!(inputs.budget, Budget::Seconds(_))
        || method.is_some_and(|method| method.cost().is_some())
}

fn check_done(done: &Done, references: &BTreeMap<String, ReferenceInputs>) -> Result<(), String> {
    if let Some(amount) = done.amount {
        within("amount", amount, f64::MIN_POSITIVE, MOST_WORK)?;
    }
    within("bake_seconds", done.bake_seconds, 0.0, MOST_SECONDS)?;
    within("prepare_seconds", done.prepare_seconds, 0.0, MOST_SECONDS)?;
    within("step_seconds", done.step_seconds, f64::MIN_POSITIVE, MOST_SECONDS)?;
    for &seconds in done.pass_seconds.values().chain(done.bake_pass_seconds.values()) {
        within("pass_seconds", seconds, 0.0, MOST_SECONDS)?;
    }
    hash("image_sha256", &done.image_sha256)?;
    if !done.errors.keys().eq(references.keys()) {
        return Err("`errors` and `references` name different references".into());
    }
    done.errors.values().try_for_each(check_comparison)?;
    for Checkpoint { amount, step_seconds, display_rmse } in &done.checkpoints {
        within("amount", *amount, f64::MIN_POSITIVE, MOST_WORK)?;
        within("step_seconds", *step_seconds, f64::MIN_POSITIVE, MOST_SECONDS)?;
        for &rmse in display_rmse.values() {
            within("display_rmse", rmse, 0.0, 1.0)?;
        }
    }
    Ok(())
}

fn check_comparison(comparison: &Comparison) -> Result<(), String> {
    let Comparison { linear, display, linear_floor, display_floor, tiles } = comparison;
    tiles.iter().try_for_each(check_tiles)?;
    for (errors, most) in [(linear, MOST_ERROR), (display, 1.0)] {
        let Errors { rmse, mse, mae, psnr, ssim, rel_mse, smape, rel_p999, rel_mse_trimmed, flip } =
            *errors;
        within("rmse", rmse, 0.0, most)?;
        within("mse", mse, 0.0, most)?;
        within("mae", mae, 0.0, most)?;
        within("ssim", ssim, -1.0, 1.0)?;
        within("rel_mse", rel_mse, 0.0, MOST_ERROR)?;
        within("smape", smape, 0.0, 1.0)?;
        within("rel_p999", rel_p999, 0.0, MOST_ERROR)?;
        // Unknown of older lines.
        within("rel_mse_trimmed", rel_mse_trimmed.unwrap_or_default(), 0.0, MOST_ERROR)?;
        within("flip", flip.unwrap_or_default(), 0.0, 1.0)?;
        // Of identical pictures it is infinite.
        if mse > 0.0 || psnr != f64::INFINITY {
            within("psnr", psnr, -MOST_DECIBELS, MOST_DECIBELS)?;
        }
    }
    within("linear_floor", *linear_floor, 0.0, MOST_ERROR)?;
    within("display_floor", *display_floor, 0.0, 1.0)
}

fn check_tiles(tiles: &Tiles) -> Result<(), String> {
    let Tiles { squared, imbalance } = tiles;
    let lengths = [squared.len(), imbalance.len()];
    if lengths != [TILES; 2] && lengths != [TILES, 0] {
        return Err(format!("`tiles` are {TILES} numbers, not {lengths:?}"));
    }
    squared.iter().try_for_each(|&value| within("squared", value.into(), 0.0, 1.0))?;
    imbalance.iter().try_for_each(|&value| within("imbalance", value.into(), -1.0, 1.0))
}

fn within(name: &str, value: f64, low: f64, high: f64) -> Result<(), String> {
    // Means of numbers within bounds may round to just outside.
    let slack = 1e-9 * high.abs().min(1.0);
    if (low..=high + slack).contains(&value) || value == low {
        Ok(())
    } else {
        Err(format!("`{name}` cannot be {value}"))
    }
}

fn hash(name: &str, text: &str) -> Result<(), String> {
    let is_digit = |byte: u8| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte);
    if text.len() == 64 && text.bytes().all(is_digit) {
        Ok(())
    } else {
        Err(format!("`{name}` is not a hash of 64 hexadecimal digits"))
    }
}

fn is_broken(text: &str) -> bool {
    text.contains(char::is_control)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::measurement::provenance::{Provenance, sha256};
    use crate::measurement::versions::Versions;
    use crate::question::plan::Bounded;

    /// A cell such as a run writes.
    pub(crate) fn done_cell(seed: u64) -> Cell {
        let errors = Errors {
            rmse: 0.1,
            mse: 0.01,
            mae: 0.1,
            psnr: 20.0,
            ssim: 0.5,
            rel_mse: 0.3,
            smape: 0.2,
            rel_p999: 0.9,
            rel_mse_trimmed: Some(0.2),
            flip: Some(0.15),
        };
        let comparison = Comparison {
            linear: errors,
            display: errors,
            linear_floor: 1e-3,
            display_floor: 1e-4,
            tiles: None,
        };
        let done = Done {
            amount: Some(32.0),
            bake_seconds: 0.0,
            bake_pass_seconds: BTreeMap::new(),
            bake_counters: BTreeMap::new(),
            bake_shared: false,
            visibility: Some("traced".into()),
            prepare_seconds: 0.25,
            step_seconds: 0.3,
            pass_seconds: BTreeMap::from([("gather".into(), 0.125)]),
            counters: BTreeMap::from([("rays".into(), 7)]),
            image_sha256: sha256(b"picture"),
            errors: BTreeMap::from([("traced".into(), comparison)]),
            checkpoints: vec![Checkpoint {
                amount: 16.0,
                step_seconds: 0.01,
                display_rmse: BTreeMap::from([("traced".into(), 0.1)]),
            }],
        };
        let inputs = Inputs {
            scene: "s".into(),
            camera: None,
            scene_content: sha256(b"content"),
            method: "m".into(),
            parameters: BTreeMap::new(),
            budget: Budget::Count,
            bounded: Bounded::Time,
            seed,
            repetition: 0,
            transport: "all".into(),
            asked_visibility: None,
            resolution: [16, 16],
            exposure: 1.0,
            references: BTreeMap::from([("traced".into(), ReferenceInputs::Samples(32))]),
        };
        let outcome = Outcome::Done(Box::new(done));
        Cell::new(inputs, outcome, Versions::new(), Provenance::here(None))
    }

    #[test]
    fn absurd_outcomes_are_named() {
        assert_eq!(check(&done_cell(1)), Ok(()));
        type Edit = fn(&mut Done);
        let edits: [(Edit, &str); 14] = [
            (|done| done.step_seconds = -1.0, "step_seconds"),
            (|done| done.step_seconds = 0.0, "step_seconds"),
            (|done| done.prepare_seconds = f64::NAN, "prepare_seconds"),
            (|done| done.step_seconds = 1e300, "step_seconds"),
            (|done| done.image_sha256.truncate(3), "image_sha256"),
            (|done| done.image_sha256.clear(), "image_sha256"),
            (|done| done.errors.clear(), "errors"),
            (|done| done.checkpoints[0].step_seconds = 0.0, "step_seconds"),
            (|done| done.checkpoints[0].display_rmse = [("traced".into(), -0.1)].into(), "rmse"),
            (|done| edit_errors(done, |errors| errors.psnr = f64::INFINITY), "psnr"),
            (|done| edit_errors(done, |errors| errors.rmse = f64::NEG_INFINITY), "rmse"),
            (|done| edit_errors(done, |errors| errors.ssim = 7.0), "ssim"),
            (|done| edit_errors(done, |errors| errors.flip = Some(1.5)), "flip"),
            (|done| edit_errors(done, |errors| errors.rel_mse_trimmed = Some(-1.0)), "trimmed"),
        ];
        for (edit, said) in edits {
            let mut cell = done_cell(1);
            let Outcome::Done(done) = &mut cell.outcome else { panic!("it is done") };
            edit(done);
            let reason = check(&cell).expect_err(said);
            assert!(reason.contains(said) && reason.lines().count() == 1, "{reason} / {said}");
        }
        let mut cell = done_cell(1);
        cell.inputs.scene = "../../elsewhere".into();
        assert!(check(&cell).is_err());
    }

    #[test]
    fn only_methods_without_a_cost_have_no_amount() {
        let without = |method: &str, budget| {
            let mut cell = done_cell(1);
            (cell.inputs.method, cell.inputs.budget) = (method.into(), budget);
            let Outcome::Done(done) = &mut cell.outcome else { panic!("it is done") };
            done.amount = None;
            check(&cell)
        };
        let missing = Err("`amount` is missing".to_owned());
        for method in METHODS {
            let expected = if method.cost().is_some() { missing.clone() } else { Ok(()) };
            assert_eq!(without(method.id(), Budget::Count), expected, "{}", method.id());
        }
        // Of nobody here.
        assert_eq!(without("m", Budget::Count), Ok(()));
        assert_eq!(without("m", Budget::Seconds(0.1)), missing);
    }

    fn edit_errors(done: &mut Done, edit: impl Fn(&mut Errors)) {
        done.errors.values_mut().for_each(|comparison| edit(&mut comparison.display));
    }
}
