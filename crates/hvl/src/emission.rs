//! What a sphere on a glossy surface emits, expanded in spherical harmonics (thesis 5.6).
//!
//! F_ω is the reflectance without the cosine, which stays outside (5.7), tabulated over the angle of
//! the primary light. The thesis does not say what F is below the horizon. Here it is the mirror
//! image: then the Lambertian lobe is one constant, band 0 holds the mean over the hemisphere, and
//! only l + m even remain. With zero there, band 0 would hold half of the light.

use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

use glam::{DVec3, Vec3};
use manylights_gpu::VirtualLight;
use manylights_harmonics::{Basis, clamped_cosine, count, index};
use manylights_scene::{DBrdf, Lobe};
use rayon::prelude::*;

use crate::cache::Cache;
use crate::lobe_quadrature::{Fixed, LobeQuadrature};
use crate::{Damping, LobeShape, diffuse, lobes};

/// Angles between primary light and normal: 0°, 1°, … 89°. At 90° the reflectance has no bound.
pub const ANGLES: usize = 90;

/// More than for the receivers' lobes: without the cosine the lobe ends at the horizon in a step.
const NODES: [usize; 2] = [384, 192];

/// The lobes of one shape.
#[derive(Debug)]
pub struct EmissionTable {
    /// [A, B] at `angle * terms(bands).count() + position`: see [`crate::lobes`].
    values: Vec<[f64; 2]>,
}

/// (l, m) of the coefficients, in order: m ≥ 0, l + m even.
pub fn terms(bands: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..bands).flat_map(|l| (0..=l).filter(move |m| (l + m) % 2 == 0).map(move |m| (l, m)))
}

impl EmissionTable {
    /// The table for a shape and a number of bands; made once in a process.
    pub fn of(shape: impl Into<LobeShape>, bands: usize) -> Arc<Self> {
        let shape = shape.into();
        static TABLES: Cache<EmissionTable> = Cache::new();
        TABLES.get((shape, bands, Damping::None), || Self::integrate(shape, bands))
    }

    fn integrate(shape: LobeShape, bands: usize) -> Self {
        // Kinks of its interpolation limit those of a measurement, and evaluating it takes long.
        let nodes = if shape.is_measured() { lobes::NODES } else { NODES };
        let (basis, lobe) = (Basis::new(bands), LobeQuadrature::new(shape, nodes, Fixed::Light));
        let row = |degrees: usize| project(&basis, &lobe, (degrees as f64).to_radians());
        Self { values: (0..ANGLES).into_par_iter().flat_map_iter(row).collect() }
    }

    /// All rows.
    pub fn values(&self) -> &[[f64; 2]] {
        &self.values
    }

    fn row(&self, degrees: usize) -> &[[f64; 2]] {
        let size = self.values.len() / ANGLES;
        &self.values[degrees * size..][..size]
    }
}

/// ∫ f(v, l) Y_lm(l) dl over the sphere, f mirrored in the horizon, times what keeps the flux of A + B,
/// or of each channel of a measurement:
/// a few bands of a lobe near the horizon put most of it where the cosine is large, up to 23 times its
/// flux, and those of one about the normal half of it.
fn project(basis: &Basis<f64>, lobe: &LobeQuadrature, view: f64) -> Vec<[f64; 2]> {
    let bands = basis.bands();
    let terms: Vec<_> = terms(bands).collect();
    let mut sums = vec![[0.0; 2]; terms.len()];
    let mut harmonics = vec![0.0; count(bands)];
    let mut flux = [0.0; 2];
    for (direction, [a, b]) in lobe.reflected(DVec3::new(view.sin(), 0.0, view.cos())) {
        basis.evaluate(direction.to_array(), &mut harmonics);
        flux[0] += direction.z * a;
        flux[1] += direction.z * b;
        for (sum, &(l, m)) in sums.iter_mut().zip(&terms) {
            let value = 2.0 * harmonics[index(l, m as isize)];
            sum[0] += value * a;
            sum[1] += value * b;
        }
    }
    let mut cosine = vec![0.0; bands];
    clamped_cosine::scales(&mut cosine);
    let expanded = [0, 1].map(|k| {
        let zonal = sums.iter().zip(&terms).filter(|(_, (_, m))| *m == 0);
        zonal.map(|(pair, &(l, _))| pair[k] * cosine[l] * diffuse::addition(l).sqrt()).sum()
    });
    let [a, b] = lobe.kept(flux, expanded);
    sums.into_iter().map(|pair| [a * pair[0], b * pair[1]]).collect()
}

