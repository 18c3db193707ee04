//! Lights with a surface.

use std::f32::consts::PI;

use glam::Vec3;

/// A light with a surface, of the same radiance everywhere on it and in all directions. It is no surface
/// of the scene: no camera sees it, and it hides nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AreaLight {
    /// It shines outwards. From inside, and on its surface, it covers the hemisphere around the direction
    /// to its centre, so that what it sends is continuous (Mézières et al. 2022 treat spheres so).
    Sphere {
        /// Metres.
        center: Vec3,
        /// Metres, positive.
        radius: f32,
        /// W·m⁻²·sr⁻¹.
        radiance: Vec3,
    },
    /// It shines to its front, or from both sides.
    Triangle {
        /// Metres; counter-clockwise seen from the front.
        corners: [Vec3; 3],
        /// W·m⁻²·sr⁻¹.
        radiance: Vec3,
        /// Whether its back shines like its front.
        two_sided: bool,
    },
}

impl AreaLight {
    /// W·m⁻²·sr⁻¹.
    pub fn radiance(&self) -> Vec3 {
        match *self {
            Self::Sphere { radiance, .. } | Self::Triangle { radiance, .. } => radiance,
        }
    }

    /// The same surface with another radiance, W·m⁻²·sr⁻¹.
    pub(crate) fn with_radiance(self, radiance: Vec3) -> Self {
        match self {
            Self::Sphere { center, radius, .. } => Self::Sphere { center, radius, radiance },
            Self::Triangle { corners, two_sided, .. } => {
                Self::Triangle { corners, radiance, two_sided }
            }
        }
    }

    /// Of all sides that shine, m².
    pub fn area(&self) -> f32 {
        match *self {
            Self::Sphere { radius, .. } => 4.0 * PI * radius * radius,
            Self::Triangle { corners: [a, b, c], two_sided, .. } => {
                let sides = if two_sided { 2.0 } else { 1.0 };
                0.5 * sides * (b - a).cross(c - a).length()
            }
        }
    }

    /// Radiant flux, W: π times area times radiance.
    pub fn power(&self) -> Vec3 {
        PI * self.area() * self.radiance()
    }
}
