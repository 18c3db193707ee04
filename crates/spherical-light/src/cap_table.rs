//! The coefficients of caps in a table (JFIG 4.2), over the versine 1 − cos a of the half-angle.
//!
//! What is tabulated is c_l/sin² a: for l ≥ 1 a polynomial of degree l − 1 in the versine, π at 0 for all
//! l, so that small lights keep their digits. Linear interpolation is left with h²/8 of its second derivative:
//! of π sin² a, the largest coefficient of a small light, 1.3e-6 (5 bands), 7.2e-6 (7), 2.3e-5 (9), 2.1e-4 (15)
//! (`tests/tables.rs`). Over the sine it would err more: the cosine is a root of it at the hemisphere.

use std::f64::consts::PI;

use manylights_harmonics::zonal::{Cap, cap_stable};

/// Versines in the table, from 0 to 1: 48 KiB of 9 bands.
pub const NODES: usize = 1024;

/// The table that [`module`] reads, of `vec4f`.
pub(crate) const COEFFICIENTS: &str = "coefficients";

/// c_l/sin² a of all nodes for a number of bands.
pub struct CapTable {
    rows: Vec<Vec<f64>>,
}

impl CapTable {
    /// All of it.
    pub fn new(bands: usize) -> Self {
        let row = |node: usize| {
            let versine = node as f64 / (NODES - 1) as f64;
            if node == 0 {
                return vec![PI; bands];
            }
            let (cosine, sine2) = (1.0 - versine, versine * (2.0 - versine));
            let mut scales = vec![0.0; bands];
            cap_stable(Cap { sine: sine2.sqrt(), cosine }, &mut scales);
            scales.into_iter().map(|scale| scale / sine2).collect()
        };
        Self { rows: (0..NODES).map(row).collect() }
    }

    /// The scales of a cap, as the adapter interpolates them.
    pub fn scales(&self, cap: Cap<f64>) -> Vec<f64> {
        let position = cap.versine().clamp(0.0, 1.0) * (NODES - 1) as f64;
        let lower = (position as usize).min(NODES - 2);
        let fraction = position - lower as f64;
        let [low, high] = [lower, lower + 1].map(|node| &self.rows[node]);
        let mix = |(a, b): (&f64, &f64)| cap.sine * cap.sine * (a + fraction * (b - a));
        low.iter().zip(high).map(mix).collect()
    }

    /// As lanes read it: each row in whole vectors, of which two serve a cap.
    pub(crate) fn records(&self) -> Vec<[f32; 4]> {
        let value = |row: &[f64], i: usize| row.get(i).map_or(0.0, |&value| value as f32);
        let vectors = |row: &Vec<f64>| -> Vec<[f32; 4]> {
            let first = (0..row.len()).step_by(4);
            first.map(|i| [0, 1, 2, 3].map(|k| value(row, i + k))).collect()
        };
        self.rows.iter().flat_map(vectors).collect()
    }
}

/// A module with `tabulated_scales(sine: f32, cosine: f32) -> array<f32, bands>`, which reads
/// [`COEFFICIENTS`].
pub(crate) fn module(bands: usize) -> String {
    let vectors = bands.div_ceil(4);
    let vector = |i: usize| {
        format!(
            "    let v{i} = sine2 * mix({COEFFICIENTS}[first + {i}u], \
             {COEFFICIENTS}[first + {}u], fraction);\n",
            vectors + i
        )
    };
    let lines: String = (0..vectors).map(vector).collect();
    let value = |l: usize| format!("v{}[{}]", l / 4, l % 4);
    let values = (0..bands).map(value).collect::<Vec<_>>().join(", ");
    format!(
        "import package::bindings::{COEFFICIENTS};\n\n\
         fn tabulated_scales(sine: f32, cosine: f32) -> array<f32, {bands}> {{\n    \
         let sine2 = sine * sine;\n    \
         let position = sine2 / (1.0 + cosine) * {last}.0;\n    \
         let lower = min(u32(position), {last}u - 1u);\n    \
         let fraction = position - f32(lower);\n    \
         let first = lower * {vectors}u;\n{lines}    \
         return array<f32, {bands}>({values});\n}}\n",
        last = NODES - 1,
    )
}
