//! What a GGX lobe reflects in all, by direction: the power of a texel's specular lobe.

use std::f64::consts::PI;
use std::sync::LazyLock;

use glam::{DVec2, DVec3};
use manylights_scene::DBrdf;

/// Roughnesses and cosines of the table, both from 0 to 1, as `shaders/emission.wesl` knows.
pub(crate) const NODES: usize = 32;

/// Rows of one roughness √α, columns of one cosine of the incoming direction: the albedo is
/// f0·x + f90·y.
pub(crate) static ALBEDOS: LazyLock<Vec<[f32; 2]>> = LazyLock::new(|| {
    let node = |index: usize| index as f64 / (NODES - 1) as f64;
    let places = (0..NODES * NODES).map(|index| (node(index / NODES), node(index % NODES)));
    // A mirror, and light along the surface, as limits.
    places
        .map(|(roughness, cosine)| albedo(roughness.max(1e-2).powi(2), cosine.max(1e-4)))
        .map(|albedo| albedo.as_vec2().to_array())
        .collect()
});

/// Cells of the quadrature over visible normals: rings and half-turns.
const RINGS: u32 = 48;
const SECTORS: u32 = 16;

/// ∫ D V ⟨n·w⟩ dw, split into what is multiplied by f0 and by f90, by the midpoint rule over visible
/// normals (Dupuy and Benyoub 2023): the integrand is G₂/G₁, below 1.
pub(crate) fn albedo(alpha: f64, cosine: f64) -> DVec2 {
    let view = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
    let stretch = DVec3::new(alpha, alpha, 1.0);
    let standard = (stretch * view).normalize();
    let white = DBrdf {
        diffuse: DVec3::ZERO,
        f0: DVec3::ONE,
        lobe: manylights_scene::Lobe::Schlick { f90: 1.0 },
        alpha,
    };
    let middle = |index: u32, count: u32| (f64::from(index) + 0.5) / f64::from(count);
    let mut sum = DVec2::ZERO;
    for ring in 0..RINGS {
        for sector in 0..SECTORS {
            let z = (1.0 - middle(ring, RINGS)) * (1.0 + standard.z) - standard.z;
            let around = DVec2::from_angle(PI * middle(sector, SECTORS));
            let cap = ((1.0 - z * z).max(0.0).sqrt() * around).extend(z);
            let micro = (stretch * (cap + standard)).normalize();
            let view_m = view.dot(micro);
            let out = 2.0 * view_m * micro - view;
            if out.z > 0.0 {
                let smith = (alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine).sqrt();
                // G₂/G₁ = 4 n·v n·w V / G₁(v), G₁(v) = 2 n·v/(n·v + √…).
                let masked = 2.0 * white.visibility(cosine, out.z) * out.z * (cosine + smith);
                let grazing = (1.0 - view_m).clamp(0.0, 1.0).powi(5);
                sum += masked * DVec2::new(1.0 - grazing, grazing);
            }
        }
    }
    sum / f64::from(RINGS * SECTORS)
}

/// The table between its nodes, as the adapter reads it.
pub(crate) fn interpolated(roughness: f64, cosine: f64) -> DVec2 {
    let last = (NODES - 1) as f64;
    let [x, y] = [cosine, roughness].map(|value| value.clamp(0.0, 1.0) * last);
    let [left, low] = [x, y].map(|value| (value as usize).min(NODES - 2));
    let at = |row: usize, column: usize| {
        let [f0, f90] = ALBEDOS[row * NODES + column];
        DVec2::new(f0.into(), f90.into())
    };
    let row = |row| at(row, left).lerp(at(row, left + 1), x - left as f64);
    row(low).lerp(row(low + 1), y - low as f64)
}
