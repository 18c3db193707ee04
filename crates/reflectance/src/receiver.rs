//! A shaded point's reflectance in f64: what `shaders/receiver.wesl` and `shaders/reflection.wesl` do.

use std::f64::consts::{FRAC_1_PI, PI};

use glam::DVec3;
use manylights_harmonics::zonal::{evaluate, rotate};
use manylights_harmonics::{Basis, count, even_index, index};
use manylights_scene::{Brdf, DBrdf, Lobe};

use crate::lobes::LobeTable;
use crate::zonal::ZonalTable;
use crate::{Damping, Form, LobeShape, diffuse};

/// Its lobes in harmonics, for oracles.
pub struct Receiver {
    /// Tangent, bitangent, normal.
    pub frame: [DVec3; 3],
    /// Lambertian reflectance times the transmission towards the camera, sr⁻¹.
    pub lambert: DVec3,
    basis: Basis<f64>,
    diffuse: Vec<f64>,
    specular: Specular,
}

enum Specular {
    None,
    /// One a coefficient of m ≥ 0.
    Full(Vec<DVec3>),
    /// Axis; (2l + 1)/4π times the scales.
    Zonal(DVec3, Vec<DVec3>),
}

impl Receiver {
    /// `normal` and `view` are unit vectors. Tables are those that last as long as the process.
    pub fn new(
        brdf: Brdf,
        [normal, view]: [DVec3; 2],
        bands: usize,
        form: Form,
        damping: Damping,
    ) -> Self {
        let shape = LobeShape::from(brdf);
        let brdf = DBrdf::from(brdf);
        let view_n = normal.dot(view);
        let across = view - view_n * normal;
        let tangent = across.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        let angle = view.dot(tangent).atan2(view_n);
        let colors = |row: Vec<[f64; 2]>| {
            row.into_iter()
                .map(|[a, b]| brdf.f0 * a + DVec3::splat(f64::from(brdf.lobe.f90()) * b))
                .collect()
        };
        let full = |shape| LobeTable::of(shape, bands, damping).at(angle);
        let specular = if let Lobe::Measured(_) = brdf.lobe {
            let [red_green, blue] = shape.of_measurement().map(full);
            let color = |([r, g], [b, _]): ([f64; 2], [f64; 2])| DVec3::new(r, g, b);
            Specular::Full(red_green.into_iter().zip(blue).map(color).collect())
        } else if brdf.has_specular() {
            match form {
                Form::Full => Specular::Full(colors(full(shape))),
                Form::Zonal => {
                    let ([x, z], row) = ZonalTable::of(shape, bands, damping).at(angle);
                    Specular::Zonal(x * tangent + z * normal, colors(row))
                }
            }
        } else {
            Specular::None
        };
        let [entering, fall] = diffuse::transmission(&brdf);
        let lobes = diffuse::lobes(bands, damping);
        Self {
            frame: [tangent, normal.cross(tangent), normal],
            lambert: brdf.diffuse * (FRAC_1_PI * brdf.transmission(view_n)),
            basis: Basis::new(bands),
            diffuse: lobes.into_iter().map(|[k, g]| entering * k - fall * g).collect(),
            specular,
        }
    }

    /// Its Lambertian lobe alone.
    pub fn lambertian(self) -> Self {
        Self { specular: Specular::None, ..self }
    }

    /// The double product of both lobes with light of these coefficients in [`Self::frame`].
    ///
    /// # Panics
    /// Where the specular lobe is zonal.
    pub fn product(&self, light: &[f64]) -> DVec3 {
        let bands = self.diffuse.len();
        let zonal = |l: usize| {
            let scale = (4.0 * PI / (2 * l + 1) as f64).sqrt();
            self.diffuse[l] * scale * light[index(l, 0)]
        };
        let diffuse: f64 = (0..bands).map(zonal).sum();
        let specular = match &self.specular {
            Specular::None => DVec3::ZERO,
            Specular::Full(lobe) => full_dot(light, lobe, bands),
            Specular::Zonal(..) => panic!("a zonal lobe has no coefficients"),
        };
        self.lambert * diffuse + specular
    }

    /// The double product of the Lambertian lobe, over [`Self::lambert`], with a cap of these scales about
    /// a direction at this cosine from the normal.
    pub fn diffuse_product(&self, cosine: f64, scales: &[f64]) -> f64 {
        zonal_dot(scales, cosine, &self.diffuse)
    }

    /// That of the specular lobe.
    pub fn specular_product(&self, direction: DVec3, scales: &[f64]) -> DVec3 {
        match &self.specular {
            Specular::None => DVec3::ZERO,
            Specular::Full(lobe) => {
                let local = self.frame.map(|axis| axis.dot(direction));
                let mut light = vec![0.0; count(scales.len())];
                rotate(&self.basis, scales, local, &mut light);
                full_dot(&light, lobe, scales.len())
            }
            Specular::Zonal(axis, lobe) => DVec3::from_array([0, 1, 2].map(|channel| {
                let lobe: Vec<_> = lobe.iter().map(|scale| scale[channel]).collect();
                zonal_dot(scales, axis.dot(direction), &lobe)
            })),
        }
    }
}

/// Of coefficients and those of m ≥ 0 of a lobe.
fn full_dot(light: &[f64], lobe: &[DVec3], bands: usize) -> DVec3 {
    let orders = (0..bands).flat_map(|l| (0..=l).map(move |m| (l, m)));
    orders.map(|(l, m)| light[index(l, m as isize)] * lobe[even_index(l, m)]).sum()
}

/// Σ_l c_l f_l P_l(cosine), where f_l holds the (2l + 1)/4π that `evaluate` brings.
fn zonal_dot(scales: &[f64], cosine: f64, lobe: &[f64]) -> f64 {
    let weighted = |(l, (c, f)): (usize, (&f64, &f64))| c * f * 4.0 * PI / (2 * l + 1) as f64;
    let products: Vec<_> = scales.iter().zip(lobe).enumerate().map(weighted).collect();
    evaluate(&products, cosine)
}
