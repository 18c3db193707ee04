//! Paths from point-like lights: where a light that reaches little of the scene puts its energy.
//!
//! Paths from the camera find the small lit patch of a spot light rarely, with large weights. A point
//! drawn from the light itself is always lit; connected to the shaded point, and weighed against the
//! camera path by the balance heuristic in area measure (Veach 1997, section 9.2), it removes most of
//! that variance.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};
use manylights_scene::bvh::Ray;
use manylights_scene::light::Illumination;
use manylights_scene::{Light, Scene, SurfacePoint};

/// The lights of a scene as origins of paths.
#[derive(Debug)]
pub(crate) struct Beams<'a> {
    lights: &'a [Light],
    /// Probability of each light: its share of the power.
    chances: Vec<f32>,
    center: Vec3,
    radius: f32,
}

impl<'a> Beams<'a> {
    /// `None` where every light reaches the whole scene, or there is none.
    pub(crate) fn new(scene: &'a Scene) -> Option<Self> {
        let (low, high) = scene.bounds();
        let (center, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
        let powers: Vec<f32> = scene.lights.iter().map(|light| power(light, radius)).collect();
        let total: f32 = powers.iter().sum();
        let narrow = scene.lights.iter().any(|light| !matches!(light, Light::Point { .. }));
        let chances = powers.iter().map(|power| power / total).collect();
        (narrow && total > 0.0).then_some(Self { lights: &scene.lights, chances, center, radius })
    }

    /// The ray of a light, drawn from three uniform numbers, and the light's index.
    pub(crate) fn sample(&self, [u, v, choice]: [f32; 3]) -> (usize, Ray) {
        let mut below = 0.0;
        let chosen = self.chances.iter().position(|chance| {
            below += chance;
            choice < below
        });
        let index = chosen.unwrap_or(self.chances.len() - 1);
        (index, self.ray(index, [u, v]))
    }

    /// Density over area with which [`Self::sample`] finds a lit point through one light, m⁻².
    pub(crate) fn density(&self, light: usize, point: &SurfacePoint, at: &Illumination) -> f32 {
        let facing = point.geometric_normal.dot(at.to_light).max(0.0);
        let chance = self.chances[light] * facing;
        match self.lights[light] {
            Light::Directional { .. } => chance / (PI * self.radius * self.radius),
            Light::Point { .. } | Light::Spot { .. } => {
                chance / (solid_angle(&self.lights[light]) * at.distance * at.distance)
            }
        }
    }

    fn ray(&self, index: usize, [u, v]: [f32; 2]) -> Ray {
        let turned = Vec2::from_angle(TAU * u);
        let cone = |axis: Vec3, cos_outer: f32| {
            let (x, y) = axis.any_orthonormal_pair();
            let below = v * (1.0 - cos_outer); // 1 − cos θ
            let sin = (below * (2.0 - below)).max(0.0).sqrt();
            sin * (turned.x * x + turned.y * y) + (1.0 - below) * axis
        };
        match self.lights[index] {
            Light::Point { position, .. } => Ray::new(position, cone(Vec3::Z, -1.0)),
            Light::Spot { position, direction, outer, .. } => {
                Ray::new(position, cone(direction, outer.cos()))
            }
            Light::Directional { direction, .. } => {
                let (x, y) = direction.any_orthonormal_pair();
                let disc = self.radius * v.sqrt() * turned;
                let origin = self.center - 2.0 * self.radius * direction;
                Ray::new(origin + disc.x * x + disc.y * y, direction)
            }
        }
    }
}

/// Radiant flux into the scene, up to the spot's soft edge; W, mean of the channels.
fn power(light: &Light, radius: f32) -> f32 {
    let mean = |channels: Vec3| channels.element_sum() / 3.0;
    match *light {
        Light::Point { intensity, .. } | Light::Spot { intensity, .. } => {
            mean(intensity) * solid_angle(light)
        }
        Light::Directional { irradiance, .. } => mean(irradiance) * PI * radius * radius,
    }
}

/// Of the directions that a point or spot light sends rays into, sr.
fn solid_angle(light: &Light) -> f32 {
    match *light {
        Light::Spot { outer, .. } => TAU * (1.0 - outer.cos()),
        Light::Point { .. } | Light::Directional { .. } => 2.0 * TAU,
    }
}
