//! `shaders/product.wesl` in f64, from tables of integrals instead of generated lines.

use std::f64::consts::FRAC_1_PI;
use std::sync::{Arc, Mutex};

use glam::DVec3;
use manylights_harmonics::clamped_cosine::{self, Folded, Local};
use manylights_harmonics::product::{self, Product, diffuse_from_specular};
use manylights_harmonics::rotation::Zxzxz;
use manylights_harmonics::wgsl::CUT;
use manylights_harmonics::zonal::rotate;
use manylights_harmonics::{Basis, count};
use manylights_scene::{Brdf, DBrdf, Lobe};

use crate::diffuse::{addition, lobes, mirrored_grazing, transmission};
use crate::mirror::MirrorTable;
use crate::{CosineProduct, Damping, Diffuse, LobeShape};

/// A shaded point that sums the light's coefficients.
pub struct ProductReceiver {
    settings: (CosineProduct, Diffuse),
    basis: Basis<f64>,
    /// Tangent, bitangent, normal.
    frame: [DVec3; 3],
    mirror: DVec3,
    /// Lambertian reflectance times the transmission towards the camera, sr⁻¹.
    lambert: DVec3,
    /// Of the transmission towards the light: x − y (1 − cosine)⁵.
    entering: [f64; 2],
    /// Scales of the specular lobe about the mirror direction; none where there is none.
    specular: Vec<DVec3>,
    /// Coefficients of three channels.
    light: [Vec<f64>; 3],
    integrals: Arc<Integrals>,
}

/// Tables of a product.
enum Integrals {
    General(Product<f64>),
    Folded(Folded<f64>),
    Local(Local<f64>),
    Turned(Local<f64>, Zxzxz<f64>),
}

impl Integrals {
    /// Made once: those of 9 bands take longer than a picture.
    fn of(product: CosineProduct, bands: usize) -> Arc<Self> {
        type Made = Vec<((CosineProduct, usize), Arc<Integrals>)>;
        static MADE: Mutex<Made> = Mutex::new(Vec::new());
        let mut made = MADE.lock().unwrap_or_else(|poison| poison.into_inner());
        let key = (product, bands);
        if let Some((_, found)) = made.iter().find(|(known, _)| *known == key) {
            return found.clone();
        }
        let integrals = Arc::new(match product {
            CosineProduct::General => Self::General(Product::new(bands)),
            CosineProduct::Folded => Self::Folded(Folded::new(bands, bands)),
            CosineProduct::FoldedCut => Self::Folded(Folded::new(bands, bands.min(CUT))),
            CosineProduct::Local => Self::Local(Local::new(bands)),
            CosineProduct::Turned => Self::Turned(Local::new(bands), Zxzxz::new(bands)),
        });
        made.push((key, integrals.clone()));
        integrals
    }
}

impl ProductReceiver {
    /// In the dark; `normal` and `view` are unit vectors.
    pub fn new(
        brdf: Brdf,
        [normal, view]: [DVec3; 2],
        bands: usize,
        product: CosineProduct,
        diffuse: Diffuse,
    ) -> Self {
        let shape = LobeShape::from(brdf);
        let brdf = DBrdf::from(brdf);
        let view_n = normal.dot(view);
        let across = view - view_n * normal;
        let tangent = across.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        let angle = view.dot(tangent).atan2(view_n);
        let row = |shape| MirrorTable::of(shape, bands).at(angle);
        let f90 = f64::from(brdf.lobe.f90());
        let specular = if let Lobe::Measured(_) = brdf.lobe {
            let [red_green, blue] = shape.of_measurement().map(row);
            let color = |([r, g], [b, _]): ([f64; 2], [f64; 2])| DVec3::new(r, g, b);
            red_green.into_iter().zip(blue).map(color).collect()
        } else if brdf.has_specular() {
            row(shape).into_iter().map(|[a, b]| brdf.f0 * a + DVec3::splat(f90 * b)).collect()
        } else {
            Vec::new()
        };
        Self {
            settings: (product, diffuse),
            basis: Basis::new(bands),
            frame: [tangent, normal.cross(tangent), normal],
            mirror: 2.0 * view_n * normal - view,
            lambert: brdf.diffuse * (FRAC_1_PI * brdf.transmission(view_n)),
            entering: transmission(&brdf),
            specular,
            light: [0, 1, 2].map(|_| vec![0.0; count(bands)]),
            integrals: Integrals::of(product, bands),
        }
    }

