//! A spherical cap of radiance one, in the papers' forms and in one that keeps its digits in f32.

use crate::{MAX_BANDS, Real};

/// Bands that [`cap_sloan`] and [`super::cap_rate_sloan`] have closed forms for.
pub const CLOSED_FORM_BANDS: usize = 10;

/// A spherical cap of half-angle a ≤ π/2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cap<R> {
    /// sin a, in 0 … 1.
    pub sine: R,
    /// α = cos a, in 0 … 1.
    pub cosine: R,
}

impl<R: Real> Cap<R> {
    /// The cap of a sphere seen from `distance` to its centre (thesis 3.27: sin a = r/d), in any
    /// one unit of length. From inside or from the surface (d ≤ r) it is the whole hemisphere about
    /// the centre, which is also the limit d → r⁺.
    pub fn of_sphere(radius: R, distance: R) -> Self {
        if distance <= radius {
            return Self { sine: R::one(), cosine: R::zero() };
        }
        // The product keeps the digits of a grazing view, which 1 − (r/d)² loses.
        let cosine = ((distance - radius) * (distance + radius)).sqrt() / distance;
        Self { sine: radius / distance, cosine }
    }

    /// The cap of a disk that always faces the point (thesis 3.29: tan a = r/d).
    pub fn of_disk(radius: R, distance: R) -> Self {
        let slant = (radius * radius + distance * distance).sqrt();
        Self { sine: radius / slant, cosine: distance / slant }
    }

    /// 1 − cos a without cancellation.
    pub fn versine(self) -> R {
        self.sine * self.sine / (R::one() + self.cosine)
    }
}

/// c_l / ((1 − α²) π) = 2 P'_l(α) / (l (l + 1)) for l = 1 … 9 as polynomials in α², highest power
/// first; those of even l have one more factor α.
const CLOSED_FORMS: [&[f64]; CLOSED_FORM_BANDS - 1] = [
    &[1.0],
    &[1.0],
    &[5.0 / 4.0, -1.0 / 4.0],
    &[7.0 / 4.0, -3.0 / 4.0],
    &[21.0 / 8.0, -14.0 / 8.0, 1.0 / 8.0],
    &[33.0 / 8.0, -30.0 / 8.0, 5.0 / 8.0],
    &[429.0 / 64.0, -495.0 / 64.0, 135.0 / 64.0, -5.0 / 64.0],
    &[715.0 / 64.0, -1001.0 / 64.0, 385.0 / 64.0, -35.0 / 64.0],
    &[2431.0 / 128.0, -4004.0 / 128.0, 2002.0 / 128.0, -308.0 / 128.0, 7.0 / 128.0],
];

/// Closed forms of up to [`CLOSED_FORM_BANDS`] bands: Sloan 2008 ("Stupid Spherical Harmonics
/// Tricks", light sources); the polynomials beyond his six bands are ours.
///
/// Deviation: Horner's rule, and the factors that bands share are computed once. The factor 1 − α²
/// is a difference as printed, so in f32 small caps lose their digits in every band but l = 1.
///
/// # Panics
/// With more bands than there are closed forms.
pub fn cap_sloan<R: Real>(cap: Cap<R>, scales: &mut [R]) {
    assert!(scales.len() <= CLOSED_FORM_BANDS, "closed forms end at l = 9");
    let cosine = cap.cosine;
    let pi = R::PI();
    let Some(first) = scales.first_mut() else { return };
    *first = R::TAU() * (R::one() - cosine);
    if scales.len() > 1 {
        scales[1] = pi * (cap.sine * cap.sine);
    }
    if scales.len() > 2 {
        let odd = pi * ((R::one() - cosine) * (R::one() + cosine));
        let even = odd * cosine;
        scales[2] = even;
        if scales.len() > 3 {
            let square = cosine * cosine;
            for (l, scale) in scales.iter_mut().enumerate().skip(3) {
                let factor = if l % 2 == 0 { even } else { odd };
                *scale = factor * horner(CLOSED_FORMS[l - 1], square);
            }
        }
    }
}

