//! Exact rotation matrices, one block a band, by recurrence over the bands.
//!
//! J. Ivanic, K. Ruedenberg, "Rotation Matrices for Real Spherical Harmonics. Direct Determination
//! by Recursion", J. Phys. Chem. 1996, with the corrections of 1998: block l follows from blocks
//! l − 1 and 1.

use super::Matrix;
use crate::Real;

/// The rotation matrix of an expansion: block l is (2l + 1)², rows and columns m = −l … l.
#[derive(Clone, Debug)]
pub struct Blocks<R> {
    bands: usize,
    /// u, v, w of every entry, as [`Self::entries`].
    factors: Vec<[R; 3]>,
    /// Blocks one after the other, row by row.
    entries: Vec<R>,
}

/// Where block `l` starts: Σ_{k<l} (2k + 1)².
fn start(l: usize) -> usize {
    l * (2 * l + 1) * (2 * l).saturating_sub(1) / 3
}

impl<R: Real> Blocks<R> {
    /// Tables for `bands` ≥ 1 bands, and the identity.
    pub fn new(bands: usize) -> Self {
        assert!(bands >= 1, "an expansion has at least one band");
        let mut factors = Vec::with_capacity(start(bands));
        for l in 0..bands as isize {
            for m in -l..=l {
                factors.extend((-l..=l).map(|n| factors_of(l, m, n).map(R::of)));
            }
        }
        let entries = vec![R::zero(); start(bands)];
        let mut blocks = Self { bands, factors, entries };
        let [o, i] = [R::zero(), R::one()];
        blocks.set([[i, o, o], [o, i, o], [o, o, i]]);
        blocks
    }

    /// Number of bands.
    pub fn bands(&self) -> usize {
        self.bands
    }

    /// The entry of block `l` at row `m`, column `n`.
    pub fn entry(&self, l: usize, m: isize, n: isize) -> R {
        let (side, l_signed) = (2 * l + 1, l as isize);
        self.entries[start(l) + (m + l_signed) as usize * side + (n + l_signed) as usize]
    }

    /// Fills the blocks for another rotation.
    pub fn set(&mut self, matrix: Matrix<R>) {
        self.entries[0] = R::one();
        // Band 1 is the matrix itself on (y, z, x).
        let axes = [1, 2, 0];
        let first = axes.map(|row| axes.map(|column| matrix[row][column]));
        for l in 1..self.bands {
            let (known, block) = self.entries.split_at_mut(start(l));
            if l == 1 {
                block[..9].copy_from_slice(first.as_flattened());
                continue;
            }
            let previous = Previous { first: &first, block: &known[start(l - 1)..], l: l as isize };
            let side = 2 * l + 1;
            let factors = &self.factors[start(l)..];
            for (i, (entry, factors)) in block[..side * side].iter_mut().zip(factors).enumerate() {
                let (m, n) = ((i / side) as isize - l as isize, (i % side) as isize - l as isize);
                *entry = previous.entry(m, n, *factors);
            }
        }
    }

    /// Turns a function: writes the coefficients of ω ↦ f(Q⁻¹ω).
    pub fn apply(&self, coefficients: &[R], turned: &mut [R]) {
        let count = self.bands * self.bands;
        assert_eq!(coefficients.len(), count, "bands² coefficients");
        assert_eq!(turned.len(), count, "room for bands² coefficients");
        for l in 0..self.bands {
            let side = 2 * l + 1;
            let band = &coefficients[l * l..l * l + side];
            let rows = self.entries[start(l)..].chunks_exact(side);
            for (value, row) in turned[l * l..l * l + side].iter_mut().zip(rows) {
                *value = row.iter().zip(band).map(|(&a, &b)| a * b).sum();
            }
        }
    }
}

/// u, v, w of the paper's table 1.
fn factors_of(l: isize, m: isize, n: isize) -> [f64; 3] {
    if l < 2 {
        return [0.0; 3];
    }
    let denominator = if n.abs() < l { (l + n) * (l - n) } else { 2 * l * (2 * l - 1) } as f64;
    let a = m.abs();
    let root = |product: isize| (product as f64 / denominator).sqrt();
    let u = root((l + m) * (l - m));
    if m == 0 {
        return [u, -0.5 * root(2 * (l - 1) * l), 0.0];
    }
    [u, 0.5 * root((l + a - 1) * (l + a)), -0.5 * root((l - a - 1) * (l - a))]
}

/// What entries of block l are made of.
struct Previous<'a, R> {
    /// Block 1.
    first: &'a Matrix<R>,
    /// Block l − 1.
    block: &'a [R],
    l: isize,
}

impl<R: Real> Previous<'_, R> {
    fn entry(&self, m: isize, n: isize, [u, v, w]: [R; 3]) -> R {
        // Where a factor is zero its term lies outside block l − 1.
        let mut sum = R::zero();
        if m.abs() < self.l {
            sum += u * self.p(0, m, n);
        }
        sum += v * self.v(m, n);
        if m != 0 && m.abs() < self.l - 1 {
            let a = m.abs() + 1;
            let [same, other] = [self.p(1, m.signum() * a, n), self.p(-1, -m.signum() * a, n)];
            sum += w * if m > 0 { same + other } else { same - other };
        }
        sum
    }

    fn v(&self, m: isize, n: isize) -> R {
        let root = R::SQRT_2();
        match m {
            0 => self.p(1, 1, n) + self.p(-1, -1, n),
            1 => root * self.p(1, 0, n),
            -1 => root * self.p(-1, 0, n),
            _ if m > 0 => self.p(1, m - 1, n) - self.p(-1, 1 - m, n),
            _ => self.p(1, m + 1, n) + self.p(-1, -m - 1, n),
        }
    }

    /// The paper's _iP, of table 2.
    fn p(&self, i: isize, a: isize, n: isize) -> R {
        let l = self.l;
        let row = self.first[(i + 1) as usize];
        let block = |b: isize| self.block[((a + l - 1) * (2 * l - 1) + b + l - 1) as usize];
        if n == l {
            row[2] * block(l - 1) - row[0] * block(1 - l)
        } else if n == -l {
            row[2] * block(1 - l) + row[0] * block(l - 1)
        } else {
            row[1] * block(n)
        }
    }
}
