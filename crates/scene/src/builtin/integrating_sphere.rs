//! The inside of a Lambertian sphere with a point light at its centre.
//!
//! With albedo ρ, intensity I and radius R the direct radiance is ρI/(πR²) and that of the k-th
//! bounce ρ^(k+1) I/(πR²), at every point and in every direction.
//!
//! The vertices and their normals are exact; the facets between them are flat. A facet's centre is
//! nearer to the light by at most 2.9e-4 of R (the test measures it), so a pixel's direct radiance is
//! too high by at most twice that, 0.058 %, and by 0.036 % on average.

use std::f32::consts::PI;

use glam::Vec3;

use super::add;
use crate::{Camera, Light, Material, Scene, mesh};

/// R, metres.
pub const RADIUS: f32 = 2.0;
/// ρ, the same in all channels.
pub const ALBEDO: f32 = 0.5;
/// I, W·sr⁻¹, the same in all channels: the direct radiance is 0.5 W·m⁻²·sr⁻¹.
pub const INTENSITY: f32 = 4.0 * PI;

/// Subdivisions of the icosahedron: 20 480 triangles.
const LEVEL: u32 = 5;

pub(super) fn make() -> Scene {
    let mut scene =
        Scene { name: "integrating-sphere".to_owned(), exposure: 1.0, ..Scene::default() };
    let wall = add(&mut scene, Material::lambert("wall", Vec3::splat(ALBEDO)));
    mesh::icosphere(&mut scene, LEVEL, wall, |direction| (RADIUS * direction, -direction));
    scene.lights.push(Light::Point { position: Vec3::ZERO, intensity: Vec3::splat(INTENSITY) });
    scene.cameras.push(Camera::look_at(
        "inside",
        Vec3::new(0.9, 0.4, 1.1),
        Vec3::new(-0.6, -0.3, -1.2),
        Vec3::Y,
        70_f32.to_radians(),
    ));
    scene
}
