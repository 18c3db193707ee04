//! Eight spheres on a floor before a wall, under five spheres of light: seven lacquers of roughness 0.1 … 1 and a
//! Lambertian one. Their gloss and their colour go from the left to the right and from the front row
//! to the back. Each has a camera of its own, `roughness-0.1` … `roughness-1` and `lambertian`, after that of
//! all.
//!
//! The lights are large and small, near and far, before the receivers, above and behind them: each
//! receiver sees some of them under its horizon.

use glam::{Vec3, vec3};

use super::add;
use crate::{AreaLight, Camera, Material, Scene, mesh};

/// Of the receivers, metres.
const RADIUS: f32 = 0.5;
/// Stronger than that of glass: 11 % at normal incidence, so that both lobes count.
const INDEX: f32 = 2.0;
/// Roughness (the Lambertian one has none) and base color; four in front, then four behind.
const RECEIVERS: [(Option<f32>, Vec3); 8] = [
    (Some(0.1), vec3(0.62, 0.07, 0.06)),
    (Some(0.2), vec3(0.7, 0.24, 0.05)),
    (Some(0.3), vec3(0.7, 0.5, 0.08)),
    (Some(0.4), vec3(0.25, 0.45, 0.08)),
    (None, vec3(0.6, 0.6, 0.6)),
    (Some(1.0), vec3(0.4, 0.12, 0.45)),
    (Some(0.7), vec3(0.12, 0.2, 0.6)),
    (Some(0.5), vec3(0.06, 0.42, 0.42)),
];
/// Centre, radius and radiance.
const LIGHTS: [(Vec3, f32, Vec3); 5] = [
    (vec3(-3.2, 3.4, 2.4), 0.6, vec3(16.0, 14.0, 11.0)),
    (vec3(3.4, 2.2, 2.2), 0.25, vec3(40.0, 52.0, 80.0)),
    (vec3(0.4, 3.6, -3.4), 0.9, vec3(7.0, 8.0, 10.0)),
    (vec3(0.1, 1.15, 0.5), 0.12, vec3(42.0, 26.0, 10.0)),
    (vec3(-3.4, 0.7, -1.2), 0.35, vec3(20.0, 4.0, 8.0)),
];

pub(super) fn make() -> Scene {
    let mut scene = Scene { name: "receivers".to_owned(), exposure: 1.0, ..Scene::default() };
    let floor = add(&mut scene, Material::lambert("floor", vec3(0.5, 0.48, 0.45)));
    let wall = add(&mut scene, Material::lambert("wall", vec3(0.32, 0.36, 0.42)));
    let corner = vec3(-9.0, 0.0, -5.0);
    mesh::quad(&mut scene, corner, 18.0 * Vec3::Z, 18.0 * Vec3::X, floor);
    mesh::quad(&mut scene, corner, 18.0 * Vec3::X, 7.0 * Vec3::Y, wall);
    for (i, (roughness, color)) in RECEIVERS.into_iter().enumerate() {
        let material = match roughness {
            Some(roughness) => {
                let name = format!("roughness {roughness}");
                Material { ior: INDEX, ..Material::glossy(&name, color, roughness) }
            }
            None => Material::lambert("lambertian", color),
        };
        let material = add(&mut scene, material);
        let (column, row) = ((i % 4) as f32, (i / 4) as f32);
        // The back row stands in the gaps of the front one.
        let x = 1.1 * (column - 1.75 + 0.5 * row);
        let center = vec3(x, RADIUS, 0.6 - 1.35 * row);
        mesh::icosphere(&mut scene, 4, material, |d| (center + RADIUS * d, d));
        scene.cameras.push(alone(&scene.materials[material as usize].name, center));
    }
    scene.area_lights.extend(LIGHTS.map(|(center, radius, radiance)| AreaLight::Sphere {
        center,
        radius,
        radiance,
    }));
    let front = Camera::look_at(
        "front",
        vec3(0.0, 2.7, 7.4),
        vec3(0.0, 0.62, -0.1),
        Vec3::Y,
        30_f32.to_radians(),
    );
    scene.cameras.insert(0, front);
    scene
}

/// A camera that sees the whole of one receiver and hardly more, over those before it.
fn alone(material: &str, center: Vec3) -> Camera {
    let position = center + vec3(0.0, 3.0, 3.0);
    Camera::look_at(&material.replace(' ', "-"), position, center, Vec3::Y, 13.5_f32.to_radians())
}
