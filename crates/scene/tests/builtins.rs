//! The scenes that are made by code.

use crate::common;
use std::collections::HashMap;
use std::f32::consts::PI;

use glam::{Vec3, vec3};
use manylights_scene::builtin::integrating_sphere::{ALBEDO, INTENSITY, RADIUS};
use manylights_scene::builtin::{BUILTINS, Builtin};
use manylights_scene::bvh::{Bvh, Ray};
use manylights_scene::{AreaLight, Light, Scene, load};

fn make(name: &str) -> Scene {
    load(name, None).expect("a built-in scene")
}

#[test]
fn all_keep_the_promises_of_a_scene() {
    for Builtin { name, about, make } in BUILTINS {
        let scene = make();
        common::check_invariants(&scene, name);
        assert_eq!(&scene.name, name);
        assert!(!about.is_empty());
        assert!(!scene.lights.is_empty() || !scene.area_lights.is_empty(), "{name} is dark");
        // Made by code, so the winding agrees with the normals everywhere.
        for (i, triangle) in scene.triangles.iter().enumerate() {
            let front = scene.geometric_normal(i as u32);
            for vertex in triangle.vertices {
                let normal = scene.vertices[vertex as usize].normal;
                assert!(front.dot(normal) > 0.5, "{name}: triangle {i} is inside out or creased");
            }
        }
    }
}

#[test]
fn triangle_budgets() {
    let count = |name| make(name).triangles.len();
    assert_eq!(count("integrating-sphere"), 20 * 4_usize.pow(5));
    assert_eq!(count("cornell"), 2 * (5 + 2 * 6));
    assert_eq!(count("cornell-glossy"), count("cornell"));
    assert!((2_000..8_000).contains(&count("atrium")), "a few thousand");
    assert!((5_000..20_000).contains(&count("trio")));
    assert_eq!(count("receivers"), 2 * 2 + 8 * 20 * 4_usize.pow(4));
}

/// Every edge is walked once in each direction: a closed, consistently wound surface.
#[test]
fn integrating_sphere_is_closed() {
    let scene = make("integrating-sphere");
    let mut edges = HashMap::new();
    for triangle in &scene.triangles {
        let [a, b, c] = triangle.vertices;
        for edge in [(a, b), (b, c), (c, a)] {
            assert!(edges.insert(edge, ()).is_none(), "edge {edge:?} twice");
        }
    }
    assert!(edges.keys().all(|&(a, b)| edges.contains_key(&(b, a))), "an open edge");
}

/// The numbers in the module's documentation.
#[test]
fn integrating_sphere_facets_are_as_flat_as_documented() {
    let scene = make("integrating-sphere");
    for vertex in &scene.vertices {
        // Rounding of a coordinate of 2 m is 1.2e-7.
        assert!((vertex.position.length() - RADIUS).abs() < 5e-7);
        assert!(vertex.normal.dot(vertex.position) < -RADIUS + 1e-6, "normals point inwards");
    }
    let mut largest = 0_f32;
    let mut excess = 0.0;
    for i in 0..scene.triangles.len() as u32 {
        let plane = scene.geometric_normal(i).dot(scene.corners(i)[0]).abs();
        largest = largest.max(1.0 - plane / RADIUS);
        // 1/d² is 1/R² at the corners and 1/plane² at the centre; over an equilateral triangle the
        // mean of ρ² is a quarter of its value at the corners.
        excess += 0.75 * (RADIUS * RADIUS / (plane * plane) - 1.0);
    }
    let mean = excess / scene.triangles.len() as f32;
    assert!(largest < 2.9e-4, "{largest}");
    assert!(mean < 3.65e-4, "{mean}");
}

#[test]
fn integrating_sphere_has_the_documented_light() {
    let scene = make("integrating-sphere");
    let [Light::Point { position, intensity }] = scene.lights[..] else {
        panic!("one point light")
    };
    assert_eq!((position, intensity), (Vec3::ZERO, Vec3::splat(INTENSITY)));
    assert_eq!(scene.materials[0].base_color, Vec3::splat(ALBEDO));
    assert!(!scene.has_specular());
    let direct = ALBEDO * INTENSITY / (PI * RADIUS * RADIUS);
    assert!((direct - 0.5).abs() < 1e-6, "{direct}");
    let camera = scene.camera(None).expect("a camera");
    assert!(camera.position.length() > 0.5 && camera.position.length() < 0.9 * RADIUS);
}

