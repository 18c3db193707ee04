//! The directions in which a light is seen from a point.

use glam::{DVec3, Vec3};
use manylights_scene::AreaLight;

use super::cap::Cap;
use super::spherical_triangle::SphericalTriangle;

/// A set of directions, in f64: so no light is too small, too far or too large.
#[derive(Clone, Copy, Debug)]
pub(super) enum Subtended {
    Cap(Cap),
    Triangle(SphericalTriangle),
}

impl Subtended {
    /// `None` where the light lies below the horizon of the shading normal, or shows a side that is dark. Lights
    /// with numbers that are not finite give directions that are none, and thus no finite picture.
    pub(super) fn new(light: &AreaLight, position: Vec3, normal: Vec3) -> Option<Self> {
        let (position, normal) = (position.as_dvec3(), normal.as_dvec3());
        match *light {
            AreaLight::Sphere { center, radius, .. } => {
                Cap::new(center.as_dvec3() - position, radius.into(), normal).map(Self::Cap)
            }
            AreaLight::Triangle { corners, two_sided, .. } => {
                let corners = corners.map(|corner| corner.as_dvec3() - position);
                let [a, b, c] = corners;
                let back = || SphericalTriangle::new([a, c, b], normal).filter(|_| two_sided);
                SphericalTriangle::new(corners, normal).or_else(back).map(Self::Triangle)
            }
        }
    }

    /// sr.
    pub(super) fn solid_angle(&self) -> f64 {
        match self {
            Self::Cap(cap) => cap.solid_angle(),
            Self::Triangle(triangle) => triangle.solid_angle(),
        }
    }

    /// A unit direction, uniform in solid angle; strata of the square become strata of the set.
    pub(super) fn sample(&self, numbers: [f64; 2]) -> DVec3 {
        match self {
            Self::Cap(cap) => cap.sample(numbers),
            Self::Triangle(triangle) => triangle.sample(numbers),
        }
    }

    /// Whether a unit direction belongs to it.
    pub(super) fn contains(&self, direction: DVec3) -> bool {
        match self {
            Self::Cap(cap) => cap.contains(direction),
            Self::Triangle(triangle) => triangle.contains(direction),
        }
    }

    /// How far the light's surface is in a direction of the set, metres; 0 from inside a sphere.
    pub(super) fn distance(&self, direction: DVec3) -> f64 {
        match self {
            Self::Cap(cap) => cap.distance(direction),
            Self::Triangle(triangle) => triangle.distance(direction),
        }
    }
}
