//! Rotation by five turns about z and x (thesis 2.76), with the quarter turns about x tabulated.

use super::{Blocks, Matrix, rotate_z};
use crate::Real;

/// Tables of the quarter turn about x for a number of bands.
///
/// Q = R_z(a) R_x(−90°) R_z(b) R_x(90°) R_z(c). Half of the entries of the quarter turn are zero and
/// are not kept.
#[derive(Clone, Debug)]
pub struct Zxzxz<R> {
    bands: usize,
    /// Non-zeros (row, column, value) of the quarter turn about x.
    quarter: Vec<(u32, u32, R)>,
}

impl<R: Real> Zxzxz<R> {
    /// Tables for `bands` ≥ 1 bands, made in f64.
    pub fn new(bands: usize) -> Self {
        let mut blocks = Blocks::<f64>::new(bands);
        blocks.set([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]);
        let mut quarter = Vec::new();
        for l in 0..bands {
            let center = (l * (l + 1)) as isize;
            for m in -(l as isize)..=l as isize {
                for n in -(l as isize)..=l as isize {
                    let value = blocks.entry(l, m, n);
                    // The recurrence multiplies exact zeros: they stay exact.
                    if value != 0.0 {
                        quarter.push(((center + m) as u32, (center + n) as u32, R::of(value)));
                    }
                }
            }
        }
        Self { bands, quarter }
    }

    /// Non-zeros (row, column, value) of the quarter turn about x.
    pub(crate) fn non_zeros(&self) -> impl Iterator<Item = (usize, usize, R)> {
        self.quarter.iter().map(|&(row, column, value)| (row as usize, column as usize, value))
    }

    /// Turns a function by `matrix` in place; `scratch` holds as many numbers.
    pub fn apply(&self, matrix: Matrix<R>, coefficients: &mut [R], scratch: &mut [R]) {
        assert_eq!(scratch.len(), coefficients.len(), "scratch as long as the coefficients");
        let [a, b, c] = turns(matrix);
        rotate_z(self.bands, c, coefficients);
        scratch.fill(R::zero());
        for &(row, column, value) in &self.quarter {
            scratch[row as usize] += value * coefficients[column as usize];
        }
        rotate_z(self.bands, b, scratch);
        // The inverse of an orthogonal matrix is its transpose.
        coefficients.fill(R::zero());
        for &(row, column, value) in &self.quarter {
            coefficients[column as usize] += value * scratch[row as usize];
        }
        rotate_z(self.bands, a, coefficients);
    }
}

/// [sin, cos] of the zyz Euler angles a, b, c: R_z(a) R_y(b) R_z(c), without trigonometry.
///
/// Near the identity and near half turns about horizontal axes a is arbitrary; c is read from
/// R_z(−a) Q, so that the two always fit together. Below ε² the sine moves nothing, and the squares
/// behind it underflow soon after: there a is 0.
fn turns<R: Real>(q: Matrix<R>) -> [[R; 2]; 3] {
    let sine = (q[0][2] * q[0][2] + q[1][2] * q[1][2]).sqrt();
    let found = sine > R::epsilon() * R::epsilon();
    let [s, c] = if found { [q[1][2] / sine, q[0][2] / sine] } else { [R::zero(), R::one()] };
    let last = [c * q[1][0] - s * q[0][0], c * q[1][1] - s * q[0][1]];
    [[s, c], [sine, q[2][2]], last]
}
