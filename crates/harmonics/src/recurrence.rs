//! The recurrence behind [`crate::Basis`], over plain numbers and over SIMD vectors of directions.

use crate::column::{Column, Number};
use crate::{MAX_BANDS, Real};

/// Factors of one step from band l − 1 to band l at order m, with D = dQ/dz and s² = x² + y²:
/// Q_l = `q_from_q` z Q_{l−1} − `q_from_d` s² D_{l−1} and D_l = `d_from_d` z D_{l−1} + `d_from_q` Q_{l−1}.
///
/// Sloan's three-term recurrence in Q alone takes second differences at the poles, where f32 loses
/// 1e-5 of band 29; this pair turns there like a rotation by a small angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<R> {
    pub(crate) q_from_q: R,
    pub(crate) q_from_d: R,
    pub(crate) d_from_d: R,
    pub(crate) d_from_q: R,
}

impl<R: Real> Step<R> {
    /// (Q, D) of band l from those of band l − 1.
    #[inline(always)]
    fn advance<N: Number<R>>(&self, z: N, square: N, q: N, slope: N) -> (N, N) {
        let turned = square.times(self.q_from_d) * slope;
        (
            z.times(self.q_from_q).mul_sub(q, turned),
            z.times(self.d_from_d).mul_add(slope, q.times(self.d_from_q)),
        )
    }
}

/// Tables for a number of bands.
#[derive(Clone, Debug)]
pub(crate) struct Recurrence<R> {
    pub(crate) bands: usize,
    /// Q_m^m, see [`diagonal`].
    diagonal: Vec<R>,
    /// Steps in the order of use: m from 0, then l from m + 1.
    steps: Vec<Step<R>>,
}

impl<R: Real> Recurrence<R> {
    pub(crate) fn new(bands: usize) -> Self {
        assert!(bands >= 1, "an expansion has at least one band");
        let steps = (0..bands).flat_map(|m| (m + 1..bands).map(move |l| step(l, m))).collect();
        Self { bands, diagonal: (0..bands).map(|m| R::of(diagonal(m))).collect(), steps }
    }
}

/// Q_m^m, √2 of m > 0 included.
pub(crate) fn diagonal(m: usize) -> f64 {
    let product: f64 = (1..=m).map(|k| 1.0 + 0.5 / k as f64).product();
    let sides = if m > 0 { 2.0 } else { 1.0 };
    (sides * product * 0.25 / std::f64::consts::PI).sqrt()
}

/// a and b of Sloan's Q_l^m = a z Q_{l−1}^m − b Q_{l−2}^m, `l` > `m`; b is 0 for l = m + 1.
pub(crate) fn three_term(l: usize, m: usize) -> [f64; 2] {
    let (degree, order) = (l as f64, m as f64);
    let a = |l: f64| ((4.0 * l * l - 1.0) / (l * l - order * order)).sqrt();
    let b = if l > m + 1 { a(degree) / a(degree - 1.0) } else { 0.0 };
    [a(degree), b]
}

/// The step to band `l` > `m`. From (l − m) P_l⁽ᵐ⁾ = (l + m) z P_{l−1}⁽ᵐ⁾ − s² P_{l−1}⁽ᵐ⁺¹⁾ and
/// P_l⁽ᵐ⁺¹⁾ = z P_{l−1}⁽ᵐ⁺¹⁾ + (l + m) P_{l−1}⁽ᵐ⁾ (derivatives of Legendre's polynomials), times √2 K_l^m.
pub(crate) fn step<R: Real>(l: usize, m: usize) -> Step<R> {
    let (l, m) = (l as f64, m as f64);
    let norm = ((2.0 * l + 1.0) * (l - m) / ((2.0 * l - 1.0) * (l + m))).sqrt();
    Step {
        q_from_q: R::of(norm * (l + m) / (l - m)),
        q_from_d: R::of(norm / (l - m)),
        d_from_d: R::of(norm),
        d_from_q: R::of(norm * (l + m)),
    }
}

/// Calls `write(index(l, m), [Y, ∂x Y, ∂y Y, ∂z Y])` for each (l, m) at a unit direction, the gradient
/// multiplied by `scale`. Without `GRADIENT` the gradient is not computed (it repeats Y).
#[inline(always)]
pub(crate) fn harmonics<R: Real, N: Number<R>, const GRADIENT: bool>(
    tables: &Recurrence<R>,
    [x, y, z]: [N; 3],
    scale: N,
    mut write: impl FnMut(usize, [N; 4]),
) {
    let bands = tables.bands;
    let (scaled_x, scaled_y) = (x * scale, y * scale);
    let square = x.mul_add(x, y * y);
    let zero = z.constant(R::zero());
    // (x + iy)^(m − 1) and (x + iy)^m.
    let (mut before, mut power) = ([zero; 2], [z.constant(R::one()), zero]);
    let mut steps = tables.steps.iter();
    for m in 0..bands {
        let column = Column::new(m, before, power, [scaled_x, scaled_y, scale]);
        let (mut q, mut slope) = (z.constant(tables.diagonal[m]), zero);
        column.emit::<GRADIENT>(m, z, q, slope, &mut write);
        for (l, step) in (m + 1..bands).zip(&mut steps) {
            (q, slope) = step.advance(z, square, q, slope);
            column.emit::<GRADIENT>(l, z, q, slope, &mut write);
        }
        let [u, v] = power;
        before = power;
        power = [y.negative_mul_add(v, x * u), y.mul_add(u, x * v)];
    }
}

/// Like [`harmonics`], band by band instead of order by order, for 2 … [`MAX_BANDS`] bands: all columns
/// stay in the first-level cache, and results come in the order of memory. Where they leave the cache
/// that is worth more than the loads that it costs.
#[inline(always)]
pub(crate) fn harmonics_by_band<R: Real, N: Number<R>, const GRADIENT: bool>(
    tables: &Recurrence<R>,
    [x, y, z]: [N; 3],
    scale: N,
    mut write: impl FnMut(usize, [N; 4]),
) {
    let bands = tables.bands;
    let along = [x * scale, y * scale, scale];
    let square = x.mul_add(x, y * y);
    let zero = z.constant(R::zero());
    let (mut before, mut power) = ([zero; 2], [z.constant(R::one()), zero]);
    let first = Column::new(0, before, power, along);
    let mut columns = [(first, zero, zero); MAX_BANDS];
    for l in 0..bands {
        let mut at = l.wrapping_sub(1);
        for (m, (column, q, slope)) in columns[..l].iter_mut().enumerate() {
            (*q, *slope) = tables.steps[at].advance(z, square, *q, *slope);
            column.emit::<GRADIENT>(l, z, *q, *slope, &mut write);
            at += bands - 2 - m;
        }
        let column = Column::new(l, before, power, along);
        let q = z.constant(tables.diagonal[l]);
        column.emit::<GRADIENT>(l, z, q, zero, &mut write);
        columns[l] = (column, q, zero);
        let [u, v] = power;
        before = power;
        power = [y.negative_mul_add(v, x * u), y.mul_add(u, x * v)];
    }
}
