//! The same estimator in f64 on the CPU: from texels to lights ([`filter()`]), and from lights to
//! radiance.

mod filter;
pub mod gaussian;
pub mod reflection;

use std::f64::consts::{FRAC_1_PI, TAU};

use glam::{DMat3, DVec3};
use manylights_gpu::SurfaceRecord;
use manylights_scene::DBrdf;

use crate::{Approximation, GaussianLight, Settings};
use gaussian::{Gaussian, SHARPEST, clamped_cosine, gaussian_cosine, integral, visible_share};
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
    let of_light = |light: &GaussianLight| {
        let [diffuse, specular] = [&light.diffuse, &light.specular].map(|lobe| {
            let lobe = DGaussianLobe::from(lobe);
            (lobe.power.max_element() > 0.0).then_some(lobe)
        });
        let cut = settings.cut_behind;
        diffuse.map_or(DVec3::ZERO, |lobe| receiver.reflect(&lobe, cut, settings.lobe))
            + specular.map_or(DVec3::ZERO, |lobe| receiver.reflect(&lobe, false, settings.lobe))
    };
    lights.iter().map(of_light).sum()
}

/// A shaded point with its frame: tangent towards the view, bitangent, normal.
pub struct Receiver {
    position: DVec3,
    /// From local directions to those of the world.
    pub frame: DMat3,
    /// Local unit direction to the camera, but that its cosine is at least 1e-8: a camera that is below
    /// the shading normal's horizon alone sees the surface along it.
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
        let mut view = frame.transpose() * to_camera;
        view.z = view.z.max(1e-8);
        Self { position, frame, view, brdf: DBrdf::from(surface.brdf()) }
    }

    /// Radiance that one lobe of a light causes. A lobe about the normal of its surface may be cut there:
    /// its share above that plane is then all that arrives, and holds all of its power.
    pub fn reflect(&self, lobe: &DGaussianLobe, cut: bool, by: Approximation) -> DVec3 {
        let (light, strength) = lobe.incident(self.position);
        let axis = self.frame.transpose() * light.axis;
        let response = self.response(axis, light.sharpness, by);
        let above = || visible_share(-lobe.axis.dot(light.axis), light.sharpness);
        let share = if cut { above() * (1.0 + (-lobe.sharpness).exp()) } else { 1.0 };
        strength * (share * light.log_amplitude.exp()) * response
    }

    /// ∫ G f_x ⟨n·w⟩ dw for a Gaussian of amplitude 1 about a local direction.
    pub fn response(&self, axis: DVec3, sharpness: f64, by: Approximation) -> DVec3 {
        let cosine = match by {
            Approximation::Thesis => gaussian_cosine(axis.z, sharpness),
            Approximation::Filtered => clamped_cosine(axis.z, sharpness),
        };
        let lambert = self.brdf.diffuse * (FRAC_1_PI * cosine.integral);
        if !self.brdf.has_specular() {
            return lambert;
        }
        let coupling = self.brdf.transmission(self.view.z) * self.brdf.transmission(cosine.mean);
        let Reflection { integral, dominant } = match by {
            Approximation::Thesis => anisotropic(self.brdf.alpha, self.view, axis, sharpness),
            Approximation::Filtered => filtered(self.brdf.alpha, self.view, axis, sharpness),
        };
        let half = (0.5 + 0.5 * self.view.dot(dominant)).max(0.0).sqrt();
        lambert * coupling + self.brdf.fresnel(half) * integral
    }
}