/// The row for a light: its angle in whole degrees.
pub(crate) fn degrees(light: &VirtualLight) -> usize {
    let cosine = f64::from(light.normal.dot(light.incoming)).clamp(0.0, 1.0);
    (cosine.acos().to_degrees().round() as usize).min(ANGLES - 1)
}

/// The reflectance F_ω · Y of a light towards a unit direction, sr⁻¹: the scene's own where it has no
/// specular lobe or `bands` is 0.
pub fn reflectance(light: &VirtualLight, toward: DVec3, bands: usize) -> DVec3 {
    let brdf = DBrdf::from(light.brdf);
    let unit = |v: Vec3| v.as_dvec3().normalize();
    let (normal, incoming) = (unit(light.normal), unit(light.incoming));
    if bands == 0 || !brdf.has_specular() {
        return brdf.eval(normal, toward, incoming);
    }
    let across = incoming - normal.dot(incoming) * normal;
    let tangent = across.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
    let local = [tangent, normal.cross(tangent), normal].map(|axis| axis.dot(toward));
    let mut harmonics = vec![0.0; count(bands)];
    Basis::new(bands).evaluate(local, &mut harmonics);
    let lobe = |shape| {
        let table = EmissionTable::of(shape, bands);
        let row = table.row(degrees(light)).iter().zip(terms(bands));
        row.fold([0.0; 2], |[a, b], (&[f0, f90], (l, m))| {
            let value = harmonics[index(l, m as isize)];
            [a + f0 * value, b + f90 * value]
        })
    };
    let shape = LobeShape::from(light.brdf);
    if matches!(brdf.lobe, Lobe::Measured(_)) {
        let [[red, green], [blue, _]] = shape.of_measurement().map(lobe);
        return DVec3::new(red, green, blue);
    }
    let [a, b] = lobe(shape);
    let mirrored = diffuse::mirrored_grazing(bands).into_iter().enumerate();
    let grazing: f64 = mirrored.map(|(l, value)| value * harmonics[index(l, 0)]).sum();
    let [entering, fall] = diffuse::transmission(&brdf);
    let lambert = brdf.transmission(normal.dot(incoming)) * (entering - fall * grazing);
    brdf.diffuse * (FRAC_1_PI * lambert)
        + brdf.f0 * a
        + DVec3::splat(f64::from(brdf.lobe.f90()) * b)
}

/// A module with, for `bands` bands:
/// - `emission_lobe(y: array<f32, bands (bands + 1)/2>, row: u32) -> vec2f`: A and B of a row of
///   binding 7 whose first element is `row`;
/// - `emission_grazing(y) -> f32`: (1 − |n·l|)⁵;
/// - `EMISSION_TABLE`: elements a table.
pub(crate) fn module(bands: usize) -> String {
    let terms: Vec<_> = terms(bands).collect();
    let size = manylights_harmonics::even_count(bands);
    let table = ANGLES * terms.len();
    let position = |&(l, m): &(usize, usize)| manylights_harmonics::even_index(l, m);
    let lobe = terms.iter().zip(0..).map(|(term, offset): (_, usize)| {
        format!("y[{}] * emission_table[row + {offset}u]", position(term))
    });
    let mirrored = diffuse::mirrored_grazing(bands);
    let grazing = (0..bands)
        .step_by(2)
        .map(|l| format!("{:?} * y[{}]", mirrored[l] as f32, position(&(l, 0))));
    let [lobe, grazing] = [lobe.collect::<Vec<_>>(), grazing.collect()];
    let [lobe, grazing] = [lobe, grazing].map(|sum| sum.join("\n        + "));
    format!(
        "@group(0) @binding(7) var<storage, read> emission_table: array<vec2f>;\n\n\
         const EMISSION_TABLE = {table}u;\n\n\
         fn emission_lobe(y: array<f32, {size}>, row: u32) -> vec2f {{\n    return {lobe};\n}}\n\n\
         fn emission_grazing(y: array<f32, {size}>) -> f32 {{\n    return {grazing};\n}}\n"
    )
}
