//! Thesis table 3.1: nanoseconds for values and gradients at one direction, f32, with the pole-free form
//! beside. `scripts/compare-sphericart` writes it to results/sh-speed/single.md.

use std::hint::black_box;
use std::time::Instant;

use manylights_harmonics::thesis::{Polynomials, SphericalGradients, to_cartesian};
use manylights_harmonics::{Basis, count};

const BANDS: [usize; 6] = [3, 4, 5, 6, 8, 10];
/// Thousand directions a hundred times, as in the thesis; interleaved, medians.
const ROUNDS: usize = 100;
const ROWS: [&str; 8] = [
    "Polynomial: values",
    "Polynomial: gradient",
    "Sloan's-like: values, ∂θ, ∂φ",
    "Direct: values, ∂θ, ∂φ",
    "Cartesian conversion",
    "Sloan's-like and conversion",
    "Direct and conversion",
    "pole-free: values and gradient",
];
/// Rows above in the thesis, on its machine; it has no pole-free form.
const THESIS: [[f64; 6]; 7] = [
    [27.82, 32.22, 40.57, 54.63, 84.51, 144.01],
    [56.91, 83.34, 122.28, 190.25, 386.91, 720.26],
    [25.86, 33.77, 44.51, 59.95, 106.35, 169.82],
    [42.28, 60.66, 81.15, 112.32, 196.33, 296.94],
    [41.63, 43.67, 48.97, 53.82, 66.19, 84.41],
    [67.50, 77.43, 93.48, 113.78, 172.55, 254.23],
    [83.92, 104.32, 130.13, 166.14, 262.52, 381.35],
];

fn main() {
    println!(
        "Nanoseconds for one direction, f32, medians of {ROUNDS} interleaved rounds over 1 000"
    );
    println!(
        "directions; in brackets thesis table 3.1, measured on its machine. The polynomials here"
    );
    println!("are sums over tables of monomials, not generated code. ns per call:\n");
    println!("| form | {} bands |", BANDS.map(|bands| bands.to_string()).join(" | "));
    println!("|---|{}", "---|".repeat(BANDS.len()));
    let columns = BANDS.map(measure);
    for (row, name) in ROWS.iter().enumerate() {
        let cells: Vec<String> = columns
            .iter()
            .enumerate()
            .map(|(i, column)| match THESIS.get(row) {
                Some(published) => format!("{:.1} ({:.1})", column[row], published[i]),
                None => format!("{:.1}", column[row]),
            })
            .collect();
        println!("| {name} | {} |", cells.join(" | "));
    }
}

/// Median of each row of [`ROWS`].
fn measure(bands: usize) -> [f64; 8] {
    let directions: Vec<[f32; 3]> = (0..1_000)
        .map(|i| {
            let (z, angle) = (0.999 - 0.001_998 * i as f32, 2.4 * i as f32);
            let radius = (1.0 - z * z).sqrt();
            [radius * angle.cos(), radius * angle.sin(), z]
        })
        .collect();
    let (basis, polynomials) = (Basis::new(bands), Polynomials::new(bands));
    let spherical = SphericalGradients::new(bands);
    let slice = || vec![0.0_f32; count(bands)];
    let (mut y, mut a, mut b) = (slice(), slice(), slice());
    let (mut gx, mut gy, mut gz) = (slice(), slice(), slice());
    let mut times: [Vec<f64>; 8] = Default::default();
    for _ in 0..ROUNDS {
        let mut time = |row: usize, call: &mut dyn FnMut([f32; 3])| {
            let start = Instant::now();
            directions.iter().for_each(|&p| call(black_box(p)));
            times[row].push(start.elapsed().as_secs_f64() * 1e9 / directions.len() as f64);
        };
        time(0, &mut |p| polynomials.evaluate(p, black_box(&mut y)));
        time(1, &mut |p| polynomials.gradient(p, [&mut gx, &mut gy, &mut gz]));
        time(2, &mut |p| spherical.sloans_like(p, black_box(&mut y), &mut a, &mut b));
        time(3, &mut |p| spherical.direct(p, black_box(&mut y), &mut a, &mut b));
        time(4, &mut |p| to_cartesian(p, &a, &b, [&mut gx, &mut gy, &mut gz]));
        time(5, &mut |p| {
            spherical.sloans_like(p, black_box(&mut y), &mut a, &mut b);
            to_cartesian(p, &a, &b, [&mut gx, &mut gy, &mut gz]);
        });
        time(6, &mut |p| {
            spherical.direct(p, black_box(&mut y), &mut a, &mut b);
            to_cartesian(p, &a, &b, [&mut gx, &mut gy, &mut gz]);
        });
        time(7, &mut |p| {
            basis.evaluate_with_gradient(p, black_box(&mut y), [&mut gx, &mut gy, &mut gz]);
        });
    }
    times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    })
}
