//! Evaluation at many directions: structure of arrays in, SIMD over directions, blocks out.
//!
//! Directions come in blocks of [`lanes`] (one cache line of each component); so do results. With
//! `b = bands²` coefficients, lane k of block j is direction `j lanes + k`, and
//! - values stand at `[(j b + index(l, m)) lanes + k]`,
//! - values with gradients at `[((j b + index(l, m)) 4 + c) lanes + k]`, c = 0 for the value and 1, 2, 3
//!   for its derivative along x, y, z.
//!
//! So a block is written once, from front to back of memory, in whole cache lines. Lanes past the last
//! direction hold the direction +z.
//!
//! # Cost
//! A pair (l, ±m) takes 9 vector instructions for values and 20 with gradients (a fused multiply-add is
//! one), 2 and 8 stores. Batches of 100 000 directions were written at 50 to 77 % of the rate at which
//! the same memory is filled with a constant (`results/sh-speed/sphericart.md`, which has the times).

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch};

use crate::lanes::{Lanes, Vectors};
use crate::recurrence::{harmonics, harmonics_by_band};
use crate::{Basis, MAX_BANDS, count};

/// Directions in a block: those of one 64-byte cache line, 16 in f32 and 8 in f64.
pub const fn lanes<R>() -> usize {
    64 / size_of::<R>()
}

/// Length of the values of `directions` directions in `bands` bands.
pub const fn values_length<R>(bands: usize, directions: usize) -> usize {
    directions.div_ceil(lanes::<R>()) * lanes::<R>() * count(bands)
}

/// Length of the values with gradients of `directions` directions in `bands` bands.
pub const fn gradients_length<R>(bands: usize, directions: usize) -> usize {
    4 * values_length::<R>(bands, directions)
}

/// Bytes of output from which on evaluation goes band by band. In cache, order by order is faster; in main
/// memory, writing in the order of memory is.
const OUT_OF_CACHE: usize = 8 << 20;

/// Bands from which on that is so.
const BY_BAND: usize = 8;

impl<R: Vectors> Basis<R> {
    /// Y_lm at unit directions given by their components; `values` holds [`values_length`] numbers.
    pub fn evaluate_batch(&self, directions: [&[R]; 3], values: &mut [R]) {
        self.batch::<false>(directions, values, false);
    }

    /// Y_lm and the gradient of Y_lm(p/|p|) at unit directions p; `output` holds
    /// [`gradients_length`] numbers.
    pub fn evaluate_batch_with_gradients(&self, directions: [&[R]; 3], output: &mut [R]) {
        self.batch::<true>(directions, output, false);
    }

    /// Like [`Self::evaluate_batch_with_gradients`] at the directions of points ≠ 0, with gradients per
    /// displacement of the point: ∇_p Y_lm(p/|p|).
    ///
    /// Points are 1e-18 to 1e18 long (1e-150 to 1e150 in f64), which nothing checks: the square of
    /// another length over- or underflows, and what is written for it is wrong or not finite.
    pub fn evaluate_batch_with_gradients_at(&self, points: [&[R]; 3], output: &mut [R]) {
        self.batch::<true>(points, output, true);
    }

    fn batch<const GRADIENT: bool>(&self, points: [&[R]; 3], output: &mut [R], normalise: bool) {
        let directions = points[0].len();
        assert!(points.iter().all(|axis| axis.len() == directions), "equal x, y and z");
        let length = values_length::<R>(self.bands(), directions) * if GRADIENT { 4 } else { 1 };
        assert_eq!(output.len(), length, "one row per coefficient and component");
        dispatch!(Level::new(), simd => blocks::<R, _, GRADIENT>(simd, self, points, output, normalise));
    }
}

#[inline(always)]
fn blocks<R: Vectors, S: Simd, const GRADIENT: bool>(
    simd: S,
    basis: &Basis<R>,
    points: [&[R]; 3],
    output: &mut [R],
    normalise: bool,
) {
    let lanes = const { lanes::<R>() };
    let rows = if GRADIENT { 4 } else { 1 };
    let stride = rows * lanes;
    let by_band =
        size_of_val(output) >= OUT_OF_CACHE && (BY_BAND..=MAX_BANDS).contains(&basis.bands());
    for (j, block) in output.chunks_exact_mut(count(basis.bands()) * stride).enumerate() {
        let mut padded = [[R::zero(); 16], [R::zero(); 16], [R::one(); 16]];
        for (to, from) in padded.iter_mut().zip(points) {
            let from = &from[j * lanes..];
            let length = from.len().min(lanes);
            to[..length].copy_from_slice(&from[..length]);
        }
        for at in (0..lanes).step_by(R::Vector::<S>::LEN) {
            let end = at + R::Vector::<S>::LEN;
            let load = |axis: usize| R::Vector::<S>::from_slice(simd, &padded[axis][at..end]);
            let mut direction = [Lanes::new(load(0)), Lanes::new(load(1)), Lanes::new(load(2))];
            let mut scale = Lanes::new(R::Vector::<S>::splat(simd, R::one()));
            if normalise {
                scale = Lanes::inverse_length(direction);
                direction = [direction[0] * scale, direction[1] * scale, direction[2] * scale];
            }
            macro_rules! write {
                ($form:ident) => {
                    $form::<R, _, GRADIENT>(
                        basis.recurrence(),
                        direction,
                        scale,
                        #[inline(always)]
                        |lm, results| {
                            let row = &mut block[lm * stride..(lm + 1) * stride];
                            for component in 0..rows {
                                results[component].store(&mut row[component * lanes..][at..end]);
                            }
                        },
                    )
                };
            }
            if by_band {
                write!(harmonics_by_band);
            } else {
                write!(harmonics);
            }
        }
    }
}
