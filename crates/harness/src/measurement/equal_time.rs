//! The value of a cost parameter that takes a given time.

use manylights_method::Amounts;

/// A time this near to its target, relatively, ends the search.
const CLOSE: f64 = 0.02;
/// Runs of one search at most: noise may keep it from [`CLOSE`] for ever.
const TRIES: usize = 12;
/// The amount of work changes at most so much from one try to the next.
const STRIDE: f64 = 16.0;

/// Searches `amounts` from `start` on for the amount of work that takes `target` seconds, where
/// `seconds` measures an amount. The next amount is where a line through the two nearest tries, seconds
/// against work, meets the target, so a try costs more than `target` only by what the line is wrong.
/// Gives the nearest one tried.
///
/// # Errors
/// Those of `seconds`.
pub(crate) fn search<E>(
    target: f64,
    amounts: Amounts,
    start: f64,
    mut seconds: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let mut tried: Vec<(f64, f64)> = Vec::new();
    let mut amount = start;
    while tried.len() < TRIES {
        tried.push((amount, seconds(amount)?));
        tried.sort_by(|a, b| distance(a.1, target).total_cmp(&distance(b.1, target)));
        if distance(tried[0].1, target) < CLOSE {
            break;
        }
        let works = tried.iter().map(|&(amount, seconds)| (amounts.work(amount), seconds));
        amount = amounts.nearest(proposal(&works.collect::<Vec<_>>(), target));
        if tried.iter().any(|&(known, _)| known == amount) {
            break;
        }
    }
    Ok(tried[0].0)
}

/// Of a time from its target, as a ratio either way.
pub(crate) fn distance(seconds: f64, target: f64) -> f64 {
    (seconds / target).ln().abs()
}

/// Part of the target by which a time is off.
pub(crate) fn miss(seconds: f64, target: f64) -> f64 {
    (seconds / target - 1.0).abs()
}

/// The next work, from tries (work, seconds) in the order of their distance to the target.
fn proposal(tried: &[(f64, f64)], target: f64) -> f64 {
    let (work, seconds) = tried[0];
    let proportional = work * target / seconds;
    let wanted = match tried.get(1) {
        // Two times that hardly differ say nothing of the slope.
        Some(&(other, time)) if distance(seconds, time) > 0.2 => {
            let slope = (seconds - time) / (work - other);
            if slope > 0.0 { work + (target - seconds) / slope } else { proportional }
        }
        _ => proportional,
    };
    wanted.clamp(work / STRIDE, work * STRIDE)
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use manylights_method::{Cost, Direction, ParameterInfo, ParameterKind};

    use super::*;

    fn amounts(kind: ParameterKind, grows: Direction) -> Amounts {
        let info = ParameterInfo { name: "n", formerly: None, introduced: None, help: "", kind };
        Amounts::new(Cost { parameter: "n", grows }, &[info]).expect("positive numbers")
    }

    fn counts() -> Amounts {
        amounts(ParameterKind::Count { default: 1, min: 1, max: 1 << 24 }, Direction::Up)
    }

    fn accuracies() -> Amounts {
        let kind = ParameterKind::Real { default: 0.1, min: 1e-4, max: 1.0 };
        amounts(kind, Direction::Down)
    }

    fn found(amounts: Amounts, target: f64, start: f64, cost: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut runs = 0;
        let measured = |amount| {
            runs += 1;
            Ok::<_, Infallible>(cost(amount))
        };
        let amount = search(target, amounts, start, measured).expect("infallible");
        assert!(amounts.contains(amount), "{amount}");
        (amount, runs)
    }

    #[test]
    fn affine_costs_are_met_in_a_few_runs() {
        for start in [1.0, 1024.0, 1_048_576.0] {
            for target in [0.01, 0.1, 1.0, 10.0] {
                let cost = |amount| 0.004 + 1e-5 * amount;
                let (amount, runs) = found(counts(), target, start, cost);
                assert!(distance(cost(amount), target) < CLOSE, "{amount} for {target}");
                assert!(runs <= 9, "{runs} runs for {target} from {start}");
            }
        }
    }

    #[test]
    fn an_accuracy_shrinks_until_it_takes_the_time() {
        for start in [1e-3, 0.03, 1.0] {
            for target in [0.1, 1.0, 10.0] {
                // Of records on surfaces, as supposed; along lines; in volumes.
                for (power, factor) in [(-2, 1e-5), (-1, 2e-2), (-3, 1e-6)] {
                    let cost = |error: f64| 0.004 + factor * error.powi(power);
                    let (error, runs) = found(accuracies(), target, start, cost);
                    assert!(distance(cost(error), target) < CLOSE, "{error} for {target}");
                    assert!(runs <= 9, "{runs} runs for {target} from {start}, power {power}");
                }
            }
        }
    }

    #[test]
    fn a_time_below_the_overhead_gives_the_least_work() {
        assert_eq!(found(counts(), 0.001, 1024.0, |amount| 0.01 + 1e-4 * amount).0, 1.0);
        assert_eq!(found(accuracies(), 0.001, 0.1, |amount| 0.01 + 1e-4 / amount).0, 1.0);
    }

    #[test]
    fn steps_of_the_cost_are_met_as_near_as_they_allow() {
        // Whole slices of 16.
        let cost = |amount: f64| 0.01 * (amount / 16.0).ceil() * 16.0;
        let (amount, _) = found(counts(), 0.5, 64.0, cost);
        assert!([0.48, 0.64].contains(&cost(amount)), "{}", cost(amount));
    }
}
