//! Times batch evaluation on one thread: for scripts/compare-sphericart. Prints a JSON object of
//! nanoseconds per direction by cell, `scalar kind l_max directions`; outputs are written again and
//! again into the same memory.

use std::hint::black_box;
use std::time::Instant;

use manylights_harmonics::batch::{gradients_length, values_length};
use manylights_harmonics::{Basis, Vectors};

/// Seconds that a cell is measured for, at least.
const BUDGET: f64 = 0.02;

fn main() {
    let mut cells = Vec::new();
    for directions in [1_000, 100_000] {
        for l_max in [2, 4, 6, 9, 14, 19] {
            measure::<f32>("f32", l_max, directions, &mut cells);
            measure::<f64>("f64", l_max, directions, &mut cells);
        }
    }
    println!("{{{}}}", cells.join(", "));
}

fn measure<R: Vectors>(scalar: &str, l_max: usize, directions: usize, cells: &mut Vec<String>) {
    let bands = l_max + 1;
    let basis = Basis::<R>::new(bands);
    let [x, y, z] = spiral(directions);
    let mut values = vec![R::zero(); values_length::<R>(bands, directions)];
    let time = median(directions, || basis.evaluate_batch([&x, &y, &z], black_box(&mut values)));
    cells.push(format!("\"{scalar} values {l_max} {directions}\": {time:.3}"));
    drop(values);
    let mut output = vec![R::zero(); gradients_length::<R>(bands, directions)];
    let time = median(directions, || {
        basis.evaluate_batch_with_gradients_at([&x, &y, &z], black_box(&mut output));
    });
    cells.push(format!("\"{scalar} gradients {l_max} {directions}\": {time:.3}"));
}

/// Directions on a Fibonacci spiral.
fn spiral<R: Vectors>(count: usize) -> [Vec<R>; 3] {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let point = |i: usize| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sine, cosine) = (golden * i as f64).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        [radius * cosine, radius * sine, z].map(R::of)
    };
    let points: Vec<[R; 3]> = (0..count).map(point).collect();
    [0, 1, 2].map(|axis| points.iter().map(|point| point[axis]).collect())
}

/// Median nanoseconds per direction of a call, the first calls left out.
fn median(directions: usize, mut call: impl FnMut()) -> f64 {
    call();
    let start = Instant::now();
    let mut times = Vec::new();
    while times.len() < 5 || start.elapsed().as_secs_f64() < BUDGET {
        let start = Instant::now();
        call();
        times.push(start.elapsed().as_secs_f64() * 1e9 / directions as f64);
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
