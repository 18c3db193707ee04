//! What of the edges of a group is left where radiances meet, and the fewest triangles of equal radiance.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::face::Face;
use super::group::{Group, bits};

/// With the radiance to its left, as seen from the front, less that to its right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// m.
    pub from: Vec3,
    /// m.
    pub to: Vec3,
    /// W·m⁻²·sr⁻¹.
    pub radiance: Vec3,
}

impl Edge {
    fn reversed(self) -> Self {
        Self { from: self.to, to: self.from, radiance: -self.radiance }
    }
}

impl Group {
    /// Where radiances differ, straight chains of them as one edge.
    pub fn edges(&self) -> Vec<Edge> {
        edges(&self.faces, self.tolerance)
    }

    /// Triangles that cover it: where a part of equal radiance has a convex outline those between its corners,
    /// else its own.
    pub fn triangles(&self) -> Vec<Face> {
        parts(&self.faces)
            .into_iter()
            .flat_map(|part| match convex_outline(&part, self) {
                Some(corners) if corners.len() - 2 < part.len() => {
                    let triangle =
                        |pair: &[Vec3]| Face { corners: [corners[0], pair[0], pair[1]], ..part[0] };
                    corners[1..].windows(2).map(triangle).collect()
                }
                _ => part,
            })
            .collect()
    }
}

/// Where radiances differ, straight chains of them as one edge.
fn edges(faces: &[Face], tolerance: f64) -> Vec<Edge> {
    let mut found: Vec<Edge> = Vec::new();
    let mut position = HashMap::new();
    for face in faces {
        for (from, to) in face.edges() {
            let (there, back) = ((bits(from), bits(to)), (bits(to), bits(from)));
            if let Some(&index) = position.get(&back) {
                let edge: &mut Edge = &mut found[index];
                edge.radiance -= face.radiance;
            } else if let Some(&index) = position.get(&there) {
                let edge: &mut Edge = &mut found[index];
                edge.radiance += face.radiance;
            } else {
                position.insert(there, found.len());
                found.push(Edge { from, to, radiance: face.radiance });
            }
        }
    }
    found.retain(|edge| edge.radiance != Vec3::ZERO);
    chained(&found, tolerance)
}

/// Edges that continue one another on a line, with the same radiance, as one.
fn chained(edges: &[Edge], tolerance: f64) -> Vec<Edge> {
    let mut at: HashMap<_, Vec<usize>> = HashMap::new();
    for (index, edge) in edges.iter().enumerate() {
        for corner in [edge.from, edge.to] {
            at.entry(bits(corner)).or_default().push(index);
        }
    }
    let mut taken = vec![false; edges.len()];
    let mut chains = Vec::new();
    for first in 0..edges.len() {
        if std::mem::replace(&mut taken[first], true) {
            continue;
        }
        let mut chain = edges[first];
        let mut inner = Vec::new();
        // Forwards, then backwards, which is forwards of the reversed chain.
        for _ in 0..2 {
            while let Some((index, longer)) = at[&bits(chain.to)].iter().find_map(|&index| {
                let next = oriented(edges[index], chain.to);
                let longer = Edge { to: next.to, ..chain };
                let continues = !taken[index] && next.radiance == chain.radiance;
                inner.push(chain.to);
                let straight = continues && is_straight(longer, next, &inner, tolerance);
                inner.pop();
                straight.then_some((index, longer))
            }) {
                taken[index] = true;
                inner.push(chain.to);
                chain = longer;
            }
            chain = chain.reversed();
        }
        chains.push(chain);
    }
    chains
}

/// From that corner on.
fn oriented(edge: Edge, from: Vec3) -> Edge {
    if bits(edge.from) == bits(from) { edge } else { edge.reversed() }
}

/// Whether a chain with a new last edge goes on forwards, with all corners that vanish on its line.
fn is_straight(chain: Edge, last: Edge, inner: &[Vec3], tolerance: f64) -> bool {
    let start = chain.from.as_dvec3();
    let along = chain.to.as_dvec3() - start;
    let forwards = along.dot(last.to.as_dvec3() - last.from.as_dvec3()) > 0.0
        && (last.from.as_dvec3() - start).dot(along) > 0.0;
    let along = along.normalize_or_zero();
    let off = |corner: &Vec3| (corner.as_dvec3() - start).reject_from_normalized(along).length();
    forwards && inner.iter().all(|corner| off(corner) <= tolerance)
}

/// Neighbours of equal radiance.
fn parts(faces: &[Face]) -> Vec<Vec<Face>> {
    let mut by_edge = HashMap::new();
    for (index, face) in faces.iter().enumerate() {
        for (from, to) in face.edges() {
            by_edge.insert((bits(from), bits(to)), index);
        }
    }
    let mut taken = vec![false; faces.len()];
    let mut parts = Vec::new();
    for first in 0..faces.len() {
        if std::mem::replace(&mut taken[first], true) {
            continue;
        }
        let (mut part, mut next) = (vec![faces[first]], 0);
        while let Some(face) = part.get(next).copied() {
            for (from, to) in face.edges() {
                let Some(&other) = by_edge.get(&(bits(to), bits(from))) else { continue };
                if faces[other].radiance == face.radiance
                    && !std::mem::replace(&mut taken[other], true)
                {
                    part.push(faces[other]);
                }
            }
            next += 1;
        }
        parts.push(part);
    }
    parts
}

/// The corners around a part, where its edges make one convex loop.
fn convex_outline(part: &[Face], group: &Group) -> Option<Vec<Vec3>> {
    let edges = edges(part, group.tolerance);
    let radiance = part[0].radiance;
    let mut next = HashMap::new();
    for edge in &edges {
        // Chains may run either way.
        let edge = if edge.radiance == radiance { *edge } else { edge.reversed() };
        if edge.radiance != radiance || next.insert(bits(edge.from), edge).is_some() {
            return None;
        }
    }
    let mut corners = Vec::new();
    let mut edge = *next.values().find(|edge| bits(edge.from) == bits(edges[0].from))?;
    for _ in 0..edges.len() {
        corners.push(edge.from);
        edge = *next.get(&bits(edge.to))?;
    }
    let is_loop = bits(edge.from) == bits(corners[0]) && next.len() == corners.len();
    let place = |i: usize| corners[i % corners.len()].as_dvec3();
    let turns = |i: usize| {
        let sides: [DVec3; 2] = [place(i + 1) - place(i), place(i + 2) - place(i + 1)];
        sides[0].cross(sides[1]).dot(group.normal) > 0.0
    };
    let distinct: std::collections::HashSet<_> = corners.iter().copied().map(bits).collect();
    let is_simple = distinct.len() == corners.len();
    (is_loop && is_simple && (0..corners.len()).all(turns) && winds_once(&corners, group.normal))
        .then_some(corners)
}

/// Whether a loop that turns to one side alone does so once.
fn winds_once(corners: &[Vec3], normal: DVec3) -> bool {
    let side = |i: usize| corners[(i + 1) % corners.len()].as_dvec3() - corners[i].as_dvec3();
    let unit = normal.normalize();
    let turn = |i: usize| {
        let (one, two) = (side(i), side((i + 1) % corners.len()));
        one.cross(two).dot(unit).atan2(one.dot(two))
    };
    (0..corners.len()).map(turn).sum::<f64>() < 3.0 * std::f64::consts::PI
}
