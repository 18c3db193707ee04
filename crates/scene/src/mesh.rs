//! Meshes made by code.
//!
//! Every function appends to a scene. The front of each triangle is the side to which its vertex
//! normals point, whatever the order of the parameters; triangles without area (at poles) are left
//! out.

use std::collections::HashMap;

use glam::{Affine3A, Vec2, Vec3, vec2};

use crate::{Scene, Triangle, Vertex};

/// A parallelogram with the corners `corner`, `corner + right`, `corner + right + up`, `corner + up`,
/// whose front is the side of `right × up`.
pub(crate) fn quad(scene: &mut Scene, corner: Vec3, right: Vec3, up: Vec3, material: u32) {
    let normal = right.cross(up).normalize();
    surface(scene, [1, 1], material, |uv| (corner + uv.x * right + uv.y * up, normal));
}

/// The box [-1, 1]³ under `transform`, seen from outside.
pub(crate) fn cuboid(scene: &mut Scene, transform: Affine3A, material: u32) {
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let outward = side * Vec3::AXES[axis];
            let right = Vec3::AXES[(axis + 1) % 3] * 2.0 * side;
            let up = Vec3::AXES[(axis + 2) % 3] * 2.0;
            let corner = outward - 0.5 * (right + up);
            let [right, up] = [right, up].map(|edge| transform.transform_vector3(edge));
            quad(scene, transform.transform_point3(corner), right, up, material);
        }
    }
}

/// A parametric surface: `point` maps [0, 1]² to (position, unit normal).
pub(crate) fn surface(
    scene: &mut Scene,
    [columns, rows]: [u32; 2],
    material: u32,
    point: impl Fn(Vec2) -> (Vec3, Vec3),
) {
    let first = scene.vertices.len() as u32;
    for row in 0..=rows {
        for column in 0..=columns {
            let uv = vec2(column as f32 / columns as f32, row as f32 / rows as f32);
            let (position, normal) = point(uv);
            scene.vertices.push(Vertex { position, normal, uv });
        }
    }
    let index = |column: u32, row: u32| first + row * (columns + 1) + column;
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [index(column, row), index(column + 1, row)];
            let [c, d] = [index(column + 1, row + 1), index(column, row + 1)];
            triangle(scene, [a, b, c], material);
            triangle(scene, [a, c, d], material);
        }
    }
}

/// A surface of revolution about the vertical through `foot`. The profile is a polyline of
/// (radius, height), bottom up; its creases stay sharp.
pub(crate) fn revolution(
    scene: &mut Scene,
    foot: Vec3,
    profile: &[Vec2],
    segments: u32,
    material: u32,
) {
    for edge in profile.windows(2) {
        let along = edge[1] - edge[0];
        let outward = vec2(along.y, -along.x).normalize();
        surface(scene, [segments, 1], material, |uv| {
            let around = Vec2::from_angle(std::f32::consts::TAU * uv.x);
            let at = |p: Vec2| Vec3::new(p.x * around.x, p.y, p.x * around.y);
            (foot + at(edge[0] + uv.y * along), at(outward))
        });
    }
}

/// A sphere-like surface: `point` maps unit directions to (position, unit normal). The directions are
/// those of an icosahedron, each of whose triangles is split in four `level` times (20 · 4^level).
pub(crate) fn icosphere(
    scene: &mut Scene,
    level: u32,
    material: u32,
    point: impl Fn(Vec3) -> (Vec3, Vec3),
) {
    let (mut directions, mut faces) = icosahedron();
    for _ in 0..level {
        let mut midpoints = HashMap::new();
        let mut midpoint = |a: usize, b: usize| {
            *midpoints.entry((a.min(b), a.max(b))).or_insert_with(|| {
                directions.push((directions[a] + directions[b]).normalize());
                directions.len() - 1
            })
        };
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [midpoint(a, b), midpoint(b, c), midpoint(c, a)];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let first = scene.vertices.len() as u32;
    scene.vertices.extend(directions.into_iter().map(|direction| {
        let (position, normal) = point(direction);
        Vertex { position, normal, uv: Vec2::ZERO }
    }));
    for face in faces {
        triangle(scene, face.map(|index| first + index as u32), material);
    }
}

/// Unit vertices and faces of the icosahedron: three golden rectangles.
fn icosahedron() -> (Vec<Vec3>, Vec<[usize; 3]>) {
    let golden = 0.5 * (1.0 + 5.0_f32.sqrt());
    let mut vertices = Vec::new();
    for axis in 0..3 {
        for (short, long) in [(-1.0, -golden), (-1.0, golden), (1.0, -golden), (1.0, golden)] {
            let corner = short * Vec3::AXES[axis] + long * Vec3::AXES[(axis + 1) % 3];
            vertices.push(corner.normalize());
        }
    }
    // The faces are the triples of mutual neighbours; neighbours are 63.4 degrees apart, others 116.6.
    let adjacent = |a: usize, b: usize| vertices[a].dot(vertices[b]) > 0.0;
    let mut faces = Vec::new();
    for a in 0..12 {
        for b in (a + 1..12).filter(|&b| adjacent(a, b)) {
            faces.extend(
                (b + 1..12).filter(|&c| adjacent(a, c) && adjacent(b, c)).map(|c| [a, b, c]),
            );
        }
    }
    (vertices, faces)
}

/// Appends a triangle with its front where its vertex normals point, if it has an area.
fn triangle(scene: &mut Scene, mut indices: [u32; 3], material: u32) {
    let [a, b, c] = indices.map(|index| scene.vertices[index as usize]);
    let area = (b.position - a.position).cross(c.position - a.position);
    if area == Vec3::ZERO {
        return;
    }
    if area.dot(a.normal + b.normal + c.normal) < 0.0 {
        indices.swap(1, 2);
    }
    scene.triangles.push(Triangle { vertices: indices, material });
}
