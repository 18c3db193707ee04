//! No ray passes through a closed mesh, least of all at its edges and vertices.

use glam::{Vec2, Vec3};
use manylights_scene::bvh::{Bvh, Ray};
use manylights_scene::{Material, Scene, Triangle, Vertex};

/// Rays that start at each place.
const RAYS: u32 = 20_000;

/// A cube of side 2 about `center` with `cells`² squares on each face, drawn to a sphere of radius 1
/// if `round`.
fn closed(cells: u32, round: bool, center: Vec3) -> Scene {
    let mut scene =
        Scene { materials: vec![Material::lambert("grey", Vec3::splat(0.5))], ..Scene::default() };
    for face in 0..6 {
        let first = scene.vertices.len() as u32;
        for (i, j) in (0..=cells).flat_map(|i| (0..=cells).map(move |j| (i, j))) {
            // The same numbers on both faces of an edge.
            let [x, y] = [i, j].map(|k| (2.0 * k as f32 - cells as f32) / cells as f32);
            let mut point = [0.0; 3];
            point[face / 2] = if face % 2 == 0 { 1.0 } else { -1.0 };
            point[(face / 2 + 1) % 3] = x;
            point[(face / 2 + 2) % 3] = y;
            let point = Vec3::from_array(point);
            let point = if round { point / point.length() } else { point };
            let position = center + point;
            scene.vertices.push(Vertex { position, normal: Vec3::Y, uv: Vec2::ZERO });
        }
        for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
            let at = |i: u32, j: u32| first + i * (cells + 1) + j;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            scene.triangles.push(Triangle { vertices: [a, b, c], material: 0 });
            scene.triangles.push(Triangle { vertices: [a, c, d], material: 0 });
        }
    }
    scene
}

#[test]
fn a_closed_mesh_lets_no_ray_out() {
    for (cells, round) in [(1, false), (7, false), (40, true)] {
        for center in [Vec3::ZERO, Vec3::new(0.3, -20.0, 7.1)] {
            let scene = closed(cells, round, center);
            let bvh = Bvh::build(&scene);
            for start in [Vec3::ZERO, Vec3::new(0.1, -0.4, 0.3), Vec3::new(-0.55, 0.55, 0.0)] {
                for index in 0..RAYS {
                    let ray = Ray::new(center + start, target(&scene, index) - (center + start));
                    let place = format!("{cells} cells, round: {round}, ray {index}: {ray:?}");
                    assert!(bvh.closest(&ray).is_some(), "{place}");
                    assert!(bvh.occluded(&ray), "{place}");
                }
            }
        }
    }
}

/// In turn a vertex, a point on an edge, and a point just beside one.
fn target(scene: &Scene, index: u32) -> Vec3 {
    let [a, b, c] = scene.corners(index.wrapping_mul(7919) % scene.triangles.len() as u32);
    let share = (f64::from(index) * 0.618_033_988_75).fract() as f32;
    match index % 3 {
        0 => a,
        1 => a + share * (b - a),
        _ => a + share * (c - a) + 1e-7 * (b - a),
    }
}
