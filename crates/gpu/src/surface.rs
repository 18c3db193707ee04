//! What a ray sees.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_scene::{Brdf, Lobe};

/// A texel of the G-buffer or of a reflective shadow map, as `shaders/surface.wesl` lays it out.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct SurfaceRecord {
    /// World space, metres.
    pub position: Vec3,
    /// GGX width.
    pub alpha: f32,
    /// Unit shading normal, on the viewer's side.
    pub normal: Vec3,
    /// What the specular lobe is, see [`Lobe::slot`].
    pub f90: f32,
    /// Albedo of the Lambertian lobe.
    pub diffuse: Vec3,
    /// Index of the triangle; [`SurfaceRecord::NO_TRIANGLE`] where the ray left the scene.
    pub triangle: u32,
    /// Specular reflectance at normal incidence.
    pub f0: Vec3,
    /// Index of the material.
    pub material: u32,
}

impl SurfaceRecord {
    /// Marks a texel without a surface.
    pub const NO_TRIANGLE: u32 = u32::MAX;

    /// A point of triangle 0 and material 0, for gathers of points that no scene holds.
    pub fn new(position: Vec3, normal: Vec3, brdf: Brdf) -> Self {
        let Brdf { diffuse, f0, lobe, alpha } = brdf;
        let f90 = lobe.slot();
        Self { position, alpha, normal, f90, diffuse, triangle: 0, f0, material: 0 }
    }

    /// Its reflectance.
    pub fn brdf(&self) -> Brdf {
        let Self { diffuse, f0, f90, alpha, .. } = *self;
        Brdf { diffuse, f0, lobe: Lobe::from_slot(f90), alpha }
    }
}
