//! Seconds that a reference of direct light takes, over the number of lights with a surface.
//!
//! `area_light_time [LIGHTS...]` (625 and 2 500 by default) prints, as a table for
//! `results/path-tracer/area-lights.md`, for each number and shape of lights above a Lambertian and a rough
//! metallic floor the seconds of 16 samples at 32 × 32 pixels, both visibilities, and where all lights are
//! summed nanoseconds a sample, pixel and light.

use std::error::Error;
use std::time::Instant;

use glam::{Vec2, Vec3};
use manylights_path_tracer::{SLICE, Settings, render};
use manylights_scene::{
    AreaLight, Camera, Material, Scene, Transport, Triangle, Vertex, Visibility,
};

const RESOLUTION: [u32; 2] = [32, 32];

fn main() -> Result<(), Box<dyn Error>> {
    let mut counts = Vec::new();
    for argument in std::env::args().skip(1) {
        counts.push(argument.parse::<u32>()?);
    }
    if counts.is_empty() {
        counts.extend([625, 2500]);
    }
    let gray = Vec3::splat(0.5);
    let materials = [Material::lambert("Lambertian", gray), Material::metal("metal", gray, 0.4)];
    println!("| lights | floor | visibility | s | ns a sample, pixel and light |");
    println!("|---|---|---|---:|---:|");
    for count in counts {
        for (shape, light) in
            [("spheres", sphere as fn(u32, u32) -> AreaLight), ("triangles", triangle)]
        {
            for material in &materials {
                let lights = (0..count).map(|index| light(index, count)).collect();
                let scene = floor(material.clone(), lights);
                for visibility in [Visibility::Ignored, Visibility::Traced] {
                    let seconds = seconds(&scene, visibility)?;
                    let samples = RESOLUTION[0] * RESOLUTION[1] * SLICE;
                    let share = 1e9 * seconds / (f64::from(samples) * f64::from(count));
                    let share = match visibility {
                        Visibility::Ignored => format!("{share:.1}"),
                        Visibility::Traced => "one light a sample".to_owned(),
                    };
                    let name = &material.name;
                    println!(
                        "| {count} {shape} | {name} | {visibility} | {seconds:.3} | {share} |"
                    );
                }
            }
        }
    }
    Ok(())
}

/// For one slice: the least reference has two.
fn seconds(scene: &Scene, visibility: Visibility) -> Result<f64, Box<dyn Error>> {
    let transport = Transport::Direct { visibility };
    let settings = Settings { transport, resolution: RESOLUTION, seed: 1, samples: 2 * SLICE };
    let start = Instant::now();
    render(scene, &scene.cameras[0], &settings, None, &mut |_| {})?;
    Ok(start.elapsed().as_secs_f64() / 2.0)
}

/// On the golden spiral over a disc above the floor.
fn place(index: u32, count: u32) -> Vec3 {
    let radius = ((index as f32 + 0.5) / count as f32).sqrt();
    let turned = Vec2::from_angle(2.399_963 * index as f32);
    Vec3::new(radius * turned.x, 0.5, radius * turned.y)
}

fn sphere(index: u32, count: u32) -> AreaLight {
    let radius = 0.5 / (count as f32).sqrt();
    AreaLight::Sphere { center: place(index, count), radius, radiance: Vec3::ONE }
}

fn triangle(index: u32, count: u32) -> AreaLight {
    let size = 1.0 / (count as f32).sqrt();
    let [a, b, c] =
        [Vec3::ZERO, Vec3::X, Vec3::Z].map(|offset| place(index, count) + size * offset);
    AreaLight::Triangle { corners: [a, b, c], radiance: Vec3::ONE, two_sided: false }
}

fn floor(material: Material, area_lights: Vec<AreaLight>) -> Scene {
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let vertex =
        |(x, z)| Vertex { position: Vec3::new(x, 0.0, z), normal: Vec3::Y, uv: Vec2::ZERO };
    Scene {
        area_lights,
        vertices: corners.map(vertex).to_vec(),
        triangles: [[0, 1, 2], [0, 2, 3]]
            .map(|vertices| Triangle { vertices, material: 0 })
            .to_vec(),
        materials: vec![material],
        cameras: vec![Camera::look_at("eye", Vec3::new(0.0, 1.5, 1.5), Vec3::ZERO, Vec3::Y, 0.5)],
        ..Scene::default()
    }
}
