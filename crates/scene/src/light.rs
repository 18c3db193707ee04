//! Point-like primary lights (`KHR_lights_punctual`).

use glam::Vec3;

/// A light that is reached by exactly one direction from each point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// Radiates alike in all directions.
    Point {
        /// Metres.
        position: Vec3,
        /// W·sr⁻¹.
        intensity: Vec3,
    },
    /// A cone with a smooth edge.
    Spot {
        /// Metres.
        position: Vec3,
        /// Unit axis.
        direction: Vec3,
        /// On the axis, W·sr⁻¹.
        intensity: Vec3,
        /// Half-angle up to which the intensity is full, radians.
        inner: f32,
        /// Half-angle from which it is zero, radians, below π/2.
        outer: f32,
    },
    /// Parallel light from infinity.
    Directional {
        /// Unit direction in which the light travels.
        direction: Vec3,
        /// On a plane that faces the light, W·m⁻².
        irradiance: Vec3,
    },
}

/// What reaches a point from a light.
#[derive(Clone, Copy, Debug)]
pub struct Illumination {
    /// Unit direction from the point to the light.
    pub to_light: Vec3,
    /// Metres; infinite for a directional light.
    pub distance: f32,
    /// Irradiance on a plane that faces the light, W·m⁻².
    pub irradiance: Vec3,
}

impl Light {
    /// Radiant intensity in a unit direction away from the light, W·sr⁻¹; zero for a directional light.
    pub fn intensity(&self, away: Vec3) -> Vec3 {
        match *self {
            Self::Point { intensity, .. } => intensity,
            Self::Spot { direction, intensity, inner, outer, .. } => {
                intensity * spot_falloff(direction.dot(away), inner, outer)
            }
            Self::Directional { .. } => Vec3::ZERO,
        }
    }

    /// Unshadowed illumination at a point.
    pub fn illuminate(&self, point: Vec3) -> Illumination {
        match *self {
            Self::Point { position, .. } | Self::Spot { position, .. } => {
                let offset = position - point;
                let distance = offset.length();
                let to_light = offset / distance;
                let irradiance = self.intensity(-to_light) / (distance * distance);
                Illumination { to_light, distance, irradiance }
            }
            Self::Directional { direction, irradiance } => {
                Illumination { to_light: -direction, distance: f32::INFINITY, irradiance }
            }
        }
    }
}

/// The edge of a spot light as `KHR_lights_punctual` recommends it: the square of a linear ramp in
/// the cosine.
pub fn spot_falloff(cos: f32, inner: f32, outer: f32) -> f32 {
    let ramp = (cos - outer.cos()) / (inner.cos() - outer.cos()).max(1e-4);
    let ramp = ramp.clamp(0.0, 1.0);
    ramp * ramp
}
