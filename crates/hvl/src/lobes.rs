//! SH coefficients of the specular lobe, tabulated over the view's angle (thesis appendix B).
//!
//! Schlick's Fresnel term is linear in f0 and f90, so one material's cosine-weighted lobe is
//! f0 A + f90 B with two scalar lobes A and B that depend on α and the view alone: one table serves
//! all colours, textured ones included.

use std::sync::Arc;

use glam::DVec3;
use manylights_harmonics::{Basis, count, even_count, even_index, index};
use rayon::prelude::*;

use crate::cache::Cache;
use crate::half_vectors::HalfVectors;
use crate::params::Damping;

/// Angles between view and normal: 0°, 1°, … 90°.
pub const ANGLES: usize = 91;

/// Nodes of the quadrature in the polar angle and in the half turn of the half vector. Tested
/// against twice as many, and against a quadrature over the sphere.
const NODES: [usize; 2] = [64, 96];

/// The lobes of one α.
#[derive(Clone, Debug)]
pub struct LobeTable {
    bands: usize,
    /// [A, B] at `angle * even_count(bands) + even_index(l, m)`; m < 0 are zero.
    values: Vec<[f64; 2]>,
}

impl LobeTable {
    /// The table for a GGX width, a number of bands and a window; made once in a process.
    pub fn of(alpha: f32, bands: usize, damping: Damping) -> Arc<Self> {
        static PLAIN: Cache<LobeTable> = Cache::new();
        static DAMPED: Cache<LobeTable> = Cache::new();
        let plain = PLAIN
            .get((alpha, bands, Damping::None), || Self::integrate(alpha.into(), bands, NODES));
        if damping == Damping::None {
            return plain;
        }
        DAMPED.get((alpha, bands, damping), || plain.damped(damping))
    }

    /// By quadrature; `nodes` in the polar angle of the half vector, and in half a turn.
    pub fn integrate(alpha: f64, bands: usize, nodes: [usize; 2]) -> Self {
        let (basis, lobe) = (Basis::new(bands), HalfVectors::new(alpha, nodes));
        let row = |degrees: usize| project(&basis, &lobe, (degrees as f64).to_radians());
        let values = (0..ANGLES).into_par_iter().flat_map_iter(row).collect();
        Self { bands, values }
    }

    /// The same under a window, found for each row on A + B: the lobe without its Fresnel term.
    fn damped(&self, damping: Damping) -> Self {
        let rows = self.values.par_chunks(even_count(self.bands));
        let damp = |row: &[[f64; 2]]| {
            let sums: Vec<_> = row.iter().map(|[a, b]| a + b).collect();
            let weights = damping.of_lobe(self.bands, &sums);
            let bands = (0..self.bands).flat_map(|l| std::iter::repeat_n(l, l + 1));
            let values = row.iter().zip(bands).map(|(pair, l)| pair.map(|v| v * weights[l]));
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

    /// The coefficients for a view at this angle from the normal, linear between whole degrees.
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
fn project(basis: &Basis<f64>, lobe: &HalfVectors, view: f64) -> Vec<[f64; 2]> {
    let bands = basis.bands();
    let mut sums = vec![[0.0; 2]; even_count(bands)];
    let mut harmonics = vec![0.0; count(bands)];
    for (direction, [a, b]) in lobe.reflected(DVec3::new(view.sin(), 0.0, view.cos())) {
        basis.evaluate(direction.to_array(), &mut harmonics);
        for l in 0..bands {
            for m in 0..=l {
                let value = direction.z * harmonics[index(l, m as isize)];
                let sum = &mut sums[even_index(l, m)];
                sum[0] += value * a;
                sum[1] += value * b;
            }
        }
    }
    sums
}
