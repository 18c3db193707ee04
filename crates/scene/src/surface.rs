//! A point on a surface, as a ray or a raster map finds it.

use glam::Vec3;

use crate::Brdf;

/// What shading needs to know of a point on a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// World space, metres.
    pub position: Vec3,
    /// Unit normal of the triangle's plane, facing the arriving ray. It decides which side is which,
    /// and it is the cosine of area measure: flux leaves a patch through its geometry.
    pub geometric_normal: Vec3,
    /// Unit shading normal on the same side: the cosine of the reflection integral.
    pub normal: Vec3,
    /// Index into [`crate::Scene::triangles`].
    pub triangle: u32,
    /// Index into [`crate::Scene::materials`].
    pub material: u32,
    /// Reflectance with textures applied.
    pub brdf: Brdf,
    /// Emitted radiance towards the arriving ray's origin, W·m⁻²·sr⁻¹.
    pub emission: Vec3,
}

impl SurfacePoint {
    /// The same point with the shading normal replaced by the geometric one where the shading normal
    /// faces away from the viewer (`to_viewer`, unit). Applied to primary hits alone, by the
    /// reference and the G-buffer alike, so that silhouettes of coarse meshes are not black.
    pub fn facing(self, to_viewer: Vec3) -> Self {
        if self.normal.dot(to_viewer) > 0.0 {
            self
        } else {
            Self { normal: self.geometric_normal, ..self }
        }
    }
}
