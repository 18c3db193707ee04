//! Zonal functions: caps, what spherical lights and oriented disks send to a point, and sums in
//! O(n) where two zonal functions meet.
//!
//! A zonal function is kept as its *scales* c_l = √(4π/(2l+1)) L̃_l (L̃_l its coefficient of Y_l0,
//! thesis 2.54), because the rotation (thesis 2.73, 3.11), the convolution (2.64) and the dot
//! product (5.14) all need just c_l: about the direction ω its coefficients are c_l Y_lm(ω). The
//! constants of the thesis' 3.10 fold into one factor a band all the same.
//!
//! Every cap form has the signature `(cap, scales)`, every derivative `(cap, rate, rates)`; the
//! length of the slice is the number of bands. At most [`crate::MAX_BANDS`] bands: the tables of
//! constants end there or shortly after, and more panic. [`cap_stable`] and [`cap_rate_stable`] are the ones
//! to use; the papers' forms are here to be compared with and lose their digits in f32.

mod cap;
mod light;
mod rate;
mod series;
mod triangle;

pub use cap::{CLOSED_FORM_BANDS, Cap, cap_sloan, cap_stable, cap_thesis};
pub use light::{Sighting, light_gradient};
pub use rate::{cap_rate_sloan, cap_rate_stable, cap_rate_thesis};
pub use series::{dot, evaluate, from_coefficients};
pub use triangle::{TriangleForm, TriangleSighting};

use crate::{Basis, Real, convolution};

/// Coefficients c_l Y_lm(`direction`) of a zonal function about a unit direction (thesis 2.73).
///
/// `scales` holds one c_l a band of `basis`, `coefficients` bands² numbers.
pub fn rotate<R: Real>(basis: &Basis<R>, scales: &[R], direction: [R; 3], coefficients: &mut [R]) {
    basis.evaluate(direction, coefficients);
    convolution::convolve(scales, coefficients);
}
