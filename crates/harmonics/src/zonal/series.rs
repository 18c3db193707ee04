//! Sums over bands in O(n).

use super::cap::next_legendre;
use crate::Real;

/// Scales c_l = √(4π/(2l+1)) L̃_l from coefficients of Y_l0 (thesis 2.54), in place.
pub fn from_coefficients<R: Real>(coefficients: &mut [R]) {
    for (l, value) in coefficients.iter_mut().enumerate() {
        *value *= R::of((4.0 * std::f64::consts::PI / (2 * l + 1) as f64).sqrt());
    }
}

/// The value Σ_l (2l + 1)/4π c_l P_l(cosine) of a zonal function at this cosine from its axis.
pub fn evaluate<R: Real>(scales: &[R], cosine: R) -> R {
    sum(cosine, scales.iter().copied())
}

/// ∫ f g dω of two zonal functions whose axes meet at this cosine, in O(n) (thesis 5.14):
/// Σ_l (2l + 1)/4π f_l g_l P_l(cosine), their convolution evaluated at the angle.
pub fn dot<R: Real>(f: &[R], g: &[R], cosine: R) -> R {
    assert_eq!(f.len(), g.len(), "two functions of as many bands");
    sum(cosine, f.iter().zip(g).map(|(&f, &g)| f * g))
}

/// Σ_l (2l + 1)/4π c_l P_l(x), the addition theorem's sum.
fn sum<R: Real>(x: R, scales: impl Iterator<Item = R>) -> R {
    let (mut before, mut legendre) = (R::zero(), R::one());
    let mut total = R::zero();
    for (l, scale) in scales.enumerate() {
        let weight = R::of((2 * l + 1) as f64 / (4.0 * std::f64::consts::PI));
        total += weight * scale * legendre;
        let after = if l == 0 { x } else { next_legendre(l, x, legendre, before) };
        (before, legendre) = (legendre, after);
    }
    total
}
