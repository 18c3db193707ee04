//! Lights that a grid must not hold.

use glam::DVec3;
use manylights_scene::AreaLight;

use crate::Grid;

/// Largest spacings around a grid within which no scheme follows a light: at one and a half every scheme fails, at
/// two Hermite is 7 % off. The largest counts along every axis, since a light above a flat grid varies along it.
const CELLS: f64 = 2.0;

/// The box of a grid and what is within two of its largest spacings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    least: DVec3,
    most: DVec3,
}

impl Reach {
    /// Of this grid.
    pub fn new(grid: &Grid<f32>) -> Self {
        let [origin, spacing] = [grid.origin, grid.spacing].map(|v| DVec3::from(v.map(f64::from)));
        let cells = DVec3::from(grid.vertices.map(|count| (count - 1) as f64));
        let around = CELLS * spacing.max_element();
        Self { least: origin - around, most: origin + cells * spacing + around }
    }

    /// Whether a light reaches into it; of a triangle its box decides.
    pub fn meets(&self, light: &AreaLight) -> bool {
        match *light {
            AreaLight::Sphere { center, radius, .. } => {
                let center = center.as_dvec3();
                center.clamp(self.least, self.most).distance(center) <= f64::from(radius)
            }
            AreaLight::Triangle { corners: [a, b, c], .. } => {
                let (least, most) = (a.min(b).min(c).as_dvec3(), a.max(b).max(c).as_dvec3());
                least.cmple(self.most).all() && most.cmpge(self.least).all()
            }
        }
    }
}
