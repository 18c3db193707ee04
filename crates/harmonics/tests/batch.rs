//! Batches against directions one by one, and long ones against short ones.

use crate::common::{evaluate, limits};
use manylights_harmonics::batch::{gradients_length, lanes, values_length};
use manylights_harmonics::{Basis, MAX_BANDS, Real, Vectors, count};

/// The worst difference of a batch and its directions one by one, relative to the band's maximum and to
/// the rounding error of one number.
fn batch_against_single<R: Vectors>() -> f64 {
    let points: Vec<[R; 3]> = (0..37)
        .map(|i| [(i * 7 % 11) as f64 - 5.0, (i * 5 % 13) as f64 - 6.0, (i * 3 % 7) as f64 - 2.5])
        .map(|p| p.map(|c| R::of(c / p.iter().map(|c| c * c).sum::<f64>().sqrt())))
        .collect();
    let axes = [0, 1, 2].map(|axis| points.iter().map(|p| p[axis]).collect::<Vec<R>>());
    let mut worst = 0.0_f64;
    for bands in 1..=MAX_BANDS {
        let basis = Basis::<R>::new(bands);
        let mut output = vec![R::nan(); gradients_length::<R>(bands, points.len())];
        basis.evaluate_batch_with_gradients([&axes[0], &axes[1], &axes[2]], &mut output);
        assert!(output.iter().all(|value| value.is_finite()));
        for (i, &point) in points.iter().enumerate() {
            for (lm, single) in evaluate(&basis, point).into_iter().enumerate() {
                let row = (i / lanes::<R>() * count(bands) + lm) * 4;
                for (c, limit) in limits(lm.isqrt()).into_iter().enumerate() {
                    let found = output[(row + c) * lanes::<R>() + i % lanes::<R>()];
                    let error = (Real::to_f64(found) - single[c]).abs();
                    if error > 0.0 {
                        worst = worst.max(error / limit);
                    }
                }
            }
        }
    }
    worst / R::epsilon().to_f64()
}

#[test]
fn batch_is_single_in_both_precisions() {
    // Fused and unfused rounding differ; 3 are seen, which is 4e-7 in f32.
    assert!(batch_against_single::<f64>() < 6.0);
    assert!(batch_against_single::<f32>() < 6.0);
}

/// A point's batch is that of its direction, which rounding moves by ε: band l by l(l + 1)/2 of that.
fn batch_at_points_is_that_of_directions<R: Vectors>() {
    let scales = [1e-18, 1e-6, 0.3, 1.0, 250.0, 1e9, 1e18];
    let z = vec![R::of(0.8); scales.len()];
    let axes = [0.36, 0.48, 0.8].map(|c| scales.map(|scale| R::of(c * scale)));
    let basis = Basis::<R>::new(MAX_BANDS);
    let unit = [0.36, 0.48].map(|c| vec![R::of(c); scales.len()]);
    let mut truth = vec![R::nan(); gradients_length::<R>(MAX_BANDS, scales.len())];
    let mut found = truth.clone();
    basis.evaluate_batch_with_gradients([&unit[0], &unit[1], &z], &mut truth);
    basis.evaluate_batch_with_gradients_at([&axes[0], &axes[1], &axes[2]], &mut found);
    for (row, (found, truth)) in
        found.chunks(lanes::<R>()).zip(truth.chunks(lanes::<R>())).enumerate()
    {
        let l = (row / 4 % count(MAX_BANDS)).isqrt();
        let limit = limits(l)[row % 4] * (2 + l * (l + 1)) as f64 * R::epsilon().to_f64();
        for ((found, truth), scale) in found.iter().zip(truth).zip(scales) {
            let found = Real::to_f64(*found) * if row % 4 == 0 { 1.0 } else { scale };
            let error = (found - Real::to_f64(*truth)).abs();
            assert!(error <= 2.0 * limit, "row {row}, at {scale}: {error} of {limit}");
        }
    }
}

#[test]
fn batches_at_points_hold_in_both_precisions() {
    batch_at_points_is_that_of_directions::<f64>();
    batch_at_points_is_that_of_directions::<f32>();
}

#[test]
fn batch_values_are_those_with_gradients() {
    let direction = [[0.6_f32, 0.0], [0.0, 0.0], [0.8, -1.0]];
    for bands in 1..=MAX_BANDS {
        let basis = Basis::<f32>::new(bands);
        let axes = [&direction[0][..], &direction[1], &direction[2]];
        let mut values = vec![0.0; values_length::<f32>(bands, 2)];
        let mut output = vec![0.0; gradients_length::<f32>(bands, 2)];
        basis.evaluate_batch(axes, &mut values);
        basis.evaluate_batch_with_gradients(axes, &mut output);
        for (row, both) in values.chunks(lanes::<f32>()).zip(output.chunks(4 * lanes::<f32>())) {
            assert_eq!(row, &both[..lanes::<f32>()]);
        }
    }
}

#[test]
fn long_batches_are_short_ones() {
    let basis = Basis::<f32>::new(MAX_BANDS);
    let angles = || (0..4_096).map(|i| i as f32 * 0.01);
    let x: Vec<f32> = angles().map(|angle| 0.8 * angle.cos()).collect();
    let y: Vec<f32> = angles().map(|angle| 0.8 * angle.sin()).collect();
    let z = vec![0.6; x.len()];
    let mut long = vec![0.0; gradients_length::<f32>(MAX_BANDS, x.len())];
    basis.evaluate_batch_with_gradients([&x, &y, &z], &mut long);
    let block = lanes::<f32>();
    let mut short = vec![0.0; gradients_length::<f32>(MAX_BANDS, block)];
    let blocks = x.chunks(block).zip(y.chunks(block)).zip(z.chunks(block));
    for (long, ((x, y), z)) in long.chunks(short.len()).zip(blocks) {
        basis.evaluate_batch_with_gradients([x, y, z], &mut short);
        assert_eq!(long, short);
    }
}
