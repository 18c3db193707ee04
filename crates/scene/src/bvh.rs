//! Ray casting: a bounding volume hierarchy over the triangles of a scene.

mod traverse;
mod wide;

use std::ops::ControlFlow;

use fearless_simd::{Level, dispatch};
use glam::Vec3;

use crate::Scene;
use wide::Wide;

pub use wide::BvhWords;

/// A ray, or a segment of one. `direction` need not be unit; distances are in its lengths.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Metres.
    pub origin: Vec3,
    /// Finite and not zero.
    pub direction: Vec3,
    /// Hits must be farther than this.
    pub t_min: f32,
    /// Hits must not be farther than this.
    pub t_max: f32,
}

impl Ray {
    /// A ray without end.
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, t_min: 0.0, t_max: f32::INFINITY }
    }

    /// The segment from one point to another.
    pub fn between(from: Vec3, to: Vec3) -> Self {
        Self { origin: from, direction: to - from, t_min: 0.0, t_max: 1.0 }
    }
}

/// Where a ray meets a triangle; see [`Scene::surface`] for the meaning of (u, v).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the ray's direction.
    pub t: f32,
    /// Index into [`Scene::triangles`].
    pub triangle: u32,
    /// Barycentric coordinate of the second vertex.
    pub u: f32,
    /// Barycentric coordinate of the third vertex.
    pub v: f32,
}

/// Distance of shifted ray origins from their surface, in units of the scene's largest coordinate.
///
/// A position made from barycentric coordinates is off its plane by a few units in the last place of
/// the coordinates (2⁻²⁴ relative), and so is the plane in the intersection test; 2⁻¹⁹ is 32 of them.
const ORIGIN_SHIFT: f32 = 1.0 / (1 << 19) as f32;

/// How much wider boxes are than their triangles, in the same units. The triangle test moves corners
/// across the ray by up to four roundings of 2⁻²⁴ of distances up to twice the largest coordinate,
/// for rays that start within it; a box must not lose a triangle that this moves into the ray's way.
const BOX_MARGIN: f32 = 1.0 / (1 << 21) as f32;

/// A bounding volume hierarchy. An empty scene is hit by nothing.
///
/// Watertight: no ray that starts within the bounds of the scene passes between triangles that share
/// an edge, or all around a vertex.
pub struct Bvh {
    wide: Wide,
    shift: f32,
    /// The instructions that every processor of the target has: with those of this one the closures
    /// of the walk are no longer inlined, and rays take twice the time.
    level: Level,
}

impl Bvh {
    /// Builds the hierarchy over all triangles.
    pub fn build(scene: &Scene) -> Self {
        let (low, high) = scene.bounds();
        let largest = low.abs().max(high.abs()).max_element();
        let triangles: Vec<_> =
            (0..scene.triangles.len() as u32).map(|t| scene.corners(t)).collect();
        Self {
            wide: Wide::build(&triangles, BOX_MARGIN * largest),
            shift: ORIGIN_SHIFT * largest,
            level: Level::baseline(),
        }
    }

    /// A ray origin just off the surface at `position`, on the side to which `normal` (unit,
    /// geometric) points, so that rays that leave on this side do not meet the surface again.
    pub fn shifted(&self, position: Vec3, normal: Vec3) -> Vec3 {
        position + self.shift * normal
    }

    /// How far [`Bvh::shifted`] shifts, metres.
    pub fn shift(&self) -> f32 {
        self.shift
    }

    /// The hierarchy for shaders.
    pub fn words(&self) -> BvhWords {
        self.wide.words()
    }

    /// Whether two points on surfaces see each other; each with the unit geometric normal of the side
    /// that is asked for. A surface hides what is behind it.
    pub fn sees(&self, [from, from_normal]: [Vec3; 2], [to, to_normal]: [Vec3; 2]) -> bool {
        let offset = to - from;
        from_normal.dot(offset) > 0.0
            && to_normal.dot(offset) < 0.0
            && !self.occluded(&Ray::between(
                self.shifted(from, from_normal),
                self.shifted(to, to_normal),
            ))
    }

    /// The nearest hit.
    pub fn closest(&self, ray: &Ray) -> Option<Hit> {
        dispatch!(self.level, simd => self.wide.closest(simd, ray))
    }

    /// Whether there is any hit.
    pub fn occluded(&self, ray: &Ray) -> bool {
        let stop = |_| ControlFlow::Break(());
        dispatch!(self.level, simd => self.wide.each(simd, ray, stop)).is_break()
    }

    /// Calls `visit` once for every triangle that is hit, in no particular order.
    pub fn all_hits(&self, ray: &Ray, mut visit: impl FnMut(Hit)) {
        let mut go_on = |hit| {
            visit(hit);
            ControlFlow::Continue(())
        };
        let _: ControlFlow<()> =
            dispatch!(self.level, simd => self.wide.each(simd, ray, &mut go_on));
    }
}
