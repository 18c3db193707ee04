//! A sphere as a cap of directions.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

/// The cap of half angle a about the direction to the centre, sin a = radius/distance; the hemisphere
/// from the inside and from the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cap {
    axis: DVec3,
    /// 1 − cos a.
    height: f64,
    /// Metres.
    distance: f64,
    radius: f64,
}

impl Cap {
    /// `None` where all of it lies below the horizon of `normal`. At the very centre, where there is no
    /// direction to it, its axis is `normal`.
    pub(super) fn new(to_center: DVec3, radius: f64, normal: DVec3) -> Option<Self> {
        let distance = to_center.length();
        let axis = if distance == 0.0 { normal } else { to_center / distance };
        let sine = if distance <= radius { 1.0 } else { radius / distance };
        if normal.dot(axis) <= -sine {
            return None;
        }
        // 1 − cos a, which cancels for a small sphere.
        let height = sine * sine / (1.0 + ((1.0 - sine) * (1.0 + sine)).sqrt());
        Some(Self { axis, height, distance, radius })
    }

    pub(super) fn solid_angle(&self) -> f64 {
        TAU * self.height
    }

    pub(super) fn sample(&self, [u, v]: [f64; 2]) -> DVec3 {
        let (x, y) = self.axis.any_orthonormal_pair();
        let below = v * self.height; // 1 − cos θ
        let around = (below * (2.0 - below)).sqrt() * DVec2::from_angle(TAU * u);
        around.x * x + around.y * y + (1.0 - below) * self.axis
    }

    pub(super) fn contains(&self, direction: DVec3) -> bool {
        // |ω − axis|² = 2 (1 − cos θ) keeps the digits of small angles.
        direction.distance_squared(self.axis) <= 2.0 * self.height
    }

    pub(super) fn distance(&self, direction: DVec3) -> f64 {
        if self.distance <= self.radius {
            return 0.0;
        }
        let along = self.distance * direction.dot(self.axis);
        let aside = self.distance * direction.cross(self.axis).length();
        along - ((self.radius - aside) * (self.radius + aside)).max(0.0).sqrt()
    }
}
