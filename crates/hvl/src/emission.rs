//! What a sphere on a glossy surface emits, expanded in spherical harmonics (thesis 5.6).
//!
//! F_ω is the reflectance without the cosine, which stays outside (5.7), tabulated over the angle of
//! the primary light. The thesis does not say what F is below the horizon. Here it is the mirror
//! image: then the Lambertian lobe is one constant, band 0 holds the mean over the hemisphere, and
//! only l + m even remain. With zero there, band 0 would hold half of the light.

use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

use glam::{DVec3, Vec3};
use manylights_harmonics::{Basis, clamped_cosine, count, index};
use manylights_scene::{DBrdf, Lobe};
use manylights_virtual_lights::VirtualLight;
use rayon::prelude::*;

use manylights_reflectance::lobes::NODES;
use manylights_reflectance::{Cache, Damping, Fixed, LobeQuadrature, LobeShape, diffuse};

/// Angles between primary light and normal: 0°, 1°, … 89°. At 90° the reflectance has no bound.
pub const ANGLES: usize = 90;

/// The lobes of one shape.
#[derive(Debug)]
pub struct EmissionTable {
    /// [A, B] at `angle * terms(bands).count() + position`: see [`manylights_reflectance::lobes`].
    values: Vec<[f64; 2]>,
}

/// Tables as [`manylights_reflectance::Tables`] holds those of receivers.
pub(crate) struct EmissionTables(Cache<Vec<Arc<EmissionTable>>>);

impl EmissionTables {
    /// Nothing made yet.
    pub(crate) const fn new() -> Self {
        Self(Cache::new())
    }

    /// The one that lasts as long as the process.
    pub(crate) fn shared() -> &'static Self {
        static SHARED: EmissionTables = EmissionTables::new();
        &SHARED
    }

    /// The table for a shape and a number of bands.
    pub(crate) fn get(&self, shape: LobeShape, bands: usize) -> Arc<EmissionTable> {
        let (first, place) = shape.place();
        let all = self.0.get((first, bands, Damping::None), || {
            EmissionTable::integrate(first, bands).into_iter().map(Arc::new).collect()
        });
        all[place].clone()
    }

    /// How many were made.
    pub(crate) fn count(&self) -> u64 {
        self.0.count()
    }
}

/// (l, m) of the coefficients, in order: m ≥ 0, l + m even.
pub fn terms(bands: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..bands).flat_map(|l| (0..=l).filter(move |m| (l + m) % 2 == 0).map(move |m| (l, m)))
}

impl EmissionTable {
    /// The table for a shape and a number of bands, made once in a process: for oracles and tests.
    pub fn of(shape: impl Into<LobeShape>, bands: usize) -> Arc<Self> {
        EmissionTables::shared().get(shape.into(), bands)
    }

