//! A closed room of 284 810 triangles and three sets of rays in it: coherent ones from a camera,
//! incoherent ones that leave the surfaces it sees, and segments from there to a light.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};
use manylights_scene::bvh::{Bvh, Ray};
use manylights_scene::{Camera, Material, Scene, Triangle, Vertex};

/// Rays of each set: one for each pixel of this square.
pub(crate) const SIDE: u32 = 512;

/// The names of the sets of [`rays`].
pub(crate) const SETS: [&str; 3] = ["primary", "diffuse", "any-hit"];

const SIZE: Vec3 = Vec3::new(6.0, 4.0, 5.0);

/// Twelve spheres of 19 200 triangles and a torus of 54 398 in a box of 12.
pub(crate) fn scene() -> Scene {
    let mut scene =
        Scene { materials: vec![Material::lambert("wall", Vec3::splat(0.7))], ..Scene::default() };
    for face in 0..6 {
        grid(&mut scene, [1, 1], |uv| (0.5 + 0.5 * cube(face, uv)) * SIZE);
    }
    for k in 0..12 {
        let (column, row) = ((k % 4) as f32, (k / 4) as f32);
        let center = Vec3::new(0.9 + 1.4 * column, 0.6 + 0.9 * row, 1.0 + 1.3 * row);
        let radius = 0.3 + 0.02 * k as f32;
        for face in 0..6 {
            grid(&mut scene, [40, 40], |uv| center + radius * cube(face, uv).normalize());
        }
    }
    grid(&mut scene, [461, 59], |uv| {
        let (around, across) = (Vec2::from_angle(TAU * uv.x), Vec2::from_angle(TAU * uv.y));
        let radius = 1.3 + 0.25 * across.x;
        Vec3::new(3.0 + radius * around.x, 3.3 + 0.25 * across.y, 2.5 + radius * around.y)
    });
    scene.cameras.push(Camera::look_at(
        "corner",
        Vec3::new(0.3, 2.6, 0.4),
        Vec3::new(4.0, 1.2, 3.4),
        Vec3::Y,
        TAU / 4.0,
    ));
    scene
}

/// The sets of rays.
pub(crate) fn rays(scene: &Scene, bvh: &Bvh) -> [Vec<Ray>; 3] {
    let mut sets = [const { Vec::new() }; 3];
    let camera = &scene.cameras[0];
    for index in 0..SIDE * SIDE {
        let direction = camera.direction(index % SIDE, index / SIDE, [SIDE, SIDE]);
        let primary = Ray::new(camera.position, direction);
        let hit = bvh.closest(&primary).expect("the room is closed");
        let surface = scene.surface(hit.triangle, hit.u, hit.v, direction);
        let origin = bvh.shifted(surface.position, surface.geometric_normal);
        // The R₄ sequence (Roberts 2018): incoherent from one pixel to the next.
        let [u, v, s, t] = [0.856_674_9, 0.733_891_9, 0.628_706_7, 0.538_597_2]
            .map(|step: f64| (f64::from(index) * step).fract() as f32);
        let (x, y) = surface.geometric_normal.any_orthonormal_pair();
        let disc = v.sqrt() * Vec2::from_angle(TAU * u);
        let diffuse = disc.x * x + disc.y * y + (1.0 - v).sqrt() * surface.geometric_normal;
        let light = Vec3::new(3.0 + 0.5 * s, 3.9, 2.0 + 0.5 * t);
        sets[0].push(primary);
        sets[1].push(Ray::new(origin, diffuse));
        sets[2].push(Ray::between(origin, light));
    }
    sets
}

/// Point (u, v) of a face of the cube [−1, 1]³.
fn cube(face: usize, uv: Vec2) -> Vec3 {
    let mut point = [0.0; 3];
    point[face / 2] = if face.is_multiple_of(2) { 1.0 } else { -1.0 };
    point[(face / 2 + 1) % 3] = 2.0 * uv.x - 1.0;
    point[(face / 2 + 2) % 3] = 2.0 * uv.y - 1.0;
    Vec3::from_array(point)
}

fn grid(scene: &mut Scene, [columns, rows]: [u32; 2], surface: impl Fn(Vec2) -> Vec3) {
    let first = scene.vertices.len() as u32;
    for (i, j) in (0..=columns).flat_map(|i| (0..=rows).map(move |j| (i, j))) {
        let uv = Vec2::new(i as f32 / columns as f32, j as f32 / rows as f32);
        // Shading normals play no part in casting rays.
        scene.vertices.push(Vertex { position: surface(uv), normal: Vec3::Y, uv });
    }
    for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
        let at = |i: u32, j: u32| first + i * (rows + 1) + j;
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        scene.triangles.push(Triangle { vertices: [a, b, c], material: 0 });
        scene.triangles.push(Triangle { vertices: [a, c, d], material: 0 });
    }
}
