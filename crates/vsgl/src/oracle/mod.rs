//! The same estimator in f64 on the CPU: from texels to lights ([`filter()`]), and from lights to
//! radiance.

mod filter;
pub mod gaussian;
pub mod reflection;

use std::f64::consts::{FRAC_1_PI, TAU};

use glam::{DMat3, DVec3};
use manylights_gpu::SurfaceRecord;
use manylights_scene::DBrdf;

use crate::{GaussianLight, Settings, SpecularLobe};
use gaussian::{Gaussian, SHARPEST, clamped_cosine, integral};
use reflection::{Reflection, anisotropic, filtered};

pub use filter::{DGaussianLobe, DIFFUSE_SHARPNESS, albedo, exact_albedo, filter};

impl From<&crate::GaussianLobe> for DGaussianLobe {
    fn from(lobe: &crate::GaussianLobe) -> Self {
        Self {
            position: lobe.position.as_dvec3(),
            variance: lobe.variance.into(),
            axis: lobe.axis.as_dvec3(),
            sharpness: lobe.sharpness.into(),
            power: lobe.power.as_dvec3(),
        }
    }
}

impl DGaussianLobe {
    /// The radiance that arrives at a place, as a Gaussian of directions towards the light, and its
    /// factor in W·m⁻²·sr⁻¹.
    pub fn incident(&self, place: DVec3) -> (Gaussian, DVec3) {
        let offset = self.position - place;
        let distance2 = offset.length_squared();
        let variance = self.variance.max(distance2 / SHARPEST).max(1e-30);
        let cloud = Gaussian {
            axis: offset.try_normalize().unwrap_or(-self.axis),
            sharpness: distance2 / variance,
            log_amplitude: 0.0,
        };
        let emission = Gaussian { axis: -self.axis, sharpness: self.sharpness, log_amplitude: 0.0 };
        let strength = self.power / (TAU * integral(self.sharpness) * variance);
        (emission.product(&cloud), strength)
    }
}

/// Radiance from `surface` towards `camera`, summed over `lights`: the estimator of the crate's head,
/// in f64, from the same f32 inputs.
pub fn radiance(
    surface: &SurfaceRecord,
    camera: DVec3,
    lights: &[GaussianLight],
    settings: &Settings,
) -> DVec3 {
    if surface.triangle == SurfaceRecord::NO_TRIANGLE {
        return DVec3::ZERO;
    }
    let receiver = Receiver::new(surface, camera);
    let lobes = lights.iter().flat_map(|light| [&light.diffuse, &light.specular]);
    let present = lobes.filter(|lobe| lobe.power.max_element() > 0.0);
    present.map(|lobe| receiver.reflect(&lobe.into(), settings.lobe)).sum()
}

/// A shaded point with its frame: tangent towards the view, bitangent, normal.
pub struct Receiver {
    position: DVec3,
    /// From local directions to those of the world.
    pub frame: DMat3,
    /// Local unit direction to the camera.
    pub view: DVec3,
    /// Its reflectance.
    pub brdf: DBrdf,
}

impl Receiver {
    /// The surface as `camera` sees it.
    pub fn new(surface: &SurfaceRecord, camera: DVec3) -> Self {
        let position = surface.position.as_dvec3();
        let normal = surface.normal.as_dvec3().normalize();
        let to_camera = (camera - position).normalize();
        let across = to_camera - normal.dot(to_camera) * normal;
        let tangent = across.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        let frame = DMat3::from_cols(tangent, normal.cross(tangent), normal);
        let view = frame.transpose() * to_camera;
        Self { position, frame, view, brdf: DBrdf::from(surface.brdf()) }
    }

    /// Radiance that one lobe of a light causes.
    pub fn reflect(&self, lobe: &DGaussianLobe, by: SpecularLobe) -> DVec3 {
        let (light, strength) = lobe.incident(self.position);
        let axis = self.frame.transpose() * light.axis;
        strength * light.log_amplitude.exp() * self.response(axis, light.sharpness, by)
    }

    /// ∫ G f_x ⟨n·w⟩ dw for a Gaussian of amplitude 1 about a local direction.
    pub fn response(&self, axis: DVec3, sharpness: f64, by: SpecularLobe) -> DVec3 {
        let cosine = clamped_cosine(axis.z, sharpness);
        let lambert = self.brdf.diffuse * (FRAC_1_PI * cosine.integral);
        if !self.brdf.has_specular() {
            return lambert;
        }
        let coupling = self.brdf.transmission(self.view.z) * self.brdf.transmission(cosine.mean);
        let Reflection { integral, dominant } = match by {
            SpecularLobe::Anisotropic => anisotropic(self.brdf.alpha, self.view, axis, sharpness),
            SpecularLobe::Filtered => filtered(self.brdf.alpha, self.view, axis, sharpness),
        };
        let half = (0.5 + 0.5 * self.view.dot(dominant)).max(0.0).sqrt();
        lambert * coupling + self.brdf.fresnel(half) * integral
    }
}
