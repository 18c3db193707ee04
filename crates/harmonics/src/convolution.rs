//! Convolution with a circular kernel (thesis 2.64).

use crate::Real;

/// Convolves a function with a zonal kernel of scales c_l = √(4π/(2l+1)) G̃_l, in place: every
/// coefficient of band l times c_l.
///
/// `kernel` holds one scale a band, `coefficients` bands² numbers. Zonal by zonal needs no more than
/// the products of the scales. The weights of a [`crate::window::Window`] are such a kernel too.
pub fn convolve<R: Real>(kernel: &[R], coefficients: &mut [R]) {
    assert_eq!(coefficients.len(), kernel.len() * kernel.len(), "bands² coefficients");
    let mut rest = coefficients;
    for (l, &scale) in kernel.iter().enumerate() {
        let (band, tail) = rest.split_at_mut(2 * l + 1);
        band.iter_mut().for_each(|value| *value *= scale);
        rest = tail;
    }
}
