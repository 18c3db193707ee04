//! Ray casting: a bounding volume hierarchy over the triangles of a scene.

use std::time::Duration;

use glam::{Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::RayHit;

use crate::Scene;

/// A ray, or a segment of one. `direction` need not be unit; distances are in its lengths.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Metres.
    pub origin: Vec3,
    /// Finite and not zero.
    pub direction: Vec3,
    /// Hits nearer than this do not count.
    pub t_min: f32,
    /// Nor do hits farther than this.
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

/// A bounding volume hierarchy. An empty scene is hit by nothing.
pub struct Bvh {
    nodes: Option<CwBvh>,
    corners: Vec<[Vec3; 3]>,
    shift: f32,
}

impl Bvh {
    /// Builds the hierarchy over all triangles.
    pub fn build(scene: &Scene) -> Self {
        let (low, high) = scene.bounds();
        let shift = ORIGIN_SHIFT * low.abs().max(high.abs()).max_element();
        let corners: Vec<_> = (0..scene.triangles.len() as u32).map(|t| scene.corners(t)).collect();
        if corners.is_empty() {
            return Self { nodes: None, corners, shift };
        }
        let triangles: Vec<_> = corners
            .iter()
            .map(|corners| corners.map(Vec3A::from))
            .map(|[v0, v1, v2]| obvhs::triangle::Triangle { v0, v1, v2 })
            .collect();
        let settings = BvhBuildParams::medium_build();
        let nodes = build_cwbvh_from_tris(&triangles, settings, &mut Duration::default());
        Self { nodes: Some(nodes), corners, shift }
    }

    /// A ray origin just off the surface at `position`, on the side to which `normal` (unit,
    /// geometric) points, so that rays that leave on this side do not meet the surface again.
    pub fn shifted(&self, position: Vec3, normal: Vec3) -> Vec3 {
        position + self.shift * normal
    }

    /// The nearest hit.
    pub fn closest(&self, ray: &Ray) -> Option<Hit> {
        let nodes = self.nodes.as_ref()?;
        let mut nearest = None;
        let mut limit = ray.t_max;
        nodes.ray_traverse(traversal(ray), &mut RayHit::none(), |_, index| {
            match self.intersect(ray, limit, nodes.primitive_indices[index]) {
                Some(hit) => {
                    limit = hit.t;
                    nearest = Some(hit);
                    hit.t
                }
                None => f32::INFINITY,
            }
        });
        nearest
    }

    /// Whether there is any hit.
    pub fn occluded(&self, ray: &Ray) -> bool {
        let Some(nodes) = &self.nodes else { return false };
        let t = |index: usize| {
            self.intersect(ray, ray.t_max, nodes.primitive_indices[index])
                .map_or(f32::INFINITY, |_| 0.0)
        };
        !nodes.ray_traverse_miss(traversal(ray), |_, index| t(index))
    }

    /// Calls `visit` for every hit, in no particular order.
    pub fn all_hits(&self, ray: &Ray, mut visit: impl FnMut(Hit)) {
        let Some(nodes) = &self.nodes else { return };
        nodes.ray_traverse_anyhit(traversal(ray), |_, index| {
            if let Some(hit) = self.intersect(ray, ray.t_max, nodes.primitive_indices[index]) {
                visit(hit);
            }
        });
    }

    /// The test of Möller and Trumbore 1997.
    fn intersect(&self, ray: &Ray, t_max: f32, triangle: u32) -> Option<Hit> {
        let [a, b, c] = self.corners[triangle as usize];
        let (to_b, to_c) = (b - a, c - a);
        let across = ray.direction.cross(to_c);
        let inverse = 1.0 / to_b.dot(across);
        let offset = ray.origin - a;
        let u = offset.dot(across) * inverse;
        let turned = offset.cross(to_b);
        let v = ray.direction.dot(turned) * inverse;
        let t = to_c.dot(turned) * inverse;
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > ray.t_min && t <= t_max;
        inside.then_some(Hit { t, triangle, u, v })
    }
}

fn traversal(ray: &Ray) -> obvhs::ray::Ray {
    obvhs::ray::Ray::new(ray.origin.into(), ray.direction.into(), ray.t_min, ray.t_max)
}
