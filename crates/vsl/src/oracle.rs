//! The same estimator in f64 on the CPU, with the same samples.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3};
use manylights_gpu::SurfaceRecord;
use manylights_scene::DBrdf;
use manylights_virtual_lights::VirtualLight;

use crate::noise::{light_key, samples};
use crate::{Sampling, Settings, VirtualSphere};

/// Radiance of the surface at `pixel` towards `camera`, summed over `lights`: the estimator of the
/// crate's head, in f64, from the same f32 inputs.
pub fn radiance(
    pixel: usize,
    surface: &SurfaceRecord,
    camera: DVec3,
    lights: &[VirtualSphere],
    settings: &Settings,
    seed: u64,
) -> DVec3 {
    if surface.triangle == SurfaceRecord::NO_TRIANGLE {
        return DVec3::ZERO;
    }
    let receiver = Receiver::new(surface, camera);
    let contribution = |(index, sphere)| {
        let samples = samples(pixel, light_key(index, seed), settings.directions);
        receiver.estimate(sphere, settings, samples)
    };
    lights.iter().enumerate().map(contribution).sum()
}

/// A shaded point with its frame: tangent towards the view, bitangent, normal. Directions are local.
pub struct Receiver {
    position: DVec3,
    frame: DMat3,
    view: DVec3,
    brdf: DBrdf,
    /// Probability of the specular lobe.
    share: f64,
}

/// The cone of a light and what multiplies the mean over it.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Unit, towards the light's centre.
    pub axis: DVec3,
    /// 1 − cos a.
    pub height: f64,
    /// |Ω|/(πr²), m⁻².
    pub falloff: f64,
}

impl Receiver {
    /// The surface as `camera` sees it.
    pub fn new(surface: &SurfaceRecord, camera: DVec3) -> Self {
        let position = surface.position.as_dvec3();
        let normal = surface.normal.as_dvec3().normalize();
        let to_camera = (camera - position).normalize();
        let across = to_camera - normal.dot(to_camera) * normal;
        let helper = if normal.x.abs() > 0.5 { DVec3::Y } else { DVec3::X };
        let tangent = if across.length_squared() > 1e-12 { across } else { normal.cross(helper) };
        let tangent = tangent.normalize();
        let frame = DMat3::from_cols(tangent, normal.cross(tangent), normal);
        let view = frame.transpose() * to_camera;
        let brdf = DBrdf::from(surface.brdf());
        let share = brdf.specular_share(view.z);
        Self { position, frame, view, brdf, share }
    }

    /// The cone of a sphere; none for a point light at the shaded point.
    pub fn cone(&self, sphere: &VirtualSphere) -> Option<Cone> {
        let radius2 = f64::from(sphere.radius).powi(2);
        let offset = sphere.light.position.as_dvec3() - self.position;
        let distance2 = offset.length_squared();
        let axis = match offset.try_normalize() {
            Some(axis) => self.frame.transpose() * axis,
            None if radius2 > 0.0 => DVec3::Z,
            None => return None,
        };
        let outer2 = distance2.max(radius2);
        let falloff = 2.0 / (outer2 + (outer2 * (distance2 - radius2).max(0.0)).sqrt());
        Some(Cone { axis, height: 0.5 * falloff * radius2, falloff })
    }

    /// Φ f_x ⟨n_x·w⟩ f_j ⟨n_j·−w⟩ of a local direction.
    pub fn integrand(&self, light: &VirtualLight, w: DVec3) -> DVec3 {
        let world = self.frame * w;
        let emitted = light.geometric_normal.as_dvec3().normalize().dot(-world);
        if w.z <= 0.0 || emitted <= 0.0 {
            return DVec3::ZERO;
        }
        let emission = DBrdf::from(light.brdf).eval(
            light.normal.as_dvec3().normalize(),
            -world,
            light.incoming.as_dvec3().normalize(),
        );
        let reflected = self.brdf.eval(DVec3::Z, self.view, w);
        light.flux.as_dvec3() * emission * reflected * (w.z * emitted)
    }

    fn estimate(
        &self,
        sphere: &VirtualSphere,
        settings: &Settings,
        samples: impl Iterator<Item = [f64; 2]>,
    ) -> DVec3 {
        let Some(cone) = self.cone(sphere) else { return DVec3::ZERO };
        let Settings { sampling, .. } = *settings;
        if sphere.radius == 0.0 && sampling == Sampling::Brdf {
            return cone.falloff * self.integrand(&sphere.light, cone.axis);
        }
        let weighted = |w| {
            let brdf = if sampling.has_brdf() { self.density(w) * TAU * cone.height } else { 0.0 };
            let density = brdf + if sampling.has_cone() { 1.0 } else { 0.0 };
            let value = self.integrand(&sphere.light, w);
            if value == DVec3::ZERO { value } else { value / density }
        };
        let sample = |[u, azimuth]: [f64; 2]| {
            let around = DVec2::from_angle(azimuth);
            let mut sum = DVec3::ZERO;
            if sampling.has_cone() {
                sum += weighted(cone.direction(u, around));
            }
            if sampling.has_brdf() {
                let w = self.reflected(u, around);
                if (w - cone.axis).length_squared() < 2.0 * cone.height {
                    sum += weighted(w);
                }
            }
            sum
        };
        let sum: DVec3 = samples.map(sample).sum();
        sum * (cone.falloff / f64::from(settings.directions))
    }

    /// A direction that follows the lobes.
    fn reflected(&self, u: f64, around: DVec2) -> DVec3 {
        if u >= self.share {
            let u = (u - self.share) / (1.0 - self.share);
            return (u.sqrt() * around).extend((1.0 - u).sqrt());
        }
        // Dupuy and Benyoub 2023, listing 1.
        let u = u / self.share;
        let stretch = DVec3::new(self.brdf.alpha, self.brdf.alpha, 1.0);
        let standard = (stretch * self.view).normalize();
        let z = (1.0 - u) * (1.0 + standard.z) - standard.z;
        let cap = ((1.0 - z * z).max(0.0).sqrt() * around).extend(z);
        let h = (stretch * (cap + standard)).normalize();
        2.0 * self.view.dot(h) * h - self.view
    }

    /// Density of [`Self::reflected`], sr⁻¹ (Heitz 2018, eq. 17 for the specular lobe).
    fn density(&self, w: DVec3) -> f64 {
        let cosine = (1.0 - self.share) * w.z.max(0.0) / PI;
        let n_v = self.view.z;
        match (self.view + w).try_normalize() {
            Some(h) if self.share > 0.0 && h.z > 0.0 => {
                let a2 = self.brdf.alpha.powi(2);
                let masking = n_v + (a2 + (1.0 - a2) * n_v * n_v).sqrt();
                cosine + self.share * self.brdf.distribution(DVec3::Z, h) / (2.0 * masking)
            }
            _ => cosine,
        }
    }
}

impl Cone {
    /// Uniform over the cone for u in [0, 1] and a unit vector; the frame is that of
    /// `shaders/sampling.wesl`.
    pub fn direction(&self, u: f64, around: DVec2) -> DVec3 {
        let lowered = u * self.height;
        let sine = (lowered * (2.0 - lowered)).sqrt();
        let flat = self.axis.truncate();
        let side = flat.dot(around);
        let s = 1.0 / (1.0 + self.axis.z).max(1e-6);
        let across = (around - flat * (side * s)).extend(-side);
        (1.0 - lowered) * self.axis + sine * across
    }
}
