//! What a GGX lobe reflects in all, by direction: the power of a texel's specular lobe.

use std::f64::consts::PI;
use std::sync::LazyLock;

use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3};
use manylights_scene::{Brdf, DBrdf, Lobe};

/// Roughnesses and cosines of the table, both from 0 to 1, as `shaders/emission.wesl` knows.
pub(crate) const NODES: usize = 32;

/// What [`albedos`] makes, for the oracle and single groups.
pub(crate) static ALBEDOS: LazyLock<Vec<[f32; 2]>> = LazyLock::new(albedos);

/// Rows of one roughness √α, columns of one cosine of the incoming direction: the albedo is
/// f0·x + f90·y.
pub(crate) fn albedos() -> Vec<[f32; 2]> {
    let node = |index: usize| index as f64 / (NODES - 1) as f64;
    let places = (0..NODES * NODES).map(|index| (node(index / NODES), node(index % NODES)));
    // A mirror, and light along the surface, as limits.
    places
        .map(|(roughness, cosine)| albedo(roughness.max(1e-2).powi(2), cosine.max(1e-4)))
        .map(|albedo| albedo.as_vec2().to_array())
        .collect()
}

/// Cells of the quadrature over visible normals: rings and half-turns.
const RINGS: u32 = 48;
const SECTORS: u32 = 16;

/// ∫ D V ⟨n·w⟩ dw, split into what is multiplied by f0 and by f90.
pub(crate) fn albedo(alpha: f64, cosine: f64) -> DVec2 {
    let parts = |cos: f64| {
        let grazing = (1.0 - cos).clamp(0.0, 1.0).powi(5);
        DVec2::new(1.0 - grazing, grazing)
    };
    visible_normals(alpha, cosine).map(|(cos, weight)| weight * parts(cos)).sum()
}

/// v·m of visible normals m and the weights G₂/G₁ of what they reflect, in all the albedo of a lobe
/// without Fresnel: the midpoint rule (Dupuy and Benyoub 2023), whose integrand is below 1.
fn visible_normals(alpha: f64, cosine: f64) -> impl Iterator<Item = (f64, f64)> {
    let view = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
    let stretch = DVec3::new(alpha, alpha, 1.0);
    let standard = (stretch * view).normalize();
    let ggx = DBrdf { alpha, ..DBrdf::lambert(DVec3::ZERO) };
    let smith = (alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine).sqrt();
    let middle = |index: u32, count: u32| (f64::from(index) + 0.5) / f64::from(count);
    (0..RINGS * SECTORS).filter_map(move |cell| {
        let z = (1.0 - middle(cell / SECTORS, RINGS)) * (1.0 + standard.z) - standard.z;
        let around = DVec2::from_angle(PI * middle(cell % SECTORS, SECTORS));
        let cap = ((1.0 - z * z).max(0.0).sqrt() * around).extend(z);
        let micro = (stretch * (cap + standard)).normalize();
        let view_m = view.dot(micro);
        let out = 2.0 * view_m * micro - view;
        // G₂/G₁ = 4 n·v n·w V / G₁(v), G₁(v) = 2 n·v/(n·v + √…).
        let masked = 2.0 * ggx.visibility(cosine, out.z) * out.z * (cosine + smith);
        (out.z > 0.0).then(|| (view_m, masked / f64::from(RINGS * SECTORS)))
    })
}

/// Cosines of the table of one exact lobe, from 0 to 1, as `shaders/emission.wesl` knows.
const COSINES: usize = 128;

/// Albedos over f0 of a lobe with exact Fresnel reflectance, by cosine. A table for each pair of α and
/// index: a scene has few, and towards grazing light values rise to ((n + 1)/(n − 1))², too steeply for
/// a table of all.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct ExactLobe {
    alpha: f32,
    /// As in surface records.
    slot: f32,
    albedos: [f32; COSINES],
}

/// The tables of all exact lobes among these.
pub(crate) fn exact_lobes(brdfs: impl IntoIterator<Item = Brdf>) -> Vec<ExactLobe> {
    let mut lobes: Vec<ExactLobe> = Vec::new();
    for Brdf { lobe, alpha, .. } in brdfs {
        let Lobe::Dielectric { index } = lobe else { continue };
        let slot = lobe.slot();
        if !lobes.iter().any(|known| (known.alpha, known.slot) == (alpha, slot)) {
            let albedos =
                std::array::from_fn(|node| exact_node(alpha.into(), index.into(), node) as f32);
            lobes.push(ExactLobe { alpha, slot, albedos });
        }
    }
    lobes
}

/// An entry of [`ExactLobe`]; light along the surface as a limit.
fn exact_node(alpha: f64, index: f64, node: usize) -> f64 {
    let cosine = (node as f64 / (COSINES - 1) as f64).max(1e-4);
    visible_normals(alpha, cosine)
        .map(|(cos, weight)| weight * DBrdf::relative_fresnel(index, cos))
        .sum()
}

/// Between the entries, as the adapter reads them.
pub(crate) fn exact_interpolated(alpha: f64, index: f64, cosine: f64) -> f64 {
    let x = cosine.clamp(0.0, 1.0) * (COSINES - 1) as f64;
    let low = (x as usize).min(COSINES - 2);
    let [left, right] = [low, low + 1].map(|node| exact_node(alpha, index, node));
    left + (right - left) * (x - low as f64)
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
