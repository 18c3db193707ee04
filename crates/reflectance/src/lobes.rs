//! SH coefficients of the specular lobe, tabulated over the view's angle (thesis appendix B).
//!
//! Schlick's Fresnel term is linear in f0 and f90, so one material's cosine-weighted lobe is
//! f0 A + f90 B with two scalar lobes A and B that depend on α and the view alone: one table serves
//! all colours, textured ones included. With the exact term of a dielectric it is f0 A, where A depends
//! on the index too, and B = 0. A measurement takes two tables: A and B are red and green of the one,
//! blue and nothing of the other.

use glam::DVec3;
use manylights_harmonics::{Basis, count, even_count, even_index, index};
use rayon::prelude::*;

use crate::LobeShape;
use crate::expansion::Damping;
use crate::lobe_quadrature::{Fixed, LobeQuadrature};

/// Angles between view and normal: 0°, 1°, … 90°.
pub const ANGLES: usize = 91;

/// Nodes of the quadrature in the polar angle and in the half turn of the half vector. Tested
/// against twice as many, and against a quadrature over the sphere.
pub const NODES: [usize; 2] = [96, 96];

/// Reflectances [f0, f90] under which no lobe of a damped table rings: without the Fresnel term, and of
/// a dielectric, most of which is at grazing angles.
const DAMPED: [[f64; 2]; 2] = [[1.0, 1.0], [0.04, 1.0]];
/// The same of a measurement: each channel on its own.
const CHANNELS: [[f64; 2]; 2] = [[1.0, 0.0], [0.0, 1.0]];

/// The lobes of one shape.
#[derive(Clone, Debug)]
pub struct LobeTable {
    bands: usize,
    /// [A, B] at `angle * even_count(bands) + even_index(l, m)`; m < 0 are zero.
    values: Vec<[f64; 2]>,
}

impl LobeTable {
    /// Those of all shapes of a reflectance ([`LobeShape::of_measurement`]; one, if it is none), by
    /// quadrature; `nodes` in the polar angle of the half vector, and in half a turn.
    pub fn integrate(shape: impl Into<LobeShape>, bands: usize, nodes: [usize; 2]) -> Vec<Self> {
        let shape = shape.into();
        let (basis, lobe) = (Basis::new(bands), LobeQuadrature::new(shape, nodes, Fixed::View));
        let row = |degrees: usize| project(&basis, &lobe, (degrees as f64).to_radians());
        let lobes: Vec<_> = (0..ANGLES).into_par_iter().flat_map_iter(row).collect();
        shape.pairs(&lobes).into_iter().map(|values| Self { bands, values }).collect()
    }

    /// The same, of this shape, under a window: for each row the strongest of those for some
    /// reflectances.
    pub(crate) fn damped(&self, shape: LobeShape, damping: Damping) -> Self {
        let reflectances = if shape.is_measured() { CHANNELS } else { DAMPED };
        let rows = self.values.par_chunks(even_count(self.bands));
        let damp = |row: &[[f64; 2]]| {
            let weights = reflectances.map(|[f0, f90]| {
                let lobe: Vec<_> = row.iter().map(|[a, b]| f0 * a + f90 * b).collect();
                damping.of_lobe(self.bands, &lobe)
            });
            let bands = (0..self.bands).flat_map(|l| std::iter::repeat_n(l, l + 1));
            let weight = |l: usize| weights.iter().map(|weights| weights[l]).fold(1.0, f64::min);
            let values = row.iter().zip(bands).map(|(pair, l)| pair.map(|v| v * weight(l)));
            values.collect::<Vec<_>>()
        };
        Self { bands: self.bands, values: rows.flat_map_iter(damp).collect() }
    }

    /// Bands.
    pub fn bands(&self) -> usize {
        self.bands
    }

    /// All rows, [A, B].
    pub fn values(&self) -> &[[f64; 2]] {
        &self.values
    }

    /// The coefficients for a view at this angle from the normal, linear between whole degrees. Near the
    /// horizon a smooth lobe changes faster than that: relative error of 10 bands at 89.5° 5.7e-2 for
    /// α = 0.01; for α = 9e-4 1.9e-2, and 9.3e-2 at 89.9°. Below 88.5° it is at most 1e-2.
    pub fn at(&self, radians: f64) -> Vec<[f64; 2]> {
        interpolated(&self.values, radians)
    }
}

/// The row for an angle in a table of [`ANGLES`] rows, linear between whole degrees.
pub(crate) fn interpolated(values: &[[f64; 2]], radians: f64) -> Vec<[f64; 2]> {
    let size = values.len() / ANGLES;
    let degrees = radians.to_degrees().clamp(0.0, (ANGLES - 1) as f64);
    let row = (degrees as usize).min(ANGLES - 2);
    let t = degrees - row as f64;
    let [low, high] = [row, row + 1].map(|row| &values[row * size..][..size]);
    let mix = |k: usize| move |(a, b): (&[f64; 2], &[f64; 2])| a[k] + t * (b[k] - a[k]);
    low.iter().zip(high).map(|pair| [mix(0)(pair), mix(1)(pair)]).collect()
}

/// ∫ f(v, l) n·l Y_lm(l) dl; normal z, view in the xz-plane.
fn project(basis: &Basis<f64>, lobe: &LobeQuadrature, view: f64) -> Vec<[f64; 3]> {
    let bands = basis.bands();
    let mut sums = vec![[0.0; 3]; even_count(bands)];
    let mut harmonics = vec![0.0; count(bands)];
    for (direction, [a, b, c]) in lobe.reflected(DVec3::new(view.sin(), 0.0, view.cos())) {
        basis.evaluate(direction.to_array(), &mut harmonics);
        for l in 0..bands {
            for m in 0..=l {
                let value = direction.z * harmonics[index(l, m as isize)];
                let sum = &mut sums[even_index(l, m)];
                sum[0] += value * a;
                sum[1] += value * b;
                sum[2] += value * c;
            }
        }
    }
    sums
}
