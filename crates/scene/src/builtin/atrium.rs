//! A nave between two aisles: columns, arches, a barrel vault and a glossy floor. One spot light, as
//! sun through a window high up, hits one arcade; all else is lit indirectly. This is the situation in
//! which the papers on many lights show Sponza.
//!
//! The hall spans x in [-5, 5], z in [-10, 10]; the arcades stand at x = ±3.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{Affine3A, Quat, Vec2, Vec3, vec2, vec3};

use super::add;
use crate::{Camera, Light, Material, Scene, mesh};

const BAYS: u32 = 8;
/// Length of a bay along z.
const BAY: f32 = 2.5;
const HALF_LENGTH: f32 = 0.5 * BAYS as f32 * BAY;
const HALF_WIDTH: f32 = 5.0;
/// Distance of the arcades' middle planes from the axis, and half their thickness.
const ARCADE: f32 = 3.0;
const HALF_THICKNESS: f32 = 0.25;
/// Heights at which the arches, the aisles' ceilings and the vault begin.
const IMPOST: f32 = 3.4;
const AISLE_CEILING: f32 = 5.0;
const VAULT: f32 = 6.6;
/// Clear radius of the arches.
const ARCH: f32 = 1.0;
const ARCH_SEGMENTS: u32 = 12;

pub(super) fn make() -> Scene {
    let mut scene = Scene { name: "atrium".to_owned(), exposure: 1.0, ..Scene::default() };
    let stone = add(&mut scene, Material::lambert("stone", vec3(0.68, 0.62, 0.53)));
    let plaster = add(&mut scene, Material::lambert("plaster", vec3(0.75, 0.72, 0.66)));
    let floor = add(&mut scene, Material::glossy("floor", vec3(0.42, 0.38, 0.34), 0.3));

    let length = 2.0 * HALF_LENGTH * Vec3::Z;
    let corner = vec3(-HALF_WIDTH, 0.0, -HALF_LENGTH);
    mesh::quad(&mut scene, corner, length, 2.0 * HALF_WIDTH * Vec3::X, floor);
    end_walls(&mut scene, plaster);
    vault(&mut scene, plaster);
    for side in [-1.0, 1.0] {
        aisle(&mut scene, side, plaster);
        for i in 0..=BAYS {
            let foot = vec3(side * ARCADE, 0.0, i as f32 * BAY - HALF_LENGTH);
            column(&mut scene, foot, stone);
        }
        for i in 0..BAYS {
            arch(&mut scene, side, (i as f32 + 0.5) * BAY - HALF_LENGTH, stone);
        }
    }
    drapes(&mut scene);
    light_and_cameras(&mut scene);
    scene
}

fn light_and_cameras(scene: &mut Scene) {
    let position = vec3(2.2, 6.4, 5.2);
    scene.lights.push(Light::Spot {
        position,
        direction: (vec3(-2.2, 1.2, 0.6) - position).normalize(),
        intensity: vec3(1.0, 0.93, 0.8) * 1500.0,
        inner: 18_f32.to_radians(),
        outer: 26_f32.to_radians(),
    });
    let fov = 58_f32.to_radians();
    let nave = (vec3(0.9, 1.7, 9.2), vec3(-0.5, 2.5, -2.0));
    let aisle = (vec3(4.4, 1.7, 6.0), vec3(-1.2, 1.9, -3.0));
    scene.cameras.push(Camera::look_at("nave", nave.0, nave.1, Vec3::Y, fov));
    scene.cameras.push(Camera::look_at("aisle", aisle.0, aisle.1, Vec3::Y, fov));
}

fn end_walls(scene: &mut Scene, material: u32) {
    let top = VAULT + ARCADE;
    for side in [-1.0, 1.0] {
        let corner = vec3(side * HALF_WIDTH, 0.0, side * HALF_LENGTH);
        let along = -side * 2.0 * HALF_WIDTH * Vec3::X;
        mesh::quad(scene, corner, along, top * Vec3::Y, material);
    }
}

/// The outer wall and ceiling of an aisle, and the nave's wall above the arcade.
fn aisle(scene: &mut Scene, side: f32, material: u32) {
    let length = 2.0 * HALF_LENGTH * Vec3::Z * side;
    let from = |x: f32, y: f32| vec3(side * x, y, -side * HALF_LENGTH);
    let inner = ARCADE - HALF_THICKNESS;
    mesh::quad(scene, from(HALF_WIDTH, 0.0), length, AISLE_CEILING * Vec3::Y, material);
    let across = side * (HALF_WIDTH - inner) * Vec3::X;
    mesh::quad(scene, from(inner, AISLE_CEILING), across, length, material);
    mesh::quad(
        scene,
        from(inner, AISLE_CEILING),
        length,
        (VAULT - AISLE_CEILING) * Vec3::Y,
        material,
    );
}

