//! The forms that the thesis compares in table 3.1, to be compared with [`crate::Basis`]. Use that one:
//! it is faster, and these divide by sin θ (not finite at the poles) or lose digits. The two of a triangle's
//! solid angle (4.12, 4.13) are to be compared with [`crate::polygon::solid_angle`].
//!
//! Slips found: equation 3.12 has no Condon–Shortley phase, but 3.14, 3.18 and 3.21–3.25 carry it
//! ((1 − 2m) and T = +P_l^1). Without the phase, as here, 3.18 changes its sign and 3.14 starts from
//! (2m − 1) Q_{m−1}^{m−1}. 3.15, 3.16 and 3.19–3.21 agree with differences as printed.

mod polynomial;
mod solid_angle;
mod spherical;

pub use polynomial::{POLYNOMIAL_BANDS, Polynomials};
pub(crate) use polynomial::{binomial, zonal_part};
pub use solid_angle::{arvo, oosterom_of_units};
pub use spherical::{SphericalGradients, to_cartesian};
