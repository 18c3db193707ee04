//! Triangles of light.

use glam::{DVec3, Vec3};
use manylights_scene::AreaLight;

/// A triangle with an area that is not black.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    /// Counter-clockwise as seen from its front, m.
    pub corners: [Vec3; 3],
    /// W·m⁻²·sr⁻¹.
    pub radiance: Vec3,
    /// Whether its back shines, too.
    pub two_sided: bool,
}

impl Face {
    /// `None` of other lights.
    pub fn new(light: &AreaLight) -> Option<Self> {
        let AreaLight::Triangle { corners, radiance, two_sided } = *light else { return None };
        let face = Self { corners, radiance, two_sided };
        // In f32 as well.
        let has_area = face.across().length() as f32 > 0.0;
        (has_area && radiance != Vec3::ZERO).then_some(face)
    }

    /// Around it.
    pub(super) fn edges(&self) -> [(Vec3, Vec3); 3] {
        let [a, b, c] = self.corners;
        [(a, b), (b, c), (c, a)]
    }

    /// Twice its area along the normal of its front, m².
    pub fn across(&self) -> DVec3 {
        let [a, b, c] = self.corners.map(|corner| corner.as_dvec3());
        (b - a).cross(c - a)
    }
}

impl From<Face> for AreaLight {
    fn from(Face { corners, radiance, two_sided }: Face) -> Self {
        Self::Triangle { corners, radiance, two_sided }
    }
}
