//! Which times moved: those of each variant as multiples of the baseline variant's in the same turn, so that
//! a machine that is busy or slower as a whole moves none.

use std::collections::BTreeMap;

use super::{Moved, row};
use crate::answer::statistics::median;
use crate::measurement::cell::{Cell, Outcome};

/// Ratios that a variant needs in a baseline: fewer tell too little of how far they spread.
const LEAST: usize = 9;

/// Whether a baseline tells how far its times spread. `baseline` is the label of the baseline variant.
///
/// # Errors
/// One line where a variant has too few times.
pub(crate) fn check_baseline(before: &[Cell], baseline: &str) -> Result<(), String> {
    let ratios = ratios(before, baseline);
    if ratios.is_empty() {
        return Err(format!("no time beside those of `{baseline}`"));
    }
    match ratios.iter().find(|(_, ratios)| ratios.len() < LEAST) {
        None => Ok(()),
        Some((name, ratios)) => Err(format!(
            "`{name}` has {} times over those of `{baseline}`, {LEAST} are needed: raise repetitions \
             in experiment.toml, then bless with --bless",
            ratios.len()
        )),
    }
}

/// The variants whose median ratio lies farther outside of what the ratios of `before` span than these are
/// apart. Where nothing changed and times are normal, one in 20 000 does with nine ratios on either side (a
/// simulation), and no more with one time in ten five times as noisy. Cells that come or go, or end in
/// another way, are named with the pictures.
pub(crate) fn compare(before: &[Cell], now: &[Cell], baseline: &str) -> Vec<Moved> {
    let (before, now) = (ratios(before, baseline), ratios(now, baseline));
    let mut moved = Vec::new();
    for (name, old) in &before {
        let median_of = |ratios: &Vec<f64>| median(ratios.iter().copied());
        let (Some(usual), Some(found)) = (median_of(old), now.get(name).and_then(median_of)) else {
            continue;
        };
        let lowest = old.iter().copied().fold(f64::INFINITY, f64::min);
        let highest = old.iter().copied().fold(0.0, f64::max);
        let spread = highest / lowest;
        if (lowest / spread..=highest * spread).contains(&found) {
            continue;
        }
        let why = format!(
            "by {:+.0} %, where the baseline's times span {lowest:.3} to {highest:.3}",
            100.0 * (found / usual - 1.0)
        );
        let quantity = format!("time over that of {baseline}");
        moved.push(row(name, &quantity, &format!("{usual:.3}"), &format!("{found:.3}"), &why));
    }
    moved
}

/// The multiples of the baseline variant's time by scene and variant.
fn ratios(cells: &[Cell], baseline: &str) -> BTreeMap<String, Vec<f64>> {
    let turn = |cell: &Cell| (cell.inputs.view(), cell.inputs.seed, cell.inputs.repetition);
    let timed = || cells.iter().filter_map(|cell| Some((cell, seconds(cell)?)));
    let of_baseline: BTreeMap<_, f64> = timed()
        .filter(|(cell, _)| cell.inputs.label() == baseline)
        .map(|(cell, seconds)| (turn(cell), seconds))
        .collect();
    let mut ratios: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for (cell, seconds) in timed().filter(|(cell, _)| cell.inputs.label() != baseline) {
        if let Some(unit) = of_baseline.get(&turn(cell)) {
            let name = format!("{} {}", cell.inputs.view(), cell.inputs.label());
            ratios.entry(name).or_default().push(seconds / unit);
        }
    }
    ratios
}

/// Of the frame.
pub(crate) fn seconds(cell: &Cell) -> Option<f64> {
    match &cell.outcome {
        Outcome::Done(done) => Some(done.step_seconds),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::regression::tests::cell;

    /// Three repetitions of three seeds of a baseline and a variant. What a turn is slowed by is the same for
    /// both; `noise` are the variant's own factors, beside a ratio.
    fn run(turns: [f64; 9], ratio: f64, noise: [f64; 9]) -> Vec<Cell> {
        let mut cells = Vec::new();
        for (index, (slow, noise)) in std::iter::zip(turns, noise).enumerate() {
            let (seed, repetition) = (index as u64 / 3, index as u32 % 3);
            for (method, seconds) in [("base", slow), ("other", slow * ratio * noise)] {
                let mut cell = cell(seed, 0.5, "here");
                cell.inputs.method = method.into();
                cell.inputs.repetition = repetition;
                let Outcome::Done(done) = &mut cell.outcome else { unreachable!("it is done") };
                done.step_seconds = seconds;
                cells.push(cell);
            }
        }
        cells
    }

    /// Within 3 % of their middle.
    const NOISE: [f64; 9] = [1.0, 1.01, 0.99, 1.02, 1.0, 0.98, 1.03, 0.97, 1.01];
    const QUIET: [f64; 9] = [1.0; 9];
    /// Other programs take half of the machine for some turns.
    const BUSY: [f64; 9] = [1.0, 2.0, 2.0, 1.0, 1.5, 3.0, 1.0, 1.0, 2.0];

    fn cells_that_moved(before: &[Cell], now: &[Cell]) -> Vec<String> {
        compare(before, now, "base").into_iter().map(|moved| moved.cell).collect()
    }

    #[test]
    fn a_slower_machine_moves_nothing() {
        let before = run(QUIET, 2.0, NOISE);
        let mut shuffled = NOISE;
        shuffled.rotate_left(4);
        let slower = run(BUSY.map(|slow| 3.0 * slow), 2.0, shuffled);
        assert_eq!(cells_that_moved(&before, &slower), [""; 0]);
    }

    #[test]
    fn what_exceeds_the_baselines_noise_is_named() {
        let before = run(BUSY, 2.0, NOISE);
        // The ratios span 1.94 to 2.06, so up to 2.187 is noise.
        for (factor, expected) in [(1.08, 0), (1.11, 1), (0.93, 0), (0.89, 1)] {
            let moved = cells_that_moved(&before, &run(QUIET, 2.0 * factor, QUIET));
            assert_eq!(moved.len(), expected, "{factor}: {moved:?}");
        }
        assert_eq!(cells_that_moved(&before, &run(QUIET, 3.0, NOISE)), ["s other"]);
        // A baseline that is noisier itself allows more.
        let noisy = run(QUIET, 2.0, NOISE.map(|noise| noise * noise * noise));
        assert_eq!(cells_that_moved(&noisy, &run(QUIET, 2.22, QUIET)), [""; 0]);
    }

    #[test]
    fn few_times_are_refused() {
        let all = run(QUIET, 2.0, NOISE);
        assert_eq!(check_baseline(&all, "base"), Ok(()));
        // Without the last turn of either.
        for few in [&all[..16], &all[..17]] {
            let refusal = check_baseline(few, "base").expect_err("eight ratios");
            assert!(refusal.contains("8 times") && refusal.contains("repetitions"), "{refusal}");
        }
        assert!(check_baseline(&[], "base").is_err());
        let mut declined = all.clone();
        declined[1].outcome = Outcome::Declined { reason: "no".into() };
        assert!(check_baseline(&declined, "base").is_err());
        assert_eq!(cells_that_moved(&all, &declined), [""; 0]);
    }
}
