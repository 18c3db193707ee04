//! What a lobe with a plane of symmetry sees of polygons, in adjoint form.
//!
//! A lobe even in y is a sum of zonal functions about directions in the xz-plane: of band l the l + 1
//! coefficients of m ≥ 0 are 4π/(2l + 1) Σ_k w_lk Y_lm(d_k). Instead of coefficients of light, weights of the
//! lobe are kept: its double product with a polygon is Σ_lk w_lk S_l(d_k), and since S_l is linear in the
//! integrals over the edges, w₀ Ω + Σ_jk v_jk Σ_e c_ek B_j(e, d_k), in the notation of [`super`], with j up to
//! n − 2.

use crate::projection::jacobi::orthogonalise;
use crate::{Basis, Real, count, even_count, even_index, index};

/// Directions and inverses for a number of bands.
///
/// As many directions as bands, equally spaced over half a circle, with z the first: P_l of a direction and of
/// its opposite are the same but for their sign. On the circle the functions of band l are trigonometric
/// polynomials of degree and parity l, which these directions tell apart as a Fourier transform does, so that
/// the condition number is that of their Fourier coefficients: 1.39 for 5 bands, 1.62 for 9, 1.85 for 15. In
/// f32 a lobe whose coefficients are of the size 1 comes back to 2e-7, 2e-6 and 4e-6.
#[derive(Clone, Debug)]
pub struct MirrorPlane<R> {
    bands: usize,
    directions: Vec<[R; 2]>,
    /// Of each band, for each direction l + 1 numbers.
    inverses: Vec<Vec<R>>,
    condition: R,
}

impl<R: Real> MirrorPlane<R> {
    /// Inverts the addition theorem on the circle: of all weights that make a lobe those with the least sum of
    /// squares.
    ///
    /// # Panics
    /// For no band or more than [`super::MAX_BANDS`].
    pub fn new(bands: usize) -> Self {
        assert!((1..=super::MAX_BANDS).contains(&bands), "{bands} bands");
        let angle = |k: usize| R::PI() * R::of(k as f64) / R::of(bands as f64);
        let directions: Vec<_> = (0..bands).map(|k| [angle(k).sin(), angle(k).cos()]).collect();
        let basis = Basis::<R>::new(bands);
        let harmonics: Vec<Vec<R>> = directions
            .iter()
            .map(|&[x, z]| {
                let mut values = vec![R::zero(); count(bands)];
                basis.evaluate([x, R::zero(), z], &mut values);
                values
            })
            .collect();
        let (mut inverses, mut condition) = (Vec::new(), R::one());
        for l in 0..bands {
            let scale = R::of(4.0 * std::f64::consts::PI / (2 * l + 1) as f64);
            let mut columns: Vec<R> = (0..=l)
                .flat_map(|m| harmonics.iter().map(move |row| scale * row[index(l, m as isize)]))
                .collect();
            let (singular, turned) = orthogonalise(&mut columns, bands);
            let [least, most] = [R::min, R::max]
                .map(|pick| singular.iter().copied().reduce(pick).expect("a coefficient a band"));
            condition = condition.max(most / least);
            let weight = |k: usize, m: usize| {
                let part =
                    |s: usize| columns[s * bands + k] * turned[s * (l + 1) + m] / singular[s];
                (0..=l).map(part).sum()
            };
            let entries = (0..bands).flat_map(|k| (0..=l).map(move |m| (k, m)));
            inverses.push(entries.map(|(k, m)| weight(k, m)).collect());
        }
        Self { bands, directions, inverses, condition }
    }

    /// Of the worst band.
    pub fn condition(&self) -> R {
        self.condition
    }

    /// x and z of each.
    pub fn directions(&self) -> &[[R; 2]] {
        &self.directions
    }

    /// What coefficients (l, 0) … (l, l) of a lobe give the weight of P_l about direction k.
    pub(crate) fn row(&self, l: usize, k: usize) -> &[R] {
        &self.inverses[l][k * (l + 1)..][..l + 1]
    }

    /// Weights w_lk of P_l about each direction, at `k * bands + l`, for a lobe's coefficients of m ≥ 0.
    ///
    /// # Panics
    /// Where there are not as many as [`even_count`] says.
    pub fn weights(&self, lobe: &[R]) -> Vec<R> {
        assert_eq!(lobe.len(), even_count(self.bands));
        let weight = |i: usize| {
            let (k, l) = (i / self.bands, i % self.bands);
            let terms = self.row(l, k).iter().zip(&lobe[even_index(l, 0)..]);
            terms.map(|(&weight, &coefficient)| weight * coefficient).sum()
        };
        (0..self.bands * self.bands).map(weight).collect()
    }
}

/// Weights of P_l about one direction turned into those of the integrals B_{l−1} over edges, in place at l − 1;
/// that of the solid angle is returned. The transpose of the recurrence of S_l.
pub fn transpose<R: Real>(weights: &mut Vec<R>) -> R {
    for l in (1..weights.len().saturating_sub(2)).rev() {
        let carried = weights[l + 2];
        weights[l] += carried * R::of(carry(l));
    }
    for (l, weight) in weights.iter_mut().enumerate().skip(1) {
        *weight *= R::of(boundary(l));
    }
    weights.remove(0)
}

/// (2l − 1)/(l(l + 1)): what S_l has of B_{l−1}.
pub(crate) fn boundary(l: usize) -> f64 {
    (2 * l - 1) as f64 / (l * (l + 1)) as f64
}

/// l(l + 1)/((l + 2)(l + 3)): what S_{l+2} has of S_l.
pub(crate) fn carry(l: usize) -> f64 {
    (l * (l + 1)) as f64 / ((l + 2) * (l + 3)) as f64
}