    /// Those of all shapes of a reflectance.
    fn integrate(shape: LobeShape, bands: usize) -> Vec<Self> {
        let (basis, lobe) = (Basis::new(bands), LobeQuadrature::new(shape, NODES, Fixed::Light));
        let row = |degrees: usize| {
            let mut row = project(&basis, &lobe, (degrees as f64).to_radians());
            keep_flux(shape, bands, &mut row.lobes, row.flux);
            row.lobes
        };
        let lobes: Vec<_> = (0..ANGLES).into_par_iter().flat_map_iter(row).collect();
        shape.pairs(&lobes).into_iter().map(|values| Self { values }).collect()
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

/// One row before its flux is kept.
struct Row {
    lobes: Vec<[f64; 3]>,
    /// ∫ f(v, l) n·l dl of each scalar lobe.
    flux: [f64; 3],
}

/// ∫ f(v, l) Y_lm(l) dl over the sphere, f mirrored in the horizon.
fn project(basis: &Basis<f64>, lobe: &LobeQuadrature, view: f64) -> Row {
    let bands = basis.bands();
    let terms: Vec<_> = terms(bands).collect();
    let mut row = Row { lobes: vec![[0.0; 3]; terms.len()], flux: [0.0; 3] };
    let mut harmonics = vec![0.0; count(bands)];
    for (direction, weights) in lobe.reflected(DVec3::new(view.sin(), 0.0, view.cos())) {
        basis.evaluate(direction.to_array(), &mut harmonics);
        let add = |sums: &mut [f64; 3], value: f64| {
            for (sum, weight) in sums.iter_mut().zip(weights) {
                *sum += value * weight;
            }
        };
        add(&mut row.flux, direction.z);
        for (sums, &(l, m)) in row.lobes.iter_mut().zip(&terms) {
            add(sums, 2.0 * harmonics[index(l, m as isize)]);
        }
    }
    row
}

/// Gives the expansion the flux of the lobe: a few bands of a lobe near the horizon put most of it where
/// the cosine is large, up to 23 times its flux, and those of one about the normal half of it. One factor
/// for f0 + f90, but one for each channel of a measurement, which may be black.
fn keep_flux(shape: LobeShape, bands: usize, lobes: &mut [[f64; 3]], flux: [f64; 3]) {
    let mut cosine = vec![0.0; bands];
    clamped_cosine::scales(&mut cosine);
    let expanded = [0, 1, 2].map(|k| -> f64 {
        let zonal = lobes.iter().zip(terms(bands)).filter(|(_, (_, m))| *m == 0);
        zonal.map(|(sums, (l, _))| sums[k] * cosine[l] * diffuse::addition(l).sqrt()).sum()
    });
    let factor = |flux: f64, expanded: f64| if flux > 0.0 { flux / expanded } else { 1.0 };
    let factors = if shape.is_measured() {
        [0, 1, 2].map(|k| factor(flux[k], expanded[k]))
    } else {
        [factor(flux[0] + flux[1], expanded[0] + expanded[1]); 3]
    };
    for sums in lobes {
        for (sum, factor) in sums.iter_mut().zip(factors) {
            *sum *= factor;
        }
    }
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

/// The table that [`module`] reads, of `vec2f`, as it imports it from `package::bindings`.
pub(crate) const EMISSIONS: &str = "emissions";

/// A module with, for `bands` bands:
/// - `emission_lobe(y: array<f32, bands (bands + 1)/2>, row: u32) -> vec2f`: A and B of the row of
///   [`EMISSIONS`] whose first element is `row`;
/// - `emission_grazing(y) -> f32`: (1 − |n·l|)⁵;
/// - `EMISSION_TABLE`: elements a table.
pub(crate) fn module(bands: usize) -> String {
    let terms: Vec<_> = terms(bands).collect();
    let size = manylights_harmonics::even_count(bands);
    let table = ANGLES * terms.len();
    let position = |&(l, m): &(usize, usize)| manylights_harmonics::even_index(l, m);
    let lobe = terms.iter().zip(0..).map(|(term, offset): (_, usize)| {
        format!("y[{}] * {EMISSIONS}[row + {offset}u]", position(term))
    });
    let mirrored = diffuse::mirrored_grazing(bands);
    let grazing = (0..bands)
        .step_by(2)
        .map(|l| format!("{:?} * y[{}]", mirrored[l] as f32, position(&(l, 0))));
    let [lobe, grazing] = [lobe.collect::<Vec<_>>(), grazing.collect()];
    let [lobe, grazing] = [lobe, grazing].map(|sum| sum.join("\n        + "));
    format!(
        "import package::bindings::{EMISSIONS};\n\n\
         const EMISSION_TABLE = {table}u;\n\n\
         fn emission_lobe(y: array<f32, {size}>, row: u32) -> vec2f {{\n    return {lobe};\n}}\n\n\
         fn emission_grazing(y: array<f32, {size}>) -> f32 {{\n    return {grazing};\n}}\n"
    )
}
