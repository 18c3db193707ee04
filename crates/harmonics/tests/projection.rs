//! Projections of functions that are known.

use manylights_harmonics::projection::{Filter, LeastSquares, fibonacci, scalar_product};
use manylights_harmonics::quadrature::sphere_nodes;
use manylights_harmonics::{Basis, count};
use proptest::prelude::*;

const WHOLE: [f64; 2] = [-1.0, 1.0];

fn expand(basis: &Basis<f64>, coefficients: &[f64], direction: [f64; 3]) -> f64 {
    let mut values = vec![0.0; coefficients.len()];
    basis.evaluate(direction, &mut values);
    values.iter().zip(coefficients).map(|(y, c)| y * c).sum()
}

fn worst(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn expansion() -> impl Strategy<Value = (usize, Vec<f64>)> {
    (1..=10_usize)
        .prop_flat_map(|bands| (Just(bands), prop::collection::vec(-1.0..1.0, count(bands))))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn an_expansion_comes_back((bands, given) in expansion()) {
        let basis = Basis::new(bands);
        let mut result = vec![0.0; count(bands)];
        let f = |d| expand(&basis, &given, d);
        let evaluate = |d, values: &mut [f64]| basis.evaluate(d, values);
        let mut scratch = result.clone();
        scalar_product(sphere_nodes(bands, WHOLE), evaluate, f, &mut scratch, &mut result);
        let error = worst(&result, &given);
        prop_assert!(error < 1e-12, "{error:e}");

        // Twice as many samples as coefficients: condition below 2.
        let nodes: Vec<_> = fibonacci(2 * count(bands) + 8, WHOLE).map(|(d, _)| d).collect();
        let samples: Vec<_> = nodes.iter().map(|&d| f(d)).collect();
        let fit = LeastSquares::new(&basis, &nodes);
        prop_assert!(fit.condition() < 2.0);
        fit.fit(&samples, Filter::Truncated(0.0), &mut result);
        let error = worst(&result, &given);
        prop_assert!(error < 1e-12, "{error:e}");
    }
}

#[test]
fn fibonacci_points_cover_their_part_evenly() {
    for range in [WHOLE, [0.0, 1.0]] {
        let area = std::f64::consts::TAU * (range[1] - range[0]);
        let total: f64 = fibonacci(1000, range).map(|(_, w): ([f64; 3], f64)| w).sum();
        assert!((total - area).abs() < 1e-12 * area);
        // ∫ z² of the sphere is 4π/3; of the half sphere half of it.
        let second: f64 =
            fibonacci(1000, range).map(|([_, _, z], w): ([f64; 3], f64)| w * z * z).sum();
        assert!((second - area / 3.0).abs() < 1e-5, "{second}");
        let across: f64 = fibonacci(1000, range).map(|([x, _, _], w): ([f64; 3], f64)| w * x).sum();
        assert!(across.abs() < 1e-2, "{across}");
    }
}

#[test]
#[should_panic(expected = "at least one sample")]
fn a_fit_to_nothing_panics() {
    LeastSquares::new(&Basis::<f64>::new(2), &[]);
}

fn condition(bands: usize, samples: usize) -> f64 {
    let nodes: Vec<_> = fibonacci(samples, WHOLE).map(|(d, _)| d).collect();
    LeastSquares::new(&Basis::new(bands), &nodes).condition()
}

/// Thesis figure 5.18: worst at M = N, though far from the "huge" of the thesis.
#[test]
fn the_condition_is_worst_where_samples_equal_coefficients() {
    let n = count(8);
    let (at, far, below) = (condition(8, n), condition(8, 2 * n), condition(8, n / 2));
    println!("M = N: {at:.1e}, 2N: {far:.2}, N/2: {below:.2}");
    assert!(at > 3.0 * far && at > 3.0 * below);
}

/// Samples of the upper part of the sphere only leave combinations unseen. A filter keeps noise from
/// being multiplied by the condition number.
#[test]
fn filters_tame_what_the_samples_do_not_see() {
    let (bands, size) = (6, 200);
    let basis = Basis::new(bands);
    let nodes: Vec<_> = fibonacci(size, [0.2, 1.0]).map(|(d, _)| d).collect();
    let fit = LeastSquares::new(&basis, &nodes);
    let noise: Vec<_> = (0..size).map(|i| 1e-3 * (7.3 * i as f64 * i as f64).sin()).collect();
    let norm = |filter| {
        let mut result = vec![0.0; count(bands)];
        fit.fit(&noise, filter, &mut result);
        result.iter().map(|c| c * c).sum::<f64>().sqrt()
    };
    let plain = norm(Filter::Truncated(0.0));
    let (truncated, tikhonov) = (norm(Filter::Truncated(0.05)), norm(Filter::Tikhonov(0.05)));
    println!("condition {:.1e}", fit.condition());
    println!("plain {plain:.1e}, truncated {truncated:.1e}, Tikhonov {tikhonov:.1e}");
    assert!(truncated < 0.1 * plain && tikhonov < 0.1 * plain);
}
