//! Spheres of light as the gather reads them from uniform memory.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use manylights_scene::{Brdf, Lobe};
use manylights_virtual_lights::VirtualSphere;

use crate::emission;
use manylights_reflectance::LobeShape;

/// The sphere with its light as `GlossyLight` holds it, where it lies on a glossy surface: directions
/// to 6.5e-5, reflectances and the inverse of an index of refraction to 8e-6.
pub fn rounded(sphere: &VirtualSphere) -> VirtualSphere {
    let mut light = sphere.light;
    if light.brdf.has_specular() {
        let round = |unit: &mut Vec3| *unit = unpack_direction(pack_direction(*unit));
        round(&mut light.geometric_normal);
        round(&mut light.normal);
        round(&mut light.incoming);
        light.brdf = rounded_brdf(light.brdf);
    }
    VirtualSphere { light, radius: sphere.radius }
}

/// A sphere that emits alike in all directions: 48 bytes.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct LambertLight {
    position: Vec3,
    radius: f32,
    geometric_normal: Vec3,
    padding0: f32,
    /// Radiant intensity along the normal, W·sr⁻¹: Φ ρ/π; on a glossy surface whose emission is expanded
    /// in one band, Φ times the mean of its reflectance.
    intensity: Vec3,
    padding1: f32,
}

/// A sphere on a glossy surface: 64 bytes.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct GlossyLight {
    position: Vec3,
    radius: f32,
    /// Φ, W.
    flux: Vec3,
    alpha: f32,
    /// Geometric normal, shading normal, direction to the primary light: see [`pack_direction`].
    directions: [u32; 3],
    /// First element of its row in the table of emissions, where emission is expanded.
    row: u32,
    /// diffuse, f0, f90, 1/index in 16 bits each: see [`pack_reflectance`].
    reflectance: [u32; 4],
}

impl LambertLight {
    pub(crate) fn new(sphere: &VirtualSphere) -> Self {
        let light = &sphere.light;
        let reflectance = emission::reflectance(light, light.normal.as_dvec3(), 1);
        Self {
            position: light.position,
            radius: sphere.radius,
            geometric_normal: light.geometric_normal,
            intensity: light.flux * reflectance.as_vec3(),
            ..Self::zeroed()
        }
    }
}

impl GlossyLight {
    pub(crate) fn new(sphere: &VirtualSphere, row: u32) -> Self {
        let light = &sphere.light;
        let directions = [light.geometric_normal, light.normal, light.incoming];
        Self {
            position: light.position,
            radius: sphere.radius,
            flux: light.flux,
            alpha: light.brdf.alpha,
            directions: directions.map(pack_direction),
            row,
            reflectance: pack_reflectance(&light.brdf),
        }
    }
}

/// The shape of a light on a surface of this shape.
pub(crate) fn rounded_shape(shape: LobeShape) -> LobeShape {
    if shape.is_measured() { shape } else { rounded_brdf(shape.brdf()).into() }
}

/// A measurement's is that of its table.
fn rounded_brdf(brdf: Brdf) -> Brdf {
    match brdf.lobe {
        Lobe::Measured(_) => brdf,
        _ => unpack_reflectance(pack_reflectance(&brdf), brdf.alpha),
    }
}

/// Octahedral coordinates (Meyer et al. 2010) in `unpack2x16snorm`.
fn pack_direction(unit: Vec3) -> u32 {
    let sum = unit.abs().element_sum();
    let mut plane = unit.truncate() / sum;
    if unit.z < 0.0 {
        plane = (1.0 - Vec2::new(plane.y, plane.x).abs()) * plane.signum();
    }
    let [x, y] = plane.to_array().map(|c| (c.clamp(-1.0, 1.0) * 32767.0).round() as i16);
    u32::from(x as u16) | u32::from(y as u16) << 16
}

fn unpack_direction(packed: u32) -> Vec3 {
    let [x, y] = [packed as u16, (packed >> 16) as u16].map(|c| f32::from(c as i16) / 32767.0);
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    Vec3::new(x - fold.copysign(x), y - fold.copysign(y), z).normalize()
}

/// Eight values of 0 … 1 in `unpack2x16unorm`; the last one is 1/index of an exact Fresnel term, 0 for
/// Schlick's, and 1/65535 marks a measurement, whose Lambertian lobe is stored as black.
fn pack_reflectance(brdf: &Brdf) -> [u32; 4] {
    let [d, f] = match brdf.lobe {
        Lobe::Measured(_) => [Vec3::ZERO, Vec3::ONE],
        _ => [brdf.diffuse, brdf.f0],
    };
    let inverse = match brdf.lobe {
        Lobe::Dielectric { index } => 1.0 / index,
        Lobe::Schlick { .. } => 0.0,
        Lobe::Measured(_) => 1.0 / 65535.0,
    };
    let bits = |value: f32| (value.clamp(0.0, 1.0) * 65535.0).round() as u32;
    [[d.x, d.y], [d.z, f.x], [f.y, f.z], [brdf.lobe.f90(), inverse]]
        .map(|[a, b]| bits(a) | bits(b) << 16)
}

fn unpack_reflectance(packed: [u32; 4], alpha: f32) -> Brdf {
    let value = |bits: u32| bits as f32 / 65535.0;
    let [a, b, c, d] = packed.map(|pair| [value(pair & 0xffff), value(pair >> 16)]);
    let lobe = match d {
        [f90, 0.0] => Lobe::Schlick { f90 },
        [_, inverse] => Lobe::Dielectric { index: 1.0 / inverse },
    };
    Brdf { diffuse: Vec3::new(a[0], a[1], b[0]), f0: Vec3::new(b[1], c[0], c[1]), lobe, alpha }
}

const _: () = assert!(size_of::<LambertLight>() == 48 && size_of::<GlossyLight>() == 64);
