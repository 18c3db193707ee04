//! Values and gradients of the basis at one direction, by the normalised solid-harmonic recurrence:
//! no poles, no trigonometry, no normalisation roots at run time.
//!
//! The homogeneous solid harmonic R_lm = ρ^l Y_lm is a polynomial in x, y, z: with
//! U_m + iV_m = (x + iy)^m and Q_l^m(z, ρ²) its normalised z-part, R_lm = Q_l^m U_m and
//! R_l,−m = Q_l^m V_m. Folding the normalisation into the recurrence (Sloan 2013, "Efficient
//! Spherical Harmonic Evaluation") keeps f32 accurate where the unnormalised Q overflows into noise
//! near l = 16.

use crate::{Real, index};

/// Tables of the recurrences for a number of bands.
#[derive(Clone, Debug)]
pub struct Basis<R> {
    bands: usize,
    /// Q_m^m, √2 of m > 0 included.
    diagonal: Vec<R>,
    /// (a, b, c) of l ≥ m at `l (l + 1) / 2 + m`:
    /// Q_l^m = a z Q_{l−1}^m − b ρ² Q_{l−2}^m and ∂_z R_lm = c R_{l−1,m}.
    recurrence: Vec<[R; 3]>,
}

impl<R: Real> Basis<R> {
    /// Tables for `bands` ≥ 1 bands.
    pub fn new(bands: usize) -> Self {
        assert!(bands >= 1, "an expansion has at least one band");
        let mut diagonal = Vec::with_capacity(bands);
        let mut value = (0.25 / std::f64::consts::PI).sqrt();
        for m in 0..bands {
            if m > 0 {
                let m = m as f64;
                value *= ((2.0 * m + 1.0) / (2.0 * m)).sqrt();
            }
            let factor = if m > 0 { std::f64::consts::SQRT_2 } else { 1.0 };
            diagonal.push(R::of(value * factor));
        }
        let recurrence = (0..bands)
            .flat_map(|l| (0..=l).map(move |m| (l as f64, m as f64)))
            .map(|(l, m)| {
                if m == l {
                    return [R::zero(); 3];
                }
                let a = |l: f64| ((4.0 * l * l - 1.0) / (l * l - m * m)).sqrt();
                let b = if l - 1.0 > m { a(l) / a(l - 1.0) } else { 0.0 };
                let c = ((2.0 * l + 1.0) * (l * l - m * m) / (2.0 * l - 1.0)).sqrt();
                [R::of(a(l)), R::of(b), R::of(c)]
            })
            .collect();
        Self { bands, diagonal, recurrence }
    }

    /// Number of bands.
    pub fn bands(&self) -> usize {
        self.bands
    }

    /// Writes Y_lm(direction) to `values[index(l, m)]`; `values` holds `bands²` numbers.
    pub fn evaluate(&self, [x, y, z]: [R; 3], values: &mut [R]) {
        let n = self.bands;
        assert_eq!(values.len(), n * n, "bands² values");
        let (mut u, mut v) = (R::one(), R::zero());
        for m in 0..n {
            let (mut before, mut q) = (R::zero(), self.diagonal[m]);
            for l in m..n {
                if l > m {
                    let [a, b, _] = self.recurrence[l * (l + 1) / 2 + m];
                    (before, q) = (q, a * z * q - b * before);
                }
                values[index(l, m as isize)] = q * u;
                if m > 0 {
                    values[index(l, -(m as isize))] = q * v;
                }
            }
            (u, v) = (x * u - y * v, x * v + y * u);
        }
    }
}
