//! Virtual lights as the gather reads them from uniform memory.

use std::f32::consts::FRAC_1_PI;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_virtual_lights::VirtualLight;

/// A light on a Lambertian surface: 48 bytes.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct LambertLight {
    position: Vec3,
    padding0: f32,
    geometric_normal: Vec3,
    padding1: f32,
    /// Φ ρ/π: radiant intensity along the normal, W·sr⁻¹.
    intensity: Vec3,
    padding2: f32,
}

/// A light on a glossy surface: 128 bytes. The frame is that of `glossy()` in `brdf.wesl`, with the
/// direction to the primary light as its view.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct GlossyLight {
    position: Vec3,
    alpha2: f32,
    geometric_normal: Vec3,
    f90: f32,
    /// Φ ρ/π times the transmission towards the primary light.
    intensity: Vec3,
    view_n: f32,
    normal: Vec3,
    view_t: f32,
    tangent: Vec3,
    smith_view: f32,
    bitangent: Vec3,
    padding0: f32,
    f0: Vec3,
    padding1: f32,
    /// Φ, W.
    flux: Vec3,
    padding2: f32,
}

impl LambertLight {
    pub(crate) fn new(light: &VirtualLight) -> Self {
        Self {
            position: light.position,
            geometric_normal: light.geometric_normal,
            intensity: light.flux * light.brdf.diffuse * FRAC_1_PI,
            ..Self::zeroed()
        }
    }
}

impl GlossyLight {
    pub(crate) fn new(light: &VirtualLight) -> Self {
        let brdf = &light.brdf;
        let view_n = light.normal.dot(light.incoming);
        let tangent = light.tangent();
        let alpha2 = brdf.alpha * brdf.alpha;
        let transmission = brdf.transmission(view_n);
        Self {
            position: light.position,
            alpha2,
            geometric_normal: light.geometric_normal,
            f90: brdf.lobe.light_slot(),
            intensity: light.flux * brdf.diffuse * (FRAC_1_PI * transmission),
            view_n,
            normal: light.normal,
            view_t: light.incoming.dot(tangent),
            tangent,
            smith_view: (alpha2 + (1.0 - alpha2) * view_n * view_n).sqrt(),
            bitangent: light.normal.cross(tangent),
            f0: brdf.f0,
            flux: light.flux,
            ..Self::zeroed()
        }
    }
}