    /// Adds a zonal function of these scales about a unit direction, times the radiance.
    pub fn add(&mut self, direction: DVec3, scales: &[f64], radiance: DVec3) {
        let local = self.settings.0.is_local();
        let axis = if local { self.to_frame(direction) } else { direction };
        let mut coefficients = vec![0.0; count(scales.len())];
        rotate(&self.basis, scales, axis.to_array(), &mut coefficients);
        for (light, radiance) in self.light.iter_mut().zip(radiance.to_array()) {
            for (sum, value) in light.iter_mut().zip(&coefficients) {
                *sum += radiance * value;
            }
        }
    }

    /// Towards the view, W·m⁻²·sr⁻¹. Negative where the expansion is.
    pub fn radiance(&self) -> DVec3 {
        let channels = [0, 1, 2].map(|channel| self.of_channel(channel));
        DVec3::from_array(channels)
    }

    fn of_channel(&self, channel: usize) -> f64 {
        let (way, diffuse) = self.settings;
        let light = &self.light[channel];
        let product = self.under_cosine(light);
        let in_frame = way.is_in_frame();
        let place = |direction, frame| if frame { self.to_frame(direction) } else { direction };
        let [normal, mirror] =
            [self.frame[2], self.mirror].map(|direction| place(direction, in_frame));
        let [entering, fall] = self.entering;
        let bands = self.basis.bands();
        let irradiance = match diffuse {
            Diffuse::Product => {
                let grazing = mirrored_grazing(bands).into_iter().enumerate();
                let scales = grazing.map(|(l, value)| value / addition(l).sqrt());
                let grazing = self.against(&product, normal, scales.collect());
                entering * diffuse_from_specular(&product) - fall * grazing
            }
            Diffuse::ThreeBands => {
                let pairs = lobes(bands, Damping::None).into_iter().enumerate();
                let scale = |(l, [k, g]): (usize, [f64; 2])| {
                    if l < CUT { (entering * k - fall * g) / addition(l) } else { 0.0 }
                };
                let normal = place(self.frame[2], way.is_local());
                self.against(light, normal, pairs.map(scale).collect())
            }
        };
        let mut radiance = self.lambert[channel] * irradiance;
        if !self.specular.is_empty() {
            let scales = self.specular.iter().map(|scale| scale[channel]).collect();
            radiance += self.against(&product, mirror, scales);
        }
        radiance
    }

    /// Coefficients of light and cosine.
    fn under_cosine(&self, light: &[f64]) -> Vec<f64> {
        let bands = self.basis.bands();
        let mut product = vec![0.0; light.len()];
        let normal = self.frame[2].to_array();
        match &*self.integrals {
            Integrals::General(table) => {
                let (mut scales, mut cosine) = (vec![0.0; bands], product.clone());
                clamped_cosine::scales(&mut scales);
                rotate(&self.basis, &scales, normal, &mut cosine);
                table.apply(light, &cosine, &mut product);
            }
            Integrals::Folded(table) => {
                let mut y = vec![0.0; light.len()];
                self.basis.evaluate(normal, &mut y);
                table.apply(light, &y[..count(table.cosine_bands())], &mut product);
            }
            Integrals::Local(table) => table.apply(light, &mut product),
            Integrals::Turned(table, turn) => {
                let to_frame = self.frame.map(|axis| axis.to_array());
                table.apply_turned(turn, to_frame, &mut light.to_vec(), &mut product);
            }
        }
        product
    }

    /// ∫ f z of a zonal function z of these scales about an axis.
    fn against(&self, f: &[f64], axis: DVec3, scales: Vec<f64>) -> f64 {
        let mut zonal = vec![0.0; f.len()];
        rotate(&self.basis, &scales, axis.to_array(), &mut zonal);
        product::double(f, &zonal)
    }

    fn to_frame(&self, direction: DVec3) -> DVec3 {
        DVec3::from_array(self.frame.map(|axis| axis.dot(direction)))
    }
}
