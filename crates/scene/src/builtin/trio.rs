//! Three curved objects of different gloss on a floor before a wall, under one spot light: the
//! situation of figure 5.10 of Mézières' thesis (bunny, Suzanne and their like).

use std::f32::consts::TAU;

use glam::{Quat, Vec2, Vec3, vec3};

use super::add;
use crate::{Camera, Light, Material, Scene, mesh};

pub(super) fn make() -> Scene {
    let mut scene = Scene { name: "trio".to_owned(), exposure: 1.0, ..Scene::default() };
    let floor = add(&mut scene, Material::lambert("floor", vec3(0.62, 0.58, 0.52)));
    let wall = add(&mut scene, Material::lambert("wall", vec3(0.25, 0.42, 0.66)));
    let satin = add(&mut scene, Material::glossy("satin", vec3(0.75, 0.25, 0.12), 0.55));
    let brass = add(&mut scene, Material::metal("brass", vec3(0.91, 0.78, 0.42), 0.35));
    let lacquer = add(&mut scene, Material::glossy("lacquer", vec3(0.08, 0.35, 0.2), 0.2));

    mesh::quad(&mut scene, vec3(-4.0, 0.0, -1.6), 5.6 * Vec3::Z, 8.0 * Vec3::X, floor);
    mesh::quad(&mut scene, vec3(-4.0, 0.0, -1.6), 8.0 * Vec3::X, 4.0 * Vec3::Y, wall);

    mesh::icosphere(&mut scene, 4, satin, |d| (vec3(-1.4, 0.6, 0.0) + 0.6 * d, d));
    let lean = Quat::from_rotation_x(1.15) * Quat::from_rotation_z(0.2);
    mesh::surface(&mut scene, [64, 32], brass, |uv| {
        let (position, normal) = torus(uv, 0.5, 0.2);
        (vec3(0.0, 0.66, -0.1) + lean * position, lean * normal)
    });
    let turn = Quat::from_rotation_y(0.6);
    mesh::icosphere(&mut scene, 4, lacquer, |d| {
        let (position, normal) = rounded_cube(d);
        (vec3(1.4, 0.5, 0.1) + turn * (0.5 * position), turn * normal)
    });

    scene.lights.push(Light::Spot {
        position: vec3(2.2, 3.8, 3.0),
        direction: (vec3(-0.2, 0.4, -0.6) - vec3(2.2, 3.8, 3.0)).normalize(),
        intensity: vec3(1.0, 0.95, 0.85) * 110.0,
        inner: 20_f32.to_radians(),
        outer: 38_f32.to_radians(),
    });
    scene.cameras.push(Camera::look_at(
        "front",
        vec3(0.0, 1.4, 4.7),
        vec3(0.0, 0.62, 0.0),
        Vec3::Y,
        38_f32.to_radians(),
    ));
    scene
}

/// A torus about the y axis: `major` from the centre to the middle of the tube of radius `minor`.
fn torus(uv: Vec2, major: f32, minor: f32) -> (Vec3, Vec3) {
    let around = Vec2::from_angle(TAU * uv.x);
    let across = Vec2::from_angle(TAU * uv.y);
    let ring = vec3(around.x, 0.0, around.y);
    let normal = across.x * ring + across.y * Vec3::Y;
    (major * ring + minor * normal, normal)
}

/// The superellipsoid x⁴ + y⁴ + z⁴ = 1 in the direction `d`, with the gradient as its normal.
fn rounded_cube(d: Vec3) -> (Vec3, Vec3) {
    let position = d / (d * d).length().sqrt();
    (position, (position * position * position).normalize())
}
