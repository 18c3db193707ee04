//! The same estimator in f64 on the CPU.

use std::f64::consts::PI;

use glam::DVec3;
use manylights_area_lights::{transformed_cap, transformed_triangle};
use manylights_gpu::SurfaceRecord;
use manylights_paths::closed_form::sphere_irradiance;
use manylights_reflectance::transformed_cosine::{Layered, TransformedCosine, of_surface};
use manylights_scene::DBrdf;

use crate::{Kind, LightRecord};

/// As in the shader: distance, m, below which the point is at a sphere's centre, along the normal.
const COINCIDENT: f64 = 1e-15;

/// Radiance from `surface` towards `camera`, summed over `lights`: the formula of the crate's head, in f64,
/// from the same f32 inputs.
pub fn radiance(surface: &SurfaceRecord, camera: DVec3, lights: &[LightRecord]) -> DVec3 {
    if surface.triangle == SurfaceRecord::NO_TRIANGLE {
        return DVec3::ZERO;
    }
    let position = surface.position.as_dvec3();
    let normal = surface.normal.as_dvec3().normalize();
    let view = (camera - position).normalize();
    let view_n = normal.dot(view);
    let across = view - view_n * normal;
    let tangent = across.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
    let frame = [tangent, normal.cross(tangent), normal];
    let local = |v: DVec3| DVec3::from(frame.map(|axis| axis.dot(v)));
    let brdf = DBrdf::from(surface.brdf());
    let lambert = brdf.diffuse * (brdf.transmission(view_n) / PI);
    let grazing = brdf.transmission(0.0);
    let (cosine_share, layered_share) =
        if brdf.has_specular() { (grazing, brdf.transmission(1.0) - grazing) } else { (1.0, 0.0) };
    let specular = brdf.has_specular().then(|| of_surface(&brdf, view_n));
    let reflected = |light: &LightRecord| {
        let irradiance = |cosine: &TransformedCosine| {
            let corner = light.corner.as_dvec3() - position;
            if light.kind() == Kind::Sphere {
                let distance = corner.length();
                let is_at_center = distance < COINCIDENT;
                let w = if is_at_center { DVec3::Z } else { local(corner / distance) };
                let radius = f64::from(light.radius);
                let sine = if is_at_center { 1.0 } else { (radius / distance).min(1.0) };
                return if *cosine == TransformedCosine::COSINE {
                    sphere_irradiance(w.z, sine)
                } else {
                    transformed_cap(cosine, w, sine)
                };
            }
            let edges = [light.first, light.second].map(|edge| corner + edge.as_dvec3());
            let corners = [corner, edges[0], edges[1]].map(local);
            transformed_triangle(cosine, corners, light.kind() == Kind::TwoSided)
        };
        let mut sum = DVec3::ZERO;
        if cosine_share != 0.0 {
            sum += lambert * (cosine_share * irradiance(&TransformedCosine::COSINE));
        }
        if layered_share != 0.0 {
            let share = layered_share * Layered::ALBEDO;
            sum += lambert * (share * irradiance(&Layered::FITTED.cosine()));
        }
        if let Some((cosine, magnitude)) = &specular {
            sum += *magnitude * irradiance(cosine);
        }
        light.radiance.as_dvec3() * sum
    };
    lights.iter().map(reflected).sum()
}
