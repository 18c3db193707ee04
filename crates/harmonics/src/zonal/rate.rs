//! How the scales of a cap change with the distance of the light.
//!
//! All forms take dα/dd, which is all that tells a sphere from a disk
//! ([`super::Sighting::cosine_rate`]), and give dc_l/dd, in scale per unit of length.

use super::CLOSED_FORM_BANDS;
use super::cap::{Cap, horner, next_legendre};
use crate::Real;

/// P_l(α) for l = 0 … 9 as polynomials in α², highest power first; those of odd l have one more
/// factor α.
const LEGENDRE_POLYNOMIALS: [&[f64]; CLOSED_FORM_BANDS] = [
    &[1.0],
    &[1.0],
    &[3.0 / 2.0, -1.0 / 2.0],
    &[5.0 / 2.0, -3.0 / 2.0],
    &[35.0 / 8.0, -30.0 / 8.0, 3.0 / 8.0],
    &[63.0 / 8.0, -70.0 / 8.0, 15.0 / 8.0],
    &[231.0 / 16.0, -315.0 / 16.0, 105.0 / 16.0, -5.0 / 16.0],
    &[429.0 / 16.0, -693.0 / 16.0, 315.0 / 16.0, -35.0 / 16.0],
    &[6435.0 / 128.0, -12012.0 / 128.0, 6930.0 / 128.0, -1260.0 / 128.0, 35.0 / 128.0],
    &[12155.0 / 128.0, -25740.0 / 128.0, 18018.0 / 128.0, -4620.0 / 128.0, 315.0 / 128.0],
];

/// Sloan's closed forms differentiated by hand: dc_l/dα = −2π P_l(α) as polynomials, up to
/// [`CLOSED_FORM_BANDS`] bands.
///
/// # Panics
/// With more bands than there are closed forms.
pub fn cap_rate_sloan<R: Real>(cap: Cap<R>, cosine_rate: R, rates: &mut [R]) {
    assert!(rates.len() <= CLOSED_FORM_BANDS, "closed forms end at l = 9");
    let even = -R::TAU() * cosine_rate;
    let odd = even * cap.cosine;
    let square = cap.cosine * cap.cosine;
    for (l, rate) in rates.iter_mut().enumerate() {
        let factor = if l % 2 == 0 { even } else { odd };
        *rate = match LEGENDRE_POLYNOMIALS[l] {
            [_] => factor,
            polynomial => factor * horner(polynomial, square),
        };
    }
}

/// The thesis' recurrence, 3.30 with O'_l as 3.32 writes it (−∇a sin a is ∇α).
///
/// It divides by α² − 1 what is about as small: in f32 two digits are left at r/d = 0.01, and a cap
/// with α = 1 gives no number.
pub fn cap_rate_thesis<R: Real>(cap: Cap<R>, cosine_rate: R, rates: &mut [R]) {
    let x = cap.cosine;
    let Some(first) = rates.first_mut() else { return };
    *first = -R::TAU() * cosine_rate;
    if rates.len() == 1 {
        return;
    }
    let factor = cosine_rate / (x * x - R::one());
    let (mut p0, mut p1) = (R::one(), x);
    let mut p2 = next_legendre(1, x, p1, p0);
    for (l, rate) in rates.iter_mut().enumerate().skip(1) {
        let p3 = next_legendre(l + 1, x, p2, p1);
        let (up, down) = (R::of((l + 2) as f64), R::of(l as f64));
        let difference = up * (x * p2 - p3) - down * (x * p0 - p1);
        *rate = R::of(std::f64::consts::TAU / (2 * l + 1) as f64) * factor * difference;
        (p0, p1, p2) = (p1, p2, p3);
    }
}

/// The stable form: dc_l/dd = −2π P_l(α) dα/dd for every l, the whole of thesis 3.30–3.32.
///
/// Like [`super::cap_stable`] it steps with t = 1 − α = s²/(1 + α):
/// (l + 1)(P_{l+1} − P_l) = l (P_l − P_{l−1}) − (2l + 1) t P_l.
pub fn cap_rate_stable<R: Real>(cap: Cap<R>, cosine_rate: R, rates: &mut [R]) {
    let versine = cap.versine();
    let Some(first) = rates.first_mut() else { return };
    let mut value = -R::TAU() * cosine_rate;
    *first = value;
    let mut step = R::zero();
    for (l, next) in rates.iter_mut().skip(1).enumerate() {
        let [a, b] = super::cap::LEGENDRE[l];
        let fall = versine * value;
        step = if l == 0 { -fall } else { R::of(b) * step - R::of(a) * fall };
        value += step;
        *next = value;
    }
}