/// Half a cylinder over the nave.
fn vault(scene: &mut Scene, material: u32) {
    mesh::surface(scene, [24, BAYS], material, |uv| {
        let out = Vec2::from_angle(PI * uv.x).extend(0.0);
        let foot = vec3(0.0, VAULT, HALF_LENGTH * (2.0 * uv.y - 1.0));
        (foot + (ARCADE - HALF_THICKNESS) * out, -out)
    });
}

fn column(scene: &mut Scene, foot: Vec3, material: u32) {
    const PROFILE: [Vec2; 8] = [
        vec2(0.36, 0.0),
        vec2(0.36, 0.14),
        vec2(0.29, 0.22),
        vec2(0.24, 0.28),
        vec2(0.24, 1.3),
        vec2(0.2, 2.95),
        vec2(0.22, 3.02),
        vec2(0.31, 3.26),
    ];
    mesh::revolution(scene, foot, &PROFILE, 14, material);
    let half = vec3(0.32, 0.5 * (IMPOST - 3.26), 0.32);
    let centre = foot + (IMPOST - half.y) * Vec3::Y;
    let abacus = Affine3A::from_scale_rotation_translation(half, Quat::IDENTITY, centre);
    mesh::cuboid(scene, abacus, material);
}

/// The wall of one bay from the impost to the aisle's ceiling, with a semicircular opening whose
/// middle is at `z`.
fn arch(scene: &mut Scene, side: f32, z: f32, material: u32) {
    // The opening's edge from one column to the next, relative to the middle of the impost.
    let edge = |u: f32| match (u * (ARCH_SEGMENTS + 2) as f32).round() as u32 {
        0 => vec2(-0.5 * BAY, 0.0),
        step if step == ARCH_SEGMENTS + 2 => vec2(0.5 * BAY, 0.0),
        step => ARCH * Vec2::from_angle(PI * (1.0 - (step - 1) as f32 / ARCH_SEGMENTS as f32)),
    };
    for face in [-1.0, 1.0] {
        let x = side * ARCADE + face * HALF_THICKNESS;
        mesh::surface(scene, [ARCH_SEGMENTS + 2, 1], material, |uv| {
            let low = edge(uv.x) + vec2(0.0, IMPOST);
            let y = low.y + uv.y * (AISLE_CEILING - low.y);
            (vec3(x, y, z + low.x), face * Vec3::X)
        });
    }
    mesh::surface(scene, [ARCH_SEGMENTS, 1], material, |uv| {
        let out = Vec2::from_angle(PI * uv.x);
        let x = side * ARCADE + HALF_THICKNESS * (2.0 * uv.y - 1.0);
        (vec3(x, IMPOST + ARCH * out.y, z + ARCH * out.x), vec3(0.0, -out.y, -out.x))
    });
}

/// Cloth in some bays: the colours that bleed.
fn drapes(scene: &mut Scene) {
    let red = add(scene, Material::lambert("red drape", vec3(0.6, 0.06, 0.05)));
    let green = add(scene, Material::lambert("green drape", vec3(0.08, 0.36, 0.1)));
    let blue = add(scene, Material::lambert("blue drape", vec3(0.07, 0.14, 0.5)));
    for (side, bay, material) in [
        (-1.0, 2, green),
        (-1.0, 3, red),
        (-1.0, 5, blue),
        (1.0, 1, blue),
        (1.0, 3, green),
        (1.0, 4, red),
    ] {
        let middle = vec3(side * ARCADE, 0.0, (bay as f32 + 0.5) * BAY - HALF_LENGTH);
        drape(scene, middle, material);
    }
}

/// A hanging of four folds, 2 m wide, from the impost to knee height.
fn drape(scene: &mut Scene, middle: Vec3, material: u32) {
    const DEPTH: f32 = 0.07;
    mesh::surface(scene, [32, 1], material, |uv| {
        let phase = 4.0 * TAU * uv.x;
        let position = vec3(DEPTH * phase.sin(), 0.6 + (IMPOST - 0.6) * uv.y, 2.0 * uv.x - 1.0);
        let slope = DEPTH * 4.0 * TAU * 0.5 * (phase + FRAC_PI_2).sin();
        (middle + position, vec3(1.0, 0.0, -slope).normalize())
    });
}