/// Light must not leave the closed scenes, in whatever direction.
#[test]
fn no_ray_escapes_from_closed_scenes() {
    for name in ["integrating-sphere", "atrium"] {
        let scene = make(name);
        let bvh = Bvh::build(&scene);
        for camera in &scene.cameras {
            for i in 0..20_000 {
                // A Fibonacci lattice of directions.
                let z = 1.0 - (2.0 * i as f32 + 1.0) / 20_000.0;
                let angle = 2.399_963_2 * i as f32;
                let ring = (1.0 - z * z).sqrt();
                let direction = vec3(ring * angle.cos(), ring * angle.sin(), z);
                let hit = bvh.closest(&Ray::new(camera.position, direction));
                assert!(hit.is_some(), "{name}: {} sees {direction} leave", camera.name);
            }
        }
    }
}

#[test]
fn materials_are_what_the_scenes_are_for() {
    assert!(!make("cornell").has_specular());
    let roughness = |name: &str| -> Vec<f32> {
        let scene = make(name);
        let glossy = scene.materials.iter().filter(|material| material.has_specular());
        glossy.map(|material| material.roughness).collect()
    };
    // Phong 22 about the mirror direction: α² = 2/90.
    let [wall] = roughness("cornell-glossy")[..] else { panic!("one glossy material") };
    assert!((wall.powi(4) - 2.0 / 90.0).abs() < 1e-6);
    assert_eq!(roughness("atrium").len(), 1, "the floor alone is glossy");
    let [a, b, c] = roughness("trio")[..] else { panic!("three glossy materials") };
    assert!(a != b && b != c && c != a);
    assert_eq!(make("cornell-glossy").cameras.len(), 3);
    let mut rough = roughness("receivers");
    rough.sort_by(f32::total_cmp);
    assert_eq!(rough, [0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0]);
    let scene = make("receivers");
    let lambertian = scene.materials.iter().filter(|material| !material.has_specular());
    assert_eq!(lambertian.count(), 3, "a sphere, floor and wall");
}

/// None of the receivers touches another, a light or the camera; no light reaches through the floor.
#[test]
fn receivers_stand_free() {
    let scene = make("receivers");
    let mut balls: Vec<(Vec3, f32)> = Vec::new();
    for material in 2..scene.materials.len() as u32 {
        let of_it = scene.triangles.iter().filter(|triangle| triangle.material == material);
        let corners = of_it.flat_map(|triangle| triangle.vertices);
        let corners: Vec<Vec3> = corners.map(|v| scene.vertices[v as usize].position).collect();
        let low = corners.iter().copied().reduce(Vec3::min).expect("a receiver");
        let high = corners.iter().copied().reduce(Vec3::max).expect("a receiver");
        balls.push((low.midpoint(high), 0.5 * (high.y - low.y)));
    }
    assert_eq!(balls.len(), 8);
    assert!(balls.iter().all(|(center, radius)| (center.y - radius).abs() < 1e-6), "on the floor");
    for light in &scene.area_lights {
        let AreaLight::Sphere { center, radius, .. } = *light else { panic!("{light:?}") };
        balls.push((center, radius));
    }
    balls.push((scene.cameras[0].position, 0.0));
    for (i, (a, r)) in balls.iter().enumerate() {
        assert!(a.y >= r - 1e-6, "{a} is in the floor");
        assert!(balls[..i].iter().all(|(b, s)| a.distance(*b) > r + s), "{a} touches another");
    }
}

#[test]
fn unknown_names_suggest_the_nearest() {
    let line = common::check_line(&load("atrum", None).expect_err("unknown"));
    assert!(line.contains("`atrum`") && line.contains("did you mean `atrium`?"), "{line}");
    let scene = make("cornell-glossy");
    let line = common::check_line(&scene.camera(Some("lefd")).expect_err("unknown"));
    assert!(line.contains("did you mean `left`?"), "{line}");
    assert_eq!(scene.camera(Some("right")).expect("known").name, "right");
    assert_eq!(scene.camera(None).expect("default").name, "centre");
}
