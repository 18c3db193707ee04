//! The same estimator in f64 on the CPU.

use glam::DVec3;
use manylights_gpu::SurfaceRecord;
use manylights_scene::DBrdf;
use manylights_virtual_lights::VirtualLight;

use crate::Settings;

/// Radiance from `surface` towards `camera`, summed over `lights`: the formula of the crate's head,
/// in f64, from the same f32 inputs.
pub fn radiance(
    surface: &SurfaceRecord,
    camera: DVec3,
    lights: &[VirtualLight],
    settings: &Settings,
) -> DVec3 {
    if surface.triangle == SurfaceRecord::NO_TRIANGLE {
        return DVec3::ZERO;
    }
    lights.iter().map(|light| contribution(surface, camera, light, settings)).sum()
}

fn contribution(
    surface: &SurfaceRecord,
    camera: DVec3,
    light: &VirtualLight,
    settings: &Settings,
) -> DVec3 {
    let position = surface.position.as_dvec3();
    let normal = surface.normal.as_dvec3().normalize();
    let offset = light.position.as_dvec3() - position;
    // A light at the shaded point itself: both cosines are 0.
    let Some(w) = offset.try_normalize() else { return DVec3::ZERO };
    let distance = offset.length();
    let cosine = normal.dot(w).max(0.0);
    let emitted = light.geometric_normal.as_dvec3().normalize().dot(-w).max(0.0);
    let falloff = match settings.attenuation_radius {
        None => 1.0 / (distance * distance),
        Some(radius) => attenuation(distance, radius.into()),
    };
    let mut geometry = cosine * emitted * falloff;
    if let Some(clamp) = settings.clamp {
        geometry = geometry.min(clamp.into());
    }
    if geometry == 0.0 {
        return DVec3::ZERO;
    }
    let reflected = DBrdf::from(surface.brdf()).eval(normal, (camera - position).normalize(), w);
    let emission = DBrdf::from(light.brdf).eval(
        light.normal.as_dvec3().normalize(),
        -w,
        light.incoming.as_dvec3().normalize(),
    );
    light.flux.as_dvec3() * reflected * emission * geometry
}

/// Yuksel's attenuation (thesis 5.18) without cancellation, m⁻².
pub fn attenuation(distance: f64, radius: f64) -> f64 {
    let s = (distance * distance + radius * radius).sqrt();
    2.0 / (s * (s + distance))
}
