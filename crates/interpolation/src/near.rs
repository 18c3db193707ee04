//! Lights that a grid must not hold.

use glam::DVec3;

use crate::Grid;

/// Cells around a grid within which no scheme follows a light: at one and a half every scheme fails, at two
/// Hermite is 7 % off.
const CELLS: f64 = 2.0;

/// The box of a grid and of two cells around it.
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
        Self { least: origin - CELLS * spacing, most: origin + (cells + CELLS) * spacing }
    }

    /// Whether a sphere reaches into it.
    pub fn meets_sphere(&self, center: DVec3, radius: f64) -> bool {
        center.clamp(self.least, self.most).distance(center) <= radius
    }
}
