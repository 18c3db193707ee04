//! Values and gradients of the basis by the normalised solid-harmonic recurrence: no poles, no
//! trigonometry, no normalisation roots at run time.
//!
//! On the unit sphere Y_lm = Q_l^m(z) U_m and Y_l,−m = Q_l^m(z) V_m with U_m + iV_m = (x + iy)^m and
//! Q_l^m = √2 K_l^m dᵐP_l/dzᵐ (√2 for m > 0 only). The normalisation is folded into the recurrence
//! (Sloan 2013, "Efficient Spherical Harmonic Evaluation"): unnormalised, f32 is noise near l = 16.
//! Deviation from Sloan: Q and dQ/dz advance together (`recurrence.rs` says why).
//!
//! # Gradient
//! With D = dQ/dz the gradient of Y(p/|p|) at |p| = 1, which is tangential, is
//! ∂x = m Q U_{m−1} + x E U_m, ∂y = −m Q V_{m−1} + y E U_m, ∂z = (D + z E) U_m for m ≥ 0 and, for −m,
//! ∂x = m Q V_{m−1} + x E V_m, ∂y = m Q U_{m−1} + y E V_m, ∂z = (D + z E) V_m, where E = −(m Q + z D).
//! Nothing is divided by sin θ, so there are no poles (thesis 3.15 and 3.20 have them).
//!
//! # Conditioning
//! What is computed is the polynomial above at the components as given. A component off by δ moves
//! it by up to l(l + 1)/2 δ of the band's maximum (at the pole): directions rounded to f32 do not
//! determine band 29 better than 3e-5 there.

use crate::Real;
use crate::recurrence::{Recurrence, harmonics};

/// Tables of the recurrences for a number of bands.
#[derive(Clone, Debug)]
pub struct Basis<R> {
    recurrence: Recurrence<R>,
}

impl<R: Real> Basis<R> {
    /// Tables for `bands` ≥ 1 bands.
    pub fn new(bands: usize) -> Self {
        Self { recurrence: Recurrence::new(bands) }
    }

    /// Number of bands.
    pub fn bands(&self) -> usize {
        self.recurrence.bands
    }

    pub(crate) fn recurrence(&self) -> &Recurrence<R> {
        &self.recurrence
    }

    /// Writes Y_lm(direction) to `values[index(l, m)]`; `values` holds `bands²` numbers.
    pub fn evaluate(&self, direction: [R; 3], values: &mut [R]) {
        let n = self.bands();
        assert_eq!(values.len(), n * n, "bands² values");
        harmonics::<R, R, false>(&self.recurrence, direction, R::one(), |at, [value, ..]| {
            values[at] = value;
        });
    }

    /// Writes Y_lm(direction) to `values[index(l, m)]` and the Cartesian components of the gradient of
    /// Y_lm(p/|p|) at p = `direction` (a unit vector) to `gradients[axis][index(l, m)]`: tangential,
    /// per radian. Each slice holds `bands²` numbers.
    pub fn evaluate_with_gradient(
        &self,
        direction: [R; 3],
        values: &mut [R],
        gradients: [&mut [R]; 3],
    ) {
        self.write_with_gradient(direction, R::one(), values, gradients);
    }

    /// Like [`Self::evaluate_with_gradient`] at the direction of `point` ≠ 0, with the gradient per
    /// displacement of the point: ∇_p Y_lm(p/|p|), which is the gradient on the sphere over |p|.
    ///
    /// # Panics
    /// Where the square of |p| over- or underflows or is not a number. Lengths of 1e-18 to 1e18 are
    /// safe (1e-150 to 1e150 in f64).
    pub fn evaluate_with_gradient_at(
        &self,
        point: [R; 3],
        values: &mut [R],
        gradients: [&mut [R]; 3],
    ) {
        let [x, y, z] = point;
        let square = x * x + y * y + z * z;
        // A subnormal square has lost digits of the length.
        assert!(square.is_normal(), "a point with a direction, not {point:?}");
        let inverse = square.sqrt().recip();
        let direction = point.map(|component| component * inverse);
        self.write_with_gradient(direction, inverse, values, gradients);
    }

    fn write_with_gradient(
        &self,
        direction: [R; 3],
        scale: R,
        values: &mut [R],
        [gx, gy, gz]: [&mut [R]; 3],
    ) {
        let count = crate::count(self.bands());
        for slice in [&*values, gx, gy, gz] {
            assert_eq!(slice.len(), count, "bands² numbers");
        }
        harmonics::<R, R, true>(&self.recurrence, direction, scale, |at, [value, x, y, z]| {
            values[at] = value;
            (gx[at], gy[at], gz[at]) = (x, y, z);
        });
    }
}
