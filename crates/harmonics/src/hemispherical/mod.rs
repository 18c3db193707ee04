//! Hemispherical harmonics (HSH): Gautron et al. 2004 as in RC appendix A and thesis 2.33, with the
//! shift cos θ → 2 cos θ − 1 also where m = 0, which both papers leave out (their Gram matrix is off
//! by 0.87).
//!
//! Ours: H_lm(ω) = √2 Y_lm(ω') at the unit vector ω' = (g x, g y, 2z − 1), g = 2√(z/(1 + z)). The map
//! ω → ω' doubles areas, so the H_lm are orthonormal because the Y_lm are; values and derivatives
//! come from [`Basis`] without Legendre functions of their own, and without the 1/(x² − 1) of
//! RC appendix B at the normal.
//!
//! H_lm of m ≠ 0 vanish at the horizon like z^(|m|/2): no expansion varies along it, and the
//! derivatives of m = ±1 are unbounded there.
//!
//! z is the normal; coefficients are in the order of [`crate::index`].

mod rotation;
mod transfer;

pub use rotation::{Overlap, TiltTable};
pub use transfer::Transfer;

use crate::{Basis, Real};

/// Tables of the HSH of a number of bands.
#[derive(Clone, Debug)]
pub struct HemisphericalBasis<R> {
    basis: Basis<R>,
}

impl<R: Real> HemisphericalBasis<R> {
    /// Tables for `bands` ≥ 1 bands.
    pub fn new(bands: usize) -> Self {
        Self { basis: Basis::new(bands) }
    }

    /// Number of bands.
    pub fn bands(&self) -> usize {
        self.basis.bands()
    }

    /// Writes H_lm(direction) to `values[index(l, m)]`; `values` holds `bands²` numbers.
    ///
    /// # Panics
    /// Below the horizon, z < 0, where there is no H_lm.
    pub fn evaluate(&self, direction: [R; 3], values: &mut [R]) {
        let stretch = stretch(direction[2]);
        self.basis.evaluate(spread(direction, stretch), values);
        for value in values {
            *value *= R::SQRT_2();
        }
    }

    /// As [`Self::evaluate`], with the Cartesian components of the tangential gradient of H_lm on the
    /// unit sphere, per radian, in `gradients[axis][index(l, m)]`; finite at the normal.
    ///
    /// # Panics
    /// On the horizon and below it, z ≤ 0: the slopes of m = ±1 grow like 1/√z.
    pub fn evaluate_with_gradient(
        &self,
        direction: [R; 3],
        values: &mut [R],
        gradients: [&mut [R]; 3],
    ) {
        let [x, y, z] = direction;
        assert!(z > R::zero(), "no gradient at z = {z}");
        let stretch = stretch(z);
        let [gx, gy, gz] = gradients;
        let spread = spread(direction, stretch);
        self.basis.evaluate_with_gradient(spread, values, [&mut *gx, &mut *gy, &mut *gz]);
        // dg/dz.
        let slope = stretch / ((z + z) * (R::one() + z));
        let root = R::SQRT_2();
        for (i, value) in values.iter_mut().enumerate() {
            *value *= root;
            let rise = slope * (x * gx[i] + y * gy[i]) + gz[i] + gz[i];
            let (a, b) = (stretch * gx[i], stretch * gy[i]);
            let radial = x * a + y * b + z * rise;
            gx[i] = root * (a - radial * x);
            gy[i] = root * (b - radial * y);
            gz[i] = root * (rise - radial * z);
        }
    }
}

/// g = 2√(z/(1 + z)).
fn stretch<R: Real>(z: R) -> R {
    assert!(z >= R::zero(), "z = {z} is below the horizon");
    R::of(2.0) * (z / (R::one() + z)).sqrt()
}

/// ω'. At the normal the difference 2z − 1 is exact, at the horizon it is −1.
fn spread<R: Real>([x, y, z]: [R; 3], stretch: R) -> [R; 3] {
    [stretch * x, stretch * y, z + z - R::one()]
}
