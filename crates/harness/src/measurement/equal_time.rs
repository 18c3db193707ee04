//! The value of a cost parameter that takes a given time.

use std::ops::RangeInclusive;

/// A time this near to its target, relatively, ends the search.
const CLOSE: f64 = 0.02;
/// Runs of one search at most: noise may keep it from [`CLOSE`] for ever.
const TRIES: usize = 12;
/// The amount of work changes at most so much from one try to the next.
const STRIDE: f64 = 16.0;

/// Searches `range` from `start` on for the amount of work that takes `target` seconds, where
/// `seconds` measures an amount. The next amount is where a line through the two nearest tries meets
/// the target, so a try costs more than `target` only by what the line is wrong. Gives the nearest
/// one tried.
///
/// # Errors
/// Those of `seconds`.
pub(crate) fn search<E>(
    target: f64,
    range: RangeInclusive<u64>,
    start: u64,
    mut seconds: impl FnMut(u64) -> Result<f64, E>,
) -> Result<u64, E> {
    let mut tried: Vec<(u64, f64)> = Vec::new();
    let mut amount = start;
    while tried.len() < TRIES {
        tried.push((amount, seconds(amount)?));
        tried.sort_by(|a, b| distance(a.1, target).total_cmp(&distance(b.1, target)));
        if distance(tried[0].1, target) < CLOSE {
            break;
        }
        amount = proposal(&tried, target).clamp(*range.start(), *range.end());
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

/// The next amount, from tries in the order of their distance to the target.
fn proposal(tried: &[(u64, f64)], target: f64) -> u64 {
    let (amount, seconds) = (tried[0].0 as f64, tried[0].1);
    let proportional = amount * target / seconds;
    let wanted = match tried.get(1) {
        // Two times that hardly differ say nothing of the slope.
        Some(&(other, time)) if distance(seconds, time) > 0.2 => {
            let slope = (seconds - time) / (amount - other as f64);
            if slope > 0.0 { amount + (target - seconds) / slope } else { proportional }
        }
        _ => proportional,
    };
    wanted.clamp(amount / STRIDE, amount * STRIDE).round() as u64
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    fn found(target: f64, start: u64, cost: impl Fn(u64) -> f64) -> (u64, usize) {
        let mut runs = 0;
        let measured = |amount| {
            runs += 1;
            Ok::<_, Infallible>(cost(amount))
        };
        let amount = search(target, 1..=1 << 24, start, measured).expect("infallible");
        (amount, runs)
    }

    #[test]
    fn affine_costs_are_met_in_a_few_runs() {
        for start in [1, 1024, 1 << 20] {
            for target in [0.01, 0.1, 1.0, 10.0] {
                let cost = |amount| 0.004 + 1e-5 * amount as f64;
                let (amount, runs) = found(target, start, cost);
                assert!(distance(cost(amount), target) < CLOSE, "{amount} for {target}");
                assert!(runs <= 9, "{runs} runs for {target} from {start}");
            }
        }
    }

    #[test]
    fn a_time_below_the_overhead_gives_the_least_work() {
        assert_eq!(found(0.001, 1024, |amount| 0.01 + 1e-4 * amount as f64).0, 1);
    }

    #[test]
    fn steps_of_the_cost_are_met_as_near_as_they_allow() {
        // Whole slices of 16.
        let cost = |amount: u64| 0.01 * amount.next_multiple_of(16) as f64;
        let (amount, _) = found(0.5, 64, cost);
        assert!([0.48, 0.64].contains(&cost(amount)), "{}", cost(amount));
    }
}
