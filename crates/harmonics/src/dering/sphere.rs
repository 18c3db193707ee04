//! Functions on the sphere, by a grid of directions and descent from its minima.

use super::weakest;
use crate::convolution::convolve;
use crate::window::Window;
use crate::{Basis, Real, count};

/// Steps of a descent. Barzilai and Borwein's converge superlinearly in two dimensions.
const DESCENT_STEPS: usize = 24;

/// Rows of the grid a band.
const ROWS_PER_BAND: usize = 4;

/// Search over functions of a number of bands.
///
/// The grid has T = 4 bands rows and 2T columns, so every direction is within δ = π/(√2 T) of a grid
/// direction. Along a great circle the function is a trigonometric polynomial of degree L = bands − 1;
/// by Bernstein's inequality its second derivative is at most L² A, with A half its range. From a
/// minimum to the grid it therefore rises by at most δ² L² A/2 < 0.16 A, and only grid minima that
/// lie so close to the limit need a descent.
#[derive(Clone, Debug)]
pub struct Sphere<R> {
    basis: Basis<R>,
    /// Σ_m f_lm Y_lm of every band at every grid direction, bands numbers a direction.
    band_sums: Vec<R>,
    /// The function under the window at hand, at every grid direction.
    grid: Vec<R>,
    /// Its coefficients.
    damped: Vec<R>,
    values: Vec<R>,
    gradients: [Vec<R>; 3],
}

impl<R: Real> Sphere<R> {
    /// Room for `bands` ≥ 1 bands: 32 bands² (bands + 1) numbers.
    pub fn new(bands: usize) -> Self {
        let directions = 2 * (ROWS_PER_BAND * bands).pow(2);
        let slice = || vec![R::zero(); count(bands)];
        Self {
            basis: Basis::new(bands),
            band_sums: vec![R::zero(); directions * bands],
            grid: vec![R::zero(); directions],
            damped: slice(),
            values: slice(),
            gradients: [slice(), slice(), slice()],
        }
    }

    /// Like [`super::Profile::search`] for a function of bands² `coefficients`.
    pub fn search(
        &mut self,
        window: Window,
        coefficients: &[R],
        tolerance: R,
        weights: &mut [R],
    ) -> Option<R> {
        assert_eq!(coefficients.len(), self.damped.len(), "bands² coefficients");
        assert_eq!(weights.len(), self.basis.bands(), "one weight a band");
        self.fill_band_sums(coefficients);
        weakest(window, weights, |weights| {
            self.damped.copy_from_slice(coefficients);
            convolve(weights, &mut self.damped);
            self.falls_below(weights, -tolerance)
        })
    }

    fn rows(&self) -> usize {
        ROWS_PER_BAND * self.basis.bands()
    }

    /// Grid direction `i`, row by row, rows half a step off the poles.
    fn direction(&self, i: usize) -> [R; 3] {
        let (rows, columns) = (self.rows(), 2 * self.rows());
        let step = R::PI() / R::of(rows as f64);
        let (sine, z) = (step * R::of((i / columns) as f64 + 0.5)).sin_cos();
        let (s, c) = (step * R::of((i % columns) as f64)).sin_cos();
        [sine * c, sine * s, z]
    }

    fn fill_band_sums(&mut self, coefficients: &[R]) {
        let bands = self.basis.bands();
        for i in 0..self.grid.len() {
            self.basis.evaluate(self.direction(i), &mut self.values);
            for l in 0..bands {
                let band = count(l)..count(l + 1);
                let terms = coefficients[band.clone()].iter().zip(&self.values[band]);
                self.band_sums[i * bands + l] = terms.map(|(&f, &y)| f * y).sum();
            }
        }
    }

    /// Whether the damped function does. What is not finite counts as below.
    fn falls_below(&mut self, weights: &[R], limit: R) -> bool {
        let bands = self.basis.bands();
        let (mut low, mut high) = (R::infinity(), R::neg_infinity());
        for (value, sums) in self.grid.iter_mut().zip(self.band_sums.chunks_exact(bands)) {
            *value = sums.iter().zip(weights).map(|(&sum, &weight)| sum * weight).sum();
            if !value.is_finite() || *value < limit {
                return true;
            }
            (low, high) = (low.min(*value), high.max(*value));
        }
        let reach = std::f64::consts::PI / (2.0_f64.sqrt() * self.rows() as f64);
        let degree = (bands - 1) as f64;
        let rise = 0.5 * (reach * degree).powi(2);
        // The grid may miss as much of the maximum as of the minimum.
        let amplitude = R::of(0.5) * (high - low) / R::of(1.0 - rise);
        let slack = R::of(rise) * amplitude;
        let curvature = R::of(degree * degree) * amplitude;
        (0..self.grid.len()).any(|i| {
            self.grid[i] - slack < limit
                && self.is_grid_minimum(i)
                && self.descends_below(self.direction(i), limit, curvature, R::of(reach))
        })
    }

    /// Whether no neighbour of grid direction `i` is lower. Beyond a pole lies the same row, half a
    /// turn further.
    fn is_grid_minimum(&self, i: usize) -> bool {
        let (rows, columns) = (self.rows(), 2 * self.rows());
        let (row, column) = (i / columns, i % columns);
        let above = if row == 0 { (0, rows) } else { (row - 1, 0) };
        let below = if row + 1 == rows { (row, rows) } else { (row + 1, 0) };
        [(row, 0), above, below].into_iter().all(|(row, turn)| {
            [columns - 1, 0, 1].into_iter().all(|shift| {
                let neighbour = row * columns + (column + turn + shift) % columns;
                self.grid[i] <= self.grid[neighbour]
            })
        })
    }

    /// Whether descent from a direction falls below the limit: Barzilai and Borwein's step lengths
    /// ("Two-Point Step Size Gradient Methods", 1988), at least the safe 1/curvature, no further than
    /// `reach` a step.
    fn descends_below(&mut self, start: [R; 3], limit: R, curvature: R, reach: R) -> bool {
        let dot = |a: [R; 3], b: [R; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let mut direction = start;
        let (_, mut gradient) = self.value_and_gradient(direction);
        let mut step = curvature.recip();
        for _ in 0..DESCENT_STEPS {
            let moved = [0, 1, 2].map(|axis| direction[axis] - step * gradient[axis]);
            let length = dot(moved, moved).sqrt();
            let next = moved.map(|component| component / length);
            let (value, next_gradient) = self.value_and_gradient(next);
            if !value.is_finite() || value < limit {
                return true;
            }
            let shift = [0, 1, 2].map(|axis| next[axis] - direction[axis]);
            let change = [0, 1, 2].map(|axis| next_gradient[axis] - gradient[axis]);
            let slope = dot(next_gradient, next_gradient).sqrt();
            if slope <= R::epsilon() * curvature {
                return false;
            }
            let quotient = dot(shift, shift) / dot(shift, change);
            step = if quotient > curvature.recip() { quotient } else { curvature.recip() };
            step = step.min(reach / slope);
            (direction, gradient) = (next, next_gradient);
        }
        false
    }

    fn value_and_gradient(&mut self, direction: [R; 3]) -> (R, [R; 3]) {
        let slices = self.gradients.each_mut().map(|axis| axis.as_mut_slice());
        self.basis.evaluate_with_gradient(direction, &mut self.values, slices);
        let sum = |terms: &[R]| terms.iter().zip(&self.damped).map(|(&y, &f)| y * f).sum();
        (sum(&self.values), self.gradients.each_ref().map(|axis| sum(axis)))
    }
}
