//! Times that two examples compare.

use std::time::Instant;

const ROUNDS: usize = 101;

/// Median nanoseconds for one element of each call on `inputs`, in interleaved rounds.
pub(crate) fn medians<T, const N: usize>(
    inputs: &[T],
    mut calls: [&mut dyn FnMut(&T); N],
) -> [f64; N] {
    let mut times = [const { Vec::new() }; N];
    for _ in 0..ROUNDS {
        for (times, call) in times.iter_mut().zip(&mut calls) {
            let start = Instant::now();
            inputs.iter().for_each(&mut **call);
            times.push(start.elapsed().as_secs_f64() * 1e9 / inputs.len() as f64);
        }
    }
    times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[ROUNDS / 2]
    })
}
