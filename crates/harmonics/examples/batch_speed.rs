//! Times batch evaluation on one thread: for scripts/compare-sphericart. Prints a JSON object of
//! nanoseconds per direction by cell, `scalar kind l_max directions` (`-fill`: filling
//! the same memory with a constant, the limit of writing); outputs are written again and
//! again into the same memory. With `errors` as argument, the largest errors of f32 by `kind l_max`.

use std::hint::black_box;
use std::time::Instant;

use manylights_harmonics::batch::{gradients_length, lanes, values_length};
use manylights_harmonics::{Basis, Vectors};

/// Seconds that a cell is measured for, at least.
const BUDGET: f64 = 0.02;

fn main() {
    let mut cells = Vec::new();
    if std::env::args().any(|argument| argument == "errors") {
        for l_max in [2, 4, 6, 9, 14, 19] {
            errors(l_max, &mut cells);
        }
        println!("{{{}}}", cells.join(", "));
        return;
    }
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
    let time = median(directions, || black_box(&mut values).fill(R::one()));
    cells.push(format!("\"{scalar} values-fill {l_max} {directions}\": {time:.3}"));
    drop(values);
    let mut output = vec![R::zero(); gradients_length::<R>(bands, directions)];
    let time = median(directions, || {
        basis.evaluate_batch_with_gradients_at([&x, &y, &z], black_box(&mut output));
    });
    cells.push(format!("\"{scalar} gradients {l_max} {directions}\": {time:.3}"));
    let time = median(directions, || black_box(&mut output).fill(R::one()));
    cells.push(format!("\"{scalar} gradients-fill {l_max} {directions}\": {time:.3}"));
}

/// Largest absolute error of f32 against f64 at the same points.
fn errors(l_max: usize, cells: &mut Vec<String>) {
    let points = spiral::<f32>(1_000);
    let exact =
        points.each_ref().map(|axis| axis.iter().map(|&c| f64::from(c)).collect::<Vec<_>>());
    let found = evaluate(l_max + 1, &points);
    let truth = evaluate(l_max + 1, &exact);
    // Blocks of f64 are half as long as those of f32.
    let (wide, rows) = (lanes::<f32>(), 4 * (l_max + 1) * (l_max + 1));
    let mut worst = [0.0_f64; 2];
    for i in 0..1_000 {
        for row in 0..rows {
            let single = found[(i / wide * rows + row) * wide + i % wide];
            let double = truth[(i / (wide / 2) * rows + row) * (wide / 2) + i % (wide / 2)];
            let kind = usize::from(row % 4 > 0);
            worst[kind] = worst[kind].max((f64::from(single) - double).abs());
        }
    }
    cells
        .push(format!("\"values {l_max}\": {:e}, \"gradients {l_max}\": {:e}", worst[0], worst[1]));
}

fn evaluate<R: Vectors>(bands: usize, [x, y, z]: &[Vec<R>; 3]) -> Vec<R> {
    let mut output = vec![R::zero(); gradients_length::<R>(bands, x.len())];
    Basis::new(bands).evaluate_batch_with_gradients_at([x, y, z], &mut output);
    output
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
