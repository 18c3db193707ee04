//! The specular lobe as one circular lobe: zonal harmonics about its own axis (thesis 5.2.7).
//!
//! Deviations: the thesis takes the reflected direction for the axis, and the cosine of the rendering
//! equation out of the integral. Here both are the lobe's: of all circular lobes the one that is
//! nearest to the cosine-weighted lobe in the mean square, whatever its reflectance.

use std::f64::consts::PI;

use manylights_harmonics::{Basis, count, even_count, even_index, index};
use rayon::prelude::*;

use crate::lobes::{ANGLES, LobeTable, interpolated};

/// Golden sections of the axis: 0.618³² of two degrees is 7e-9 rad, and a maximum is flat.
const SECTIONS: usize = 32;

/// The circular lobes of one shape.
#[derive(Clone, Debug)]
pub struct ZonalTable {
    /// For each angle of the view 1 + bands pairs: x and z of the axis, then (2l + 1)/4π times the
    /// scales of A and B, see [`LobeTable`].
    values: Vec<[f64; 2]>,
}

impl ZonalTable {
    /// The nearest circular lobes to those of a table.
    pub(crate) fn new(lobes: &LobeTable) -> Self {
        let bands = lobes.bands();
        let basis = Basis::new(bands);
        let rows = lobes.values().par_chunks(even_count(bands));
        Self { values: rows.flat_map_iter(|row| nearest(&basis, row)).collect() }
    }

    /// All rows.
    pub fn values(&self) -> &[[f64; 2]] {
        &self.values
    }

    /// The row for a view at this angle from the normal, linear between whole degrees; the axis of
    /// unit length.
    pub fn at(&self, radians: f64) -> ([f64; 2], Vec<[f64; 2]>) {
        let mut row = interpolated(&self.values, radians);
        let scales = row.split_off(1);
        let [x, z] = row[0];
        let length = x.hypot(z);
        ([x / length, z / length], scales)
    }

    /// Share of the square of row `degrees` of A + B that the circular lobe holds.
    pub fn captured(&self, lobes: &LobeTable, degrees: usize) -> f64 {
        let size = self.values.len() / ANGLES;
        let zonal = &self.values[degrees * size + 1..][..size - 1];
        let held =
            |(l, [a, b]): (usize, &[f64; 2])| (a + b).powi(2) * 4.0 * PI / (2 * l + 1) as f64;
        let all = even_count(lobes.bands());
        let row = &lobes.values()[degrees * all..][..all];
        let whole: f64 = row.iter().map(|[a, b]| (a + b).powi(2)).sum();
        zonal.iter().enumerate().map(held).sum::<f64>() / whole
    }
}

/// One row: about the axis n the projection has scales 4π/(2l + 1) Σ_m f_lm Y_lm(n), and holds
/// Σ_l (2l + 1)/4π of their squares of the lobe's own.
fn nearest(basis: &Basis<f64>, row: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let held = |angle: f64| {
        let bands = projected(basis, row, angle).into_iter().enumerate();
        bands.map(|(l, [a, b])| (a + b).powi(2) * 4.0 * PI / (2 * l + 1) as f64).sum::<f64>()
    };
    // The view has x > 0, so the lobe leans the other way.
    let best = (0..ANGLES)
        .map(|degrees| -(degrees as f64).to_radians())
        .max_by(|a, b| held(*a).total_cmp(&held(*b)))
        .unwrap_or(0.0);
    let step = 1_f64.to_radians();
    let axis = highest(held, [best - step, best + step]);
    let mut values = vec![[axis.sin(), axis.cos()]];
    values.extend(projected(basis, row, axis));
    values
}

/// Σ_m f_lm Y_lm of each band, for the direction at this angle in the xz-plane.
fn projected(basis: &Basis<f64>, row: &[[f64; 2]], angle: f64) -> Vec<[f64; 2]> {
    let bands = basis.bands();
    let mut harmonics = vec![0.0; count(bands)];
    basis.evaluate([angle.sin(), 0.0, angle.cos()], &mut harmonics);
    let band = |l: usize| {
        (0..=l).fold([0.0; 2], |[a, b], m| {
            let value = harmonics[index(l, m as isize)];
            let [c, d] = row[even_index(l, m)];
            [a + value * c, b + value * d]
        })
    };
    (0..bands).map(band).collect()
}

/// The maximum in an interval, by golden section.
fn highest(value: impl Fn(f64) -> f64, [mut a, mut b]: [f64; 2]) -> f64 {
    let ratio = 0.5 * (5_f64.sqrt() - 1.0);
    for _ in 0..SECTIONS {
        let (c, d) = (b - ratio * (b - a), a + ratio * (b - a));
        if value(c) > value(d) { b = d } else { a = c }
    }
    0.5 * (a + b)
}
