//! SH coefficients of the specular lobe, tabulated over the view's angle.
//!
//! Schlick's Fresnel term is linear in f0 and f90, so one material's cosine-weighted lobe is
//! f0 A + f90 B with two scalar lobes A and B that depend on α and the view alone: one table serves
//! all colours, textured ones included.

use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::{Arc, LazyLock, Mutex};

use glam::{DVec3, Vec3};
use manylights_harmonics::quadrature::gauss_legendre;
use manylights_harmonics::{Basis, count, even_count, even_index, index};
use manylights_scene::{Brdf, DBrdf};
use rayon::prelude::*;

/// Angles between view and normal: 0°, 1°, … 90° (thesis appendix B).
pub const ANGLES: usize = 91;

/// Nodes of the quadrature in the polar angle and in the half turn of the half vector. Tested
/// against twice as many, and against a quadrature over the sphere.
const NODES: [usize; 2] = [64, 96];

/// The lobes of one α.
#[derive(Debug)]
pub struct LobeTable {
    bands: usize,
    /// [A, B] at `angle * even_count(bands) + even_index(l, m)`; m < 0 are zero.
    values: Vec<[f64; 2]>,
}

impl LobeTable {
    /// The table for a GGX width and a number of bands; made once in a process.
    pub fn of(alpha: f32, bands: usize) -> Arc<Self> {
        type Tables = Mutex<HashMap<(u32, usize), Arc<LobeTable>>>;
        static TABLES: LazyLock<Tables> = LazyLock::new(Tables::default);
        let mut tables = TABLES.lock().unwrap_or_else(|poison| poison.into_inner());
        let table = tables.entry((alpha.to_bits(), bands));
        table.or_insert_with(|| Arc::new(Self::integrate(alpha.into(), bands, NODES))).clone()
    }

    /// By quadrature; `nodes` in the polar angle of the half vector, and in half a turn.
    pub fn integrate(alpha: f64, bands: usize, nodes: [usize; 2]) -> Self {
        let basis = Basis::new(bands);
        let half_vectors = half_vectors(alpha, nodes);
        let values = (0..ANGLES)
            .into_par_iter()
            .flat_map_iter(|degrees| {
                let view = (degrees as f64).to_radians();
                project(alpha, DVec3::new(view.sin(), 0.0, view.cos()), &basis, &half_vectors)
            })
            .collect();
        Self { bands, values }
    }

    /// All rows, [A, B].
    pub fn values(&self) -> &[[f64; 2]] {
        &self.values
    }

    /// The coefficients for a view at this angle from the normal, linear between whole degrees.
    pub fn at(&self, radians: f64) -> Vec<[f64; 2]> {
        let degrees = radians.to_degrees().clamp(0.0, (ANGLES - 1) as f64);
        let row = (degrees as usize).min(ANGLES - 2);
        let t = degrees - row as f64;
        let size = even_count(self.bands);
        let [low, high] = [row, row + 1].map(|row| &self.values[row * size..][..size]);
        let mix = |k: usize| move |(a, b): (&[f64; 2], &[f64; 2])| a[k] + t * (b[k] - a[k]);
        low.iter().zip(high).map(|pair| [mix(0)(pair), mix(1)(pair)]).collect()
    }
}

/// Half vectors about z with weights D(h) n·h dω: with w² = 1 − u of the distribution's inverse,
/// tan² θ = α² (1 − w²)/w², du = 2w dw, so the integrand over w is smooth for every α.
fn half_vectors(alpha: f64, [rings, sectors]: [usize; 2]) -> Vec<(DVec3, f64)> {
    let nodes = gauss_legendre(rings);
    let ring = |&(node, weight): &(f64, f64)| {
        let w: f64 = 0.5 + 0.5 * node;
        let sin = alpha * (1.0 - w * w).sqrt();
        let inverse = 1.0 / sin.hypot(w);
        // Both halves of the turn alike.
        let share = w * weight / sectors as f64;
        (0..sectors).map(move |sector| {
            let (s, c) = ((sector as f64 + 0.5) / sectors as f64 * PI).sin_cos();
            (DVec3::new(sin * c, sin * s, w) * inverse, share)
        })
    };
    nodes.iter().flat_map(ring).collect()
}

/// ∫ f(v, l) n·l Y_lm(l) dl over the half vectors, dl = 4 v·h dh; normal z, view in the xz-plane.
fn project(
    alpha: f64,
    view: DVec3,
    basis: &Basis<f64>,
    half_vectors: &[(DVec3, f64)],
) -> Vec<[f64; 2]> {
    let bands = basis.bands();
    let ggx = DBrdf { alpha, ..Brdf::lambert(Vec3::ZERO).into() };
    let mut sums = vec![[0.0; 2]; even_count(bands)];
    let mut harmonics = vec![0.0; count(bands)];
    for &(h, weight) in half_vectors {
        let along = view.dot(h);
        let direction = 2.0 * along * h - view;
        if along <= 0.0 || direction.z <= 0.0 {
            continue;
        }
        let visibility = ggx.visibility(view.z, direction.z);
        let flux = weight * visibility * direction.z * 4.0 * along / h.z;
        let grazing = (1.0 - along).powi(5);
        basis.evaluate(direction.to_array(), &mut harmonics);
        for l in 0..bands {
            for m in 0..=l {
                let value = flux * harmonics[index(l, m as isize)];
                let sum = &mut sums[even_index(l, m)];
                sum[0] += value * (1.0 - grazing);
                sum[1] += value * grazing;
            }
        }
    }
    sums
}
