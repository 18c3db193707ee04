//! Virtual spherical lights as the gather reads them from uniform memory.

use std::f32::consts::FRAC_1_PI;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::VirtualSphere;
use crate::noise::light_key;

/// What all lights have: 48 bytes.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct LambertLight {
    position: Vec3,
    radius2: f32,
    geometric_normal: Vec3,
    key: u32,
    /// Φ ρ/π, W·sr⁻¹; on glossy surfaces times the transmission towards the primary light.
    intensity: Vec3,
    /// α² on glossy surfaces.
    alpha2: f32,
}

/// A light on a glossy surface: 128 bytes. The frame is that of `glossy()` in `brdf.wesl`, with the
/// direction to the primary light as its view.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct GlossyLight {
    base: LambertLight,
    normal: Vec3,
    view_n: f32,
    tangent: Vec3,
    view_t: f32,
    bitangent: Vec3,
    smith_view: f32,
    f0: Vec3,
    f90: f32,
    /// Φ, W.
    flux: Vec3,
    padding: f32,
}

impl LambertLight {
    /// The light of this index in the picture's list.
    pub(crate) fn new(index: usize, sphere: &VirtualSphere, seed: u64) -> Self {
        let VirtualSphere { light, radius } = sphere;
        Self {
            position: light.position,
            radius2: radius * radius,
            geometric_normal: light.geometric_normal,
            key: light_key(index, seed),
            intensity: light.flux * light.brdf.diffuse * FRAC_1_PI,
            alpha2: light.brdf.alpha * light.brdf.alpha,
        }
    }
}

impl GlossyLight {
    pub(crate) fn new(index: usize, sphere: &VirtualSphere, seed: u64) -> Self {
        let light = &sphere.light;
        let brdf = &light.brdf;
        let view_n = light.normal.dot(light.incoming);
        let tangent = light.tangent();
        let mut base = LambertLight::new(index, sphere, seed);
        base.intensity *= brdf.transmission(view_n);
        Self {
            base,
            normal: light.normal,
            view_n,
            tangent,
            view_t: light.incoming.dot(tangent),
            bitangent: light.normal.cross(tangent),
            smith_view: (base.alpha2 + (1.0 - base.alpha2) * view_n * view_n).sqrt(),
            f0: brdf.f0,
            f90: brdf.lobe.light_slot(),
            flux: light.flux,
            padding: 0.0,
        }
    }
}
