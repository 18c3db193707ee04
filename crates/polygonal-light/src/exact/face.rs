//! Triangles of light.

use glam::{DVec3, Vec3};
use manylights_scene::AreaLight;

/// A triangle with an area that is not black.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub(super) corners: [Vec3; 3],
    pub(super) radiance: Vec3,
    pub(super) two_sided: bool,
}

impl Face {
    pub(super) fn new(light: &AreaLight) -> Option<Self> {
        let AreaLight::Triangle { corners, radiance, two_sided } = *light else { return None };
        let face = Self { corners, radiance, two_sided };
        // In f32 as well.
        let has_area = face.across().length() as f32 > 0.0;
        (has_area && radiance != Vec3::ZERO).then_some(face)
    }

    /// Twice its area along the normal of its front.
    pub(super) fn across(&self) -> DVec3 {
        let [a, b, c] = self.corners.map(|corner| corner.as_dvec3());
        (b - a).cross(c - a)
    }
}
