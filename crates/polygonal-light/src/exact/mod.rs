//! The records of exact triangles: what the adapter sums of them, near and far.

#[cfg(test)]
mod tests;

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};
use manylights_area_lights::{Edges, Face, Group, groups};
use manylights_scene::AreaLight;

/// What a record is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
enum Kind {
    /// A triangle with all of its edges.
    Triangle = 0,
    /// The edge from the second corner to the third; the first is where all edges of its group have their
    /// fan of triangles, for the solid angle. Near alone.
    Edge = 1,
    /// A triangle of a group, far alone.
    Far = 2,
}

/// As `shaders/exact.wesl` has it: 96 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct ExactRecord {
    corners: [Corner; 3],
    /// Of the sphere around the group.
    center: Vec3,
    /// Its diameter, m.
    size: f32,
    /// Of the front.
    normal: Vec3,
    kind: u32,
    radiance: Vec3,
    padding: f32,
}

/// A corner and a number beside it: the share of the radiance that the back sends, 0 or 1; twice the area,
/// negative where the corners run clockwise as seen from the front; the diameter of the triangle, m.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
struct Corner {
    place: Vec3,
    beside: f32,
}

impl ExactRecord {
    /// Of all lights that are triangles with an area and not black.
    pub(crate) fn all(lights: &[AreaLight], edges: Edges) -> Vec<Self> {
        let faces: Vec<_> = lights.iter().filter_map(Face::new).collect();
        match edges {
            Edges::Own => faces.iter().map(Self::triangle).collect(),
            Edges::Shared => groups(&faces).iter().flat_map(Self::of_group).collect(),
        }
    }

    fn triangle(face: &Face) -> Self {
        let plane = Plane::new(face.across(), face.corners.into_iter(), face.two_sided);
        plane.record(Kind::Triangle, face.corners, face.radiance)
    }

    /// Its edges, each once by the difference of the radiances beside it, then its triangles.
    fn of_group(group: &Group) -> Vec<Self> {
        if let [face] = &group.faces[..] {
            return vec![Self::triangle(face)];
        }
        let corners = group.faces.iter().flat_map(|face| face.corners);
        let plane = Plane::new(group.normal, corners, group.faces[0].two_sided);
        let edges = group.edges();
        let apex = edges.first().map_or(Vec3::ZERO, |edge| edge.from);
        let near = edges
            .iter()
            .map(|edge| plane.record(Kind::Edge, [apex, edge.from, edge.to], edge.radiance));
        let far = group.triangles();
        let far = far.iter().map(|face| plane.record(Kind::Far, face.corners, face.radiance));
        near.chain(far).collect()
    }
}

/// What records of one group have in common.
struct Plane {
    center: Vec3,
    size: f32,
    normal: DVec3,
    two_sided: bool,
}

impl Plane {
    fn new(across: DVec3, corners: impl Iterator<Item = Vec3> + Clone, two_sided: bool) -> Self {
        let (center, size) = around(corners);
        Self { center, size, normal: across.normalize(), two_sided }
    }

    fn record(&self, kind: Kind, corners: [Vec3; 3], radiance: Vec3) -> ExactRecord {
        let across = Face { corners, radiance, two_sided: self.two_sided }.across();
        let beside = [
            if self.two_sided { 1.0 } else { 0.0 },
            across.dot(self.normal) as f32,
            around(corners.into_iter()).1,
        ];
        let corner = |i: usize| Corner { place: corners[i], beside: beside[i] };
        ExactRecord {
            corners: [0, 1, 2].map(corner),
            center: self.center,
            size: self.size,
            normal: self.normal.as_vec3(),
            kind: kind as u32,
            radiance,
            padding: 0.0,
        }
    }
}

/// Centre and diameter of a sphere around points: about the middle of the box that holds them.
fn around(points: impl Iterator<Item = Vec3> + Clone) -> (Vec3, f32) {
    let pick = |pick: fn(Vec3, Vec3) -> Vec3| points.clone().reduce(pick).expect("a corner");
    let center = 0.5 * pick(Vec3::min) + 0.5 * pick(Vec3::max);
    (center, 2.0 * points.map(|point| point.distance(center)).fold(0.0, f32::max))
}
