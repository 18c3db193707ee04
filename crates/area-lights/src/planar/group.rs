//! Triangles of one plane that share edges.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::face::Face;

/// Of triangles that lie in one plane, connected by edges, and all shine to the same sides.
pub struct Group {
    /// At least one.
    pub faces: Vec<Face>,
    /// Of the front, of any length.
    pub normal: DVec3,
    /// How far corners may lie off their plane, and those that vanish from a line, m.
    pub(super) tolerance: f64,
}

/// Cosine of the most that two neighbours of one plane may be turned: corners that are rounded turn small
/// triangles. Whether all lie in one plane is seen afterwards.
const ALIKE: f64 = 1.0 - 1e-5;

/// A corner that equals no other but itself.
pub(super) fn bits(corner: Vec3) -> [u32; 3] {
    // −0 is 0.
    (corner + Vec3::ZERO).to_array().map(f32::to_bits)
}

/// All triangles in groups, in the order of their first ones.
pub fn groups(faces: &[Face]) -> Vec<Group> {
    let mut by_edge = by_edge(faces);
    let normals: Vec<_> = faces.iter().map(|face| face.across().normalize()).collect();
    // Shine to the same sides and are not turned against each other.
    let alike = |one: usize, other: usize| {
        faces[one].two_sided == faces[other].two_sided && normals[one].dot(normals[other]) >= ALIKE
    };
    let mut taken = vec![false; faces.len()];
    let mut groups = Vec::new();
    for first in 0..faces.len() {
        if taken[first] {
            continue;
        }
        taken[first] = true;
        let (mut found, mut next) = (vec![first], 0);
        while let Some(&face) = found.get(next) {
            for (from, to) in faces[face].edges() {
                // Those that share the edge have it in the other direction.
                let Some(others) = by_edge.get_mut(&(bits(to), bits(from))) else { continue };
                // Who is taken need not be met again: many may share an edge.
                others.retain(|&other| {
                    let joins = alike(face, other);
                    if joins && !std::mem::replace(&mut taken[other], true) {
                        found.push(other);
                    }
                    !joins
                });
            }
            next += 1;
        }
        // What is left does not depend on the walk.
        found.sort_unstable();
        groups.extend(in_one_plane(found.into_iter().map(|face| faces[face]).collect()));
    }
    groups
}

/// One group where all lie in one plane, else, as on a finely cut curved surface, one a triangle.
fn in_one_plane(faces: Vec<Face>) -> Vec<Group> {
    let normal: DVec3 = faces.iter().map(Face::across).sum();
    let corners = || faces.iter().flat_map(|face| face.corners).map(|corner| corner.as_dvec3());
    let largest = corners().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
    // Corners in f32, and what made them.
    let tolerance = 8.0 * f64::from(f32::EPSILON) * largest;
    let middle = corners().sum::<DVec3>() / (3 * faces.len()) as f64;
    let is_near =
        |unit: DVec3| corners().all(|corner| (corner - middle).dot(unit).abs() <= tolerance);
    // Areas of a closed surface sum to none.
    if normal.try_normalize().is_some_and(is_near) {
        return vec![Group { faces, normal, tolerance }];
    }
    let alone = |face: Face| Group { normal: face.across(), faces: vec![face], tolerance };
    faces.into_iter().map(alone).collect()
}

/// The triangles of each edge, in its direction.
fn by_edge(faces: &[Face]) -> HashMap<([u32; 3], [u32; 3]), Vec<usize>> {
    let mut by_edge: HashMap<_, Vec<usize>> = HashMap::new();
    for (index, face) in faces.iter().enumerate() {
        for (from, to) in face.edges() {
            by_edge.entry((bits(from), bits(to))).or_default().push(index);
        }
    }
    by_edge
}
