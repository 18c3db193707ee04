//! The basis as explicit polynomials in x, y, z.

use crate::{Real, count, index};

/// c xⁱ yʲ zᵏ of one basis function.
#[derive(Clone, Copy, Debug)]
struct Term<R> {
    factor: R,
    powers: [usize; 3],
}

/// Largest number of bands of [`Polynomials`]: in single precision their terms cancel the more the higher the band.
pub const POLYNOMIAL_BANDS: usize = 10;

/// Sums of monomials for up to ten bands, as the traditional evaluation has them: Q_l^m(z) times
/// Re or Im (x + iy)^m, multiplied out.
#[derive(Clone, Debug)]
pub struct Polynomials<R> {
    terms: Vec<Vec<Term<R>>>,
}

impl<R: Real> Polynomials<R> {
    /// Terms for 1 … 10 bands.
    pub fn new(bands: usize) -> Self {
        assert!(
            (1..=POLYNOMIAL_BANDS).contains(&bands),
            "1 to {POLYNOMIAL_BANDS} bands, not {bands}"
        );
        let mut terms = vec![Vec::new(); count(bands)];
        for l in 0..bands {
            for m in 0..=l {
                for (k, factor) in zonal_part(l, m).into_iter().enumerate() {
                    if factor == 0.0 {
                        continue;
                    }
                    for j in 0..=m {
                        let sign = if j % 4 < 2 { 1.0 } else { -1.0 };
                        let term = Term {
                            factor: R::of(factor * binomial(m, j) * sign),
                            powers: [m - j, j, k],
                        };
                        let order = if j % 2 == 0 { m as isize } else { -(m as isize) };
                        terms[index(l, order)].push(term);
                    }
                }
            }
        }
        Self { terms }
    }

    /// Writes Y_lm(direction) to `values[index(l, m)]`, bands² numbers.
    pub fn evaluate(&self, direction: [R; 3], values: &mut [R]) {
        let powers = direction.map(powers);
        for (value, terms) in values.iter_mut().zip(&self.terms) {
            *value = terms.iter().map(|term| term.factor * term.product(&powers)).sum();
        }
    }

    /// Writes the tangential gradient to `gradients[axis][index(l, m)]`, bands² numbers each.
    pub fn gradient(&self, direction: [R; 3], gradients: [&mut [R]; 3]) {
        let powers = direction.map(powers);
        let [gx, gy, gz] = gradients;
        for (lm, terms) in self.terms.iter().enumerate() {
            let mut gradient = [R::zero(); 3];
            for term in terms {
                for (axis, sum) in gradient.iter_mut().enumerate() {
                    let power = term.powers[axis];
                    if power > 0 {
                        let mut lower = *term;
                        lower.powers[axis] -= 1;
                        *sum += term.factor * R::of(power as f64) * lower.product(&powers);
                    }
                }
            }
            let [x, y, z] = direction;
            let outward = x * gradient[0] + y * gradient[1] + z * gradient[2];
            gx[lm] = gradient[0] - outward * x;
            gy[lm] = gradient[1] - outward * y;
            gz[lm] = gradient[2] - outward * z;
        }
    }
}

impl<R: Real> Term<R> {
    fn product(&self, powers: &[[R; POLYNOMIAL_BANDS]; 3]) -> R {
        let [i, j, k] = self.powers;
        powers[0][i] * powers[1][j] * powers[2][k]
    }
}

fn powers<R: Real>(base: R) -> [R; POLYNOMIAL_BANDS] {
    let mut powers = [R::one(); POLYNOMIAL_BANDS];
    for i in 1..POLYNOMIAL_BANDS {
        powers[i] = powers[i - 1] * base;
    }
    powers
}

/// Coefficients of zᵏ in √2 K_l^m dᵐP_l/dzᵐ.
///
/// # Panics
/// Beyond [`POLYNOMIAL_BANDS`].
pub(crate) fn zonal_part(l: usize, m: usize) -> Vec<f64> {
    assert!(l < POLYNOMIAL_BANDS, "polynomials of at most {POLYNOMIAL_BANDS} bands");
    let (mut before, mut legendre) = (vec![0.0; l + 1], vec![0.0; l + 1]);
    legendre[0] = 1.0;
    for n in 1..=l {
        let mut next = vec![0.0; l + 1];
        for k in 0..=n {
            let ahead = if k > 0 { (2 * n - 1) as f64 * legendre[k - 1] } else { 0.0 };
            next[k] = (ahead - (n - 1) as f64 * before[k]) / n as f64;
        }
        (before, legendre) = (legendre, next);
    }
    let ratio: f64 = (l - m + 1..=l + m).map(|n| n as f64).product();
    let sides = if m > 0 { 2.0 } else { 1.0 };
    let norm = (sides * (2 * l + 1) as f64 / (4.0 * std::f64::consts::PI * ratio)).sqrt();
    (m..=l)
        .map(|k| norm * legendre[k] * (k - m + 1..=k).map(|n| n as f64).product::<f64>())
        .collect()
}

pub(crate) fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}
