//! Where the lights of a set stand, and how they are turned.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use serde::Deserialize;

use super::random::Random;

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Arrangement {
    Ring,
    Cloud,
    Shell,
    Panel,
}

impl Arrangement {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Ring => "ring",
            Self::Cloud => "cloud",
            Self::Shell => "shell",
            Self::Panel => "panel",
        }
    }

    /// The keys that not all arrangements have.
    pub(super) fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Ring => &["seed", "radius", "normal", "size"],
            Self::Cloud => &["seed", "extent", "size"],
            Self::Shell => &["seed", "radius", "size"],
            Self::Panel => &["extent", "normal", "up", "picture"],
        }
    }
}

/// A place and a frame; the front is the side of `right × up`.
pub(super) struct Pose {
    pub(super) center: DVec3,
    pub(super) right: DVec3,
    pub(super) up: DVec3,
}

/// Evenly on a circle about `normal`, from a random one of its points on; they face the centre.
pub(super) fn ring(
    count: u32,
    center: DVec3,
    radius: f64,
    normal: DVec3,
    random: &mut Random,
) -> Vec<Pose> {
    let (x, y) = normal.any_orthonormal_pair();
    let start = random.uniform();
    let pose = |i| {
        let (sin, cos) = libm::sincos(TAU * (f64::from(i) + start) / f64::from(count));
        let outward = cos * x + sin * y;
        Pose { center: center + radius * outward, right: outward.cross(normal), up: normal }
    };
    (0..count).map(pose).collect()
}

/// Uniformly in a box, turned at random. Each light takes as many numbers whatever its shape, so
/// that spheres and triangles of one seed have the same centres.
pub(super) fn cloud(count: u32, center: DVec3, sides: DVec3, random: &mut Random) -> Vec<Pose> {
    let pose = |_| {
        let center = center + sides * (random.point() - 0.5);
        let rotation = random.rotation();
        Pose { center, right: rotation * DVec3::X, up: rotation * DVec3::Y }
    };
    (0..count).map(pose).collect()
}

/// On a sphere, as a Fibonacci lattice that is turned at random as a whole; they face the centre.
pub(super) fn shell(count: u32, center: DVec3, radius: f64, random: &mut Random) -> Vec<Pose> {
    let golden = PI * (3.0 - 5_f64.sqrt());
    let rotation = random.rotation();
    let pose = |i| {
        let height = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count);
        let (sin, cos) = libm::sincos(golden * f64::from(i));
        let across = (1.0 - height * height).sqrt();
        let outward = rotation * DVec3::new(across * cos, across * sin, height);
        let right = outward.any_orthonormal_vector();
        Pose { center: center + radius * outward, right, up: right.cross(outward) }
    };
    (0..count).map(pose).collect()
}