/// The polynomial with these coefficients, highest power first.
pub(super) fn horner<R: Real>(coefficients: &[f64], x: R) -> R {
    let (first, rest) = coefficients.split_first().expect("a polynomial has a coefficient");
    rest.iter().fold(R::of(*first), |sum, &c| sum * x + R::of(c))
}

/// The thesis' recurrence: 3.10 through 3.11, c_l = 2π/(2l + 1) (P_{l−1}(α) − P_{l+1}(α)).
///
/// Both differences cancel as the cap shrinks: in f32 nothing is left at r/d = 1e-4.
pub fn cap_thesis<R: Real>(cap: Cap<R>, scales: &mut [R]) {
    let cosine = cap.cosine;
    let Some(first) = scales.first_mut() else { return };
    *first = R::TAU() * (R::one() - cosine);
    let (mut before, mut legendre) = (R::one(), cosine);
    for (l, scale) in scales.iter_mut().enumerate().skip(1) {
        let after = next_legendre(l, cosine, legendre, before);
        *scale = R::of(std::f64::consts::TAU / (2 * l + 1) as f64) * (before - after);
        (before, legendre) = (legendre, after);
    }
}

/// P_{l+1}(x) from P_l and P_{l−1} (thesis 2.27 for m = 0), `l` ≥ 1.
pub(super) fn next_legendre<R: Real>(l: usize, x: R, legendre: R, before: R) -> R {
    let [a, b] = LEGENDRE[l];
    R::of(a) * x * legendre - R::of(b) * before
}

/// (2l + 1)/(l + 1) and l/(l + 1), by l.
pub(super) const LEGENDRE: [[f64; 2]; MAX_BANDS + 2] = {
    let mut table = [[0.0; 2]; MAX_BANDS + 2];
    let mut l = 0;
    while l < table.len() {
        let d = (l + 1) as f64;
        table[l] = [(2 * l + 1) as f64 / d, l as f64 / d];
        l += 1;
    }
    table
};

/// (2l + 1)/(l + 2) and (l − 1)/(l + 2), by l ≥ 1.
const CAP: [[f64; 2]; MAX_BANDS + 1] = {
    let mut table = [[0.0; 2]; MAX_BANDS + 1];
    let mut l = 1;
    while l < table.len() {
        let d = (l + 2) as f64;
        table[l] = [(2 * l + 1) as f64 / d, (l - 1) as f64 / d];
        l += 1;
    }
    table
};

/// The stable form, to use everywhere: c_0 = 2π (1 − α), c_l = 2π s² P'_l(α)/(l (l + 1)), from
/// (1 − x²) P'_l = l (l + 1)/(2l + 1) (P_{l−1} − P_{l+1}).
///
/// The recurrence runs on c_l itself and on its steps δ_l = c_l − c_{l−1}, with t = 1 − α as
/// s²/(1 + α): (l + 2) δ_{l+1} = (l − 1) δ_l − (2l + 1) t c_l. Stepping keeps the digits of t that
/// α, rounded near one, has lost: at 30 bands the three-term recurrence in α is wrong by 2e-5 in f32.
pub fn cap_stable<R: Real>(cap: Cap<R>, scales: &mut [R]) {
    let Some(first) = scales.first_mut() else { return };
    let versine = cap.versine();
    *first = R::TAU() * versine;
    if scales.len() == 1 {
        return;
    }
    let mut scale = R::PI() * (cap.sine * cap.sine);
    scales[1] = scale;
    let mut step = R::zero();
    for (l, next) in scales.iter_mut().skip(1).enumerate().skip(1) {
        let [a, b] = CAP[l];
        let fall = R::of(a) * (versine * scale);
        step = if l == 1 { -fall } else { R::of(b) * step - fall };
        scale += step;
        *next = scale;
    }
}
