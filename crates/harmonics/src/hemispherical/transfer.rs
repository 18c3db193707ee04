use super::HemisphericalBasis;
use crate::quadrature::gauss_legendre;
use crate::{Basis, Real, count, index};

/// The matrix M_ij = ∫ H_i Y_j dω over the hemisphere (thesis 2.35), between one frame's HSH and SH.
///
/// Only equal m meet, and −m has the entries of m: one block of (n − m)(n' − m) for each m.
#[derive(Clone, Debug)]
pub struct Transfer<R> {
    hemispherical: usize,
    spherical: usize,
    /// For each m: rows are l of HSH from m on, columns l of SH from m on.
    blocks: Vec<Vec<R>>,
}

impl<R: Real> Transfer<R> {
    /// For the given numbers of bands of HSH and of SH, by Gauss–Legendre quadrature in √z, where
    /// the integrand is analytic.
    pub fn new(hemispherical: usize, spherical: usize) -> Self {
        let above = HemisphericalBasis::<f64>::new(hemispherical);
        let whole = Basis::<f64>::new(spherical);
        let (mut h, mut y) = (vec![0.0; count(hemispherical)], vec![0.0; count(spherical)]);
        let orders = hemispherical.min(spherical);
        let mut blocks: Vec<_> =
            (0..orders).map(|m| vec![0.0; (hemispherical - m) * (spherical - m)]).collect();
        for (node, weight) in gauss_legendre(2 * (hemispherical + spherical) + 16) {
            let root = 0.5 * (1.0 + node);
            let z = root * root;
            // In the xz-plane all cosines are 1; their squares average to 1/2 around, for m > 0.
            let direction = [((1.0 - z) * (1.0 + z)).sqrt(), 0.0, z];
            above.evaluate(direction, &mut h);
            whole.evaluate(direction, &mut y);
            let area = std::f64::consts::TAU * weight * root;
            for (m, block) in blocks.iter_mut().enumerate() {
                let area = if m == 0 { area } else { 0.5 * area };
                let columns = spherical - m;
                for (i, entry) in block.iter_mut().enumerate() {
                    let (row, column) = (m + i / columns, m + i % columns);
                    *entry += area * h[index(row, m as isize)] * y[index(column, m as isize)];
                }
            }
        }
        let narrow = |block: Vec<f64>| block.into_iter().map(R::of).collect();
        Self { hemispherical, spherical, blocks: blocks.into_iter().map(narrow).collect() }
    }

    /// HSH coefficients of the upper half of an SH expansion: its orthogonal projection.
    ///
    /// `spherical` and `hemispherical` hold the squares of the numbers of bands.
    pub fn to_hemispherical(&self, spherical: &[R], hemispherical: &mut [R]) {
        self.check(spherical, hemispherical);
        hemispherical.fill(R::zero());
        self.for_each(|h, y, entry| hemispherical[h] += entry * spherical[y]);
    }

    /// SH coefficients of an HSH expansion that is 0 below the horizon: its orthogonal projection.
    pub fn to_spherical(&self, hemispherical: &[R], spherical: &mut [R]) {
        self.check(spherical, hemispherical);
        spherical.fill(R::zero());
        self.for_each(|h, y, entry| spherical[y] += entry * hemispherical[h]);
    }

    fn check(&self, spherical: &[R], hemispherical: &[R]) {
        assert_eq!(spherical.len(), count(self.spherical), "bands² SH coefficients");
        assert_eq!(hemispherical.len(), count(self.hemispherical), "bands² HSH coefficients");
    }

    fn for_each(&self, mut visit: impl FnMut(usize, usize, R)) {
        for (m, block) in self.blocks.iter().enumerate() {
            let columns = self.spherical - m;
            for (i, &entry) in block.iter().enumerate() {
                let (row, column) = (m + i / columns, m + i % columns);
                let m = m as isize;
                visit(index(row, m), index(column, m), entry);
                if m > 0 {
                    visit(index(row, -m), index(column, -m), entry);
                }
            }
        }
    }
}
