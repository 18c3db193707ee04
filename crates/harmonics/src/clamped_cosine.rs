//! Products with the clamped cosine max(0, n·ω), in the variants of thesis table 4.1.
//!
//! - 2.47: [`crate::product::Product`] with the cosine turned to the normal ([`scales`] and
//!   [`crate::zonal::rotate`]).
//! - 4.5, with all bands or cut at 3: [`Folded`].
//! - 4.6, in the frame of the surface: [`Local`]; with rotation: [`Local::apply_turned`].

use crate::product::Gaunt;
use crate::quadrature::gauss_legendre;
use crate::rotation::{Matrix, Zxzxz};
use crate::{Basis, Real, count, index};

/// The scales c_l of the clamped cosine: π, 2π/3, then zero for odd l and
/// 2π (−1)^(l/2+1)/((l + 2)(l − 1)) l!/(2^l (l/2)!²) for even l (Ramamoorthi & Hanrahan 2001).
///
/// Convolving radiance with them gives irradiance.
pub fn scales<R: Real>(scales: &mut [R]) {
    let tau = std::f64::consts::TAU;
    let mut central = 1.0;
    for (l, scale) in scales.iter_mut().enumerate() {
        let order = l as f64;
        *scale = R::of(match l {
            0 => tau / 2.0,
            1 => tau / 3.0,
            _ if l % 2 == 1 => 0.0,
            _ => {
                central *= (1.0 - order) / order;
                -tau * central / ((order + 2.0) * (order - 1.0))
            }
        });
    }
}

/// Thesis 4.5: the SH product with the cosine's scales folded into the table.
#[derive(Clone, Debug)]
pub struct Folded<R> {
    bands: usize,
    cosine_bands: usize,
    /// (i of the light, j of the normal, k of the result, c_l ∫ Y_i Y_j Y_k).
    entries: Vec<(u32, u32, u32, R)>,
}

impl<R: Real> Folded<R> {
    /// The table for light and result of `bands` bands and a cosine of `cosine_bands` ≤ `bands`; 3
    /// hold most of its energy.
    pub fn new(bands: usize, cosine_bands: usize) -> Self {
        assert!((1..=bands).contains(&cosine_bands), "cosine bands in 1 … bands");
        let gaunt = Gaunt::new(bands);
        let mut cosine = vec![0.0; cosine_bands];
        scales(&mut cosine);
        let mut entries = Vec::new();
        for k in 0..count(bands) {
            for j in (0..count(cosine_bands)).filter(|j| cosine[j.isqrt()] != 0.0) {
                for i in 0..count(bands) {
                    if let Some(value) = gaunt.integral([i, j, k]) {
                        let value = R::of(value * cosine[j.isqrt()]);
                        entries.push((i as u32, j as u32, k as u32, value));
                    }
                }
            }
        }
        Self { bands, cosine_bands, entries }
    }

    /// Number of tabulated integrals.
    pub fn integrals(&self) -> usize {
        self.entries.len()
    }

    /// Bands of the cosine.
    pub fn cosine_bands(&self) -> usize {
        self.cosine_bands
    }

    /// Writes the light under the cosine; `normal` holds the Y_lm of the normal for the cosine's
    /// bands, the other slices bands² coefficients.
    pub fn apply(&self, light: &[R], normal: &[R], product: &mut [R]) {
        assert_eq!(light.len(), count(self.bands), "bands² coefficients");
        assert_eq!(normal.len(), count(self.cosine_bands), "values of the normal");
        assert_eq!(product.len(), count(self.bands), "room for bands² coefficients");
        product.fill(R::zero());
        for &(i, j, k, value) in &self.entries {
            product[k as usize] += value * light[i as usize] * normal[j as usize];
        }
    }
}

/// Thesis 4.6: the product with the cosine itself, not its expansion, where z is the normal.
///
/// The matrix couples equal m only. Of those entries, too, many are zero: where l + l' is odd,
/// z Y Y' is even in z, so the half sphere gives half the integral over the whole one, which
/// vanishes but for |l − l'| = 1. The matrix is symmetric and the same for m and −m: triangles of
/// m ≥ 0 are kept.
#[derive(Clone, Debug)]
pub struct Local<R> {
    bands: usize,
    /// (l, l' ≤ l, m ≥ 0, ∫ Y_lm max(0, z) Y_l'm).
    entries: Vec<(u32, u32, u32, R)>,
}

impl<R: Real> Local<R> {
    /// The matrix for `bands` ≥ 1 bands.
    pub fn new(bands: usize) -> Self {
        let basis = Basis::<f64>::new(bands);
        // On 0 ≤ z ≤ 1, degree 2 (bands − 1) + 1.
        let nodes: Vec<_> = gauss_legendre(bands)
            .into_iter()
            .map(|(node, weight)| {
                let z = 0.5 + 0.5 * node;
                let mut values = vec![0.0; count(bands)];
                basis.evaluate([((1.0 - z) * (1.0 + z)).sqrt(), 0.0, z], &mut values);
                (0.5 * weight * z, values)
            })
            .collect();
        let mut entries = Vec::new();
        for m in 0..bands {
            let turn = if m == 0 { 2.0 } else { 1.0 } * std::f64::consts::PI;
            for l in m..bands {
                for other in (m..=l).filter(|other| (l - other) % 2 == 0 || l - other == 1) {
                    let [i, j] = [l, other].map(|l| index(l, m as isize));
                    let sum: f64 = nodes.iter().map(|(weight, y)| weight * y[i] * y[j]).sum();
                    entries.push((l as u32, other as u32, m as u32, R::of(turn * sum)));
                }
            }
        }
        Self { bands, entries }
    }

    /// (l, l' ≤ l, m ≥ 0, ∫ Y_lm max(0, z) Y_l'm), m by m, then l by l, l' ascending.
    pub(crate) fn entries(&self) -> &[(u32, u32, u32, R)] {
        &self.entries
    }

    /// Number of multiplications of a product: non-zeros of the whole matrix.
    pub fn non_zeros(&self) -> usize {
        let times = |m| if m > 0 { 2 } else { 1 };
        self.entries.iter().map(|&(l, k, m, _)| times(m) * if l == k { 1 } else { 2 }).sum()
    }

    /// Writes the light under the cosine; both slices hold bands² coefficients in the frame whose z
    /// is the normal.
    pub fn apply(&self, light: &[R], product: &mut [R]) {
        assert_eq!(light.len(), count(self.bands), "bands² coefficients");
        assert_eq!(product.len(), count(self.bands), "room for bands² coefficients");
        product.fill(R::zero());
        for &(l, other, m, value) in &self.entries {
            let (l, other, m) = (l as usize, other as usize, m as isize);
            let signs: &[isize] = if m == 0 { &[1] } else { &[1, -1] };
            for sign in signs {
                let [i, j] = [index(l, sign * m), index(other, sign * m)];
                product[i] += value * light[j];
                if i != j {
                    product[j] += value * light[i];
                }
            }
        }
    }

    /// The same for a light in another frame: turns `light` in place by `to_local`, whose rows are
    /// the local axes (the last one the normal), and writes the product in the local frame.
    pub fn apply_turned(
        &self,
        rotation: &Zxzxz<R>,
        to_local: Matrix<R>,
        light: &mut [R],
        product: &mut [R],
    ) {
        rotation.apply(to_local, light, product);
        self.apply(light, product);
    }
}
