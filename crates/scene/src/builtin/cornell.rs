//! The Cornell box, 2 m wide, lit by a spot below its ceiling so that all methods accept it.

use std::f32::consts::PI;

use glam::{Affine3A, Quat, Vec3, vec3};

use super::add;
use crate::{Camera, Light, Material, Scene, mesh};

const WHITE: Vec3 = Vec3::new(0.73, 0.73, 0.73);
const RED: Vec3 = Vec3::new(0.63, 0.065, 0.05);
const GREEN: Vec3 = Vec3::new(0.14, 0.45, 0.091);

/// Everything Lambertian.
pub(super) fn lambertian() -> Scene {
    let mut scene = new_box("cornell", Material::lambert("back wall", WHITE));
    scene.cameras.push(view("front", Vec3::new(0.0, 1.0, 3.85)));
    scene
}

/// With the glossy back wall of Křivánek et al. 2004, figure 7, and its three viewpoints.
///
/// Their lobe is Phong's with the exponent 22 about the mirror direction. About the half vector, where
/// angles are half as large, that is an exponent of 4 · 22, and GGX of the same width near its peak
/// has α² = 2/(88 + 2) (Walter et al. 2007).
pub(super) fn glossy() -> Scene {
    let alpha = (2.0_f32 / 90.0).sqrt();
    let wall = Material::metal("back wall", Vec3::splat(0.8), alpha.sqrt());
    let mut scene = new_box("cornell-glossy", wall);
    scene.cameras.push(view("centre", Vec3::new(0.0, 1.0, 3.85)));
    scene.cameras.push(view("left", Vec3::new(-0.6, 1.0, 4.3)));
    scene.cameras.push(view("right", Vec3::new(0.6, 1.0, 4.3)));
    scene
}

fn view(name: &str, position: Vec3) -> Camera {
    // A centimetre off the symmetry axis: on it the seams of the walls pass exactly through pixel
    // centres, and which wall such a pixel shows is a matter of rounding.
    let target = Vec3::new(0.013, 1.007, 0.0);
    Camera::look_at(name, position + target - Vec3::Y, target, Vec3::Y, 38_f32.to_radians())
}

/// The box spans x in [-1, 1], y in [0, 2], z in [-1, 1] and is open towards +z.
fn new_box(name: &str, back_wall: Material) -> Scene {
    let mut scene = Scene { name: name.to_owned(), exposure: 1.0, ..Scene::default() };
    let white = add(&mut scene, Material::lambert("white", WHITE));
    let red = add(&mut scene, Material::lambert("red", RED));
    let green = add(&mut scene, Material::lambert("green", GREEN));
    let back = add(&mut scene, back_wall);

    let [right, up, towards] = [2.0 * Vec3::X, 2.0 * Vec3::Y, 2.0 * Vec3::Z];
    mesh::quad(&mut scene, vec3(-1.0, 0.0, -1.0), towards, right, white);
    mesh::quad(&mut scene, vec3(-1.0, 2.0, -1.0), right, towards, white);
    mesh::quad(&mut scene, vec3(-1.0, 0.0, -1.0), right, up, back);
    mesh::quad(&mut scene, vec3(-1.0, 0.0, -1.0), up, towards, red);
    mesh::quad(&mut scene, vec3(1.0, 0.0, -1.0), towards, up, green);
    // The blocks start a little above the floor's plane: coincident faces would flicker.
    block(&mut scene, vec3(0.33, 0.302, 0.33), vec3(0.3, 0.3, 0.3), -0.29, white);
    block(&mut scene, vec3(-0.33, 0.602, -0.3), vec3(0.3, 0.6, 0.3), 0.3, white);

    scene.lights.push(Light::Spot {
        position: vec3(0.0, 1.98, 0.0),
        direction: Vec3::NEG_Y,
        intensity: vec3(1.0, 0.85, 0.65) * 12.0,
        inner: 0.2 * PI,
        outer: 0.36 * PI,
    });
    scene
}

fn block(scene: &mut Scene, centre: Vec3, half: Vec3, turn: f32, material: u32) {
    let turn = Quat::from_rotation_y(turn);
    let transform = Affine3A::from_scale_rotation_translation(half, turn, centre);
    mesh::cuboid(scene, transform, material);
}
