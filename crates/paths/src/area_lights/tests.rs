//! The sets of directions, on their own.

use std::f64::consts::TAU;

use super::subtended::Subtended;
use glam::{DVec3, Vec3};
use manylights_scene::AreaLight;

fn triangle(corners: [Vec3; 3]) -> AreaLight {
    AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: false }
}

fn sphere(center: Vec3, radius: f32) -> AreaLight {
    AreaLight::Sphere { center, radius, radiance: Vec3::ONE }
}

/// Seen from the origin, from 1e-9 sr to nearly all of the half space behind a triangle.
fn lights() -> Vec<AreaLight> {
    let corners = [Vec3::new(0.2, 0.5, 1.1), Vec3::new(0.3, -0.2, 0.9), Vec3::new(-0.4, 0.1, 0.7)];
    let scaled = |size: f32| {
        let center = (corners[0] + corners[1] + corners[2]) / 3.0;
        triangle(corners.map(|corner| center + size * (corner - center)))
    };
    let mut lights = vec![scaled(1e-4), scaled(0.01), scaled(1.0), scaled(3.0)];
    // In a plane just above the origin, around it.
    lights.push(triangle(
        [(0.0, 1.0), (1.0, -1.0), (-1.0, -1.0)].map(|(x, y)| Vec3::new(x, y, 0.02)),
    ));
    for radius in [1e-4, 0.1, 0.9, 0.99999, 2.0] {
        lights.push(sphere(Vec3::new(0.0, 0.6, 0.8), radius));
    }
    lights
}

fn subtended(light: &AreaLight) -> Subtended {
    let normal = Vec3::new(0.3, 0.2, 1.0).normalize();
    Subtended::new(light, Vec3::ZERO, normal).expect("above the horizon, from the front")
}

/// Strata of the square are strata of the set: means of polynomials over n² cells tend to those over all
/// directions that belong to it, found on a grid, with its share of them; and all samples belong to it.
#[test]
fn samples_are_uniform_in_the_set() {
    const CELLS: u32 = 256;
    for light in lights() {
        let set = subtended(&light);
        let (mut count, mut samples) = (0, [DVec3::ZERO; 2]);
        let mut inside = 0;
        for (i, j) in (0..CELLS).flat_map(|i| (0..CELLS).map(move |j| (i, j))) {
            let [u, v] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(CELLS));
            let direction = set.sample([u, v]);
            assert!((direction.length() - 1.0).abs() < 1e-9, "{light:?}");
            inside += u32::from(set.contains(direction));
            count += 1;
            samples[0] += direction;
            samples[1] += direction * direction;
        }
        assert!(inside == count, "{inside} of {count}: {light:?}");
        if set.solid_angle() < 1e-3 {
            continue; // too small for the grid
        }
        let (mut found, mut grid) = (0.0, [DVec3::ZERO; 2]);
        const ROWS: u32 = 2000;
        for (i, j) in (0..ROWS).flat_map(|i| (0..ROWS).map(move |j| (i, j))) {
            let z = 2.0 * (f64::from(i) + 0.5) / f64::from(ROWS) - 1.0;
            let angle = TAU * (f64::from(j) + 0.5) / f64::from(ROWS);
            let sine = (1.0 - z * z).sqrt();
            let direction = DVec3::new(sine * angle.cos(), sine * angle.sin(), z);
            if set.contains(direction) {
                found += 1.0;
                grid[0] += direction;
                grid[1] += direction * direction;
            }
        }
        let area = 2.0 * TAU * found / f64::from(ROWS * ROWS);
        // Cells of the grid that the boundary cuts.
        let blur = 4.0 * (2.0 * TAU / f64::from(ROWS * ROWS)).sqrt() * 0.05;
        assert!((area - set.solid_angle()).abs() < blur, "{area} {}: {light:?}", set.solid_angle());
        for (sampled, expected) in samples.iter().zip(grid) {
            let error = (*sampled / f64::from(count) - expected / found).abs().max_element();
            assert!(error < 1e-3 + blur / area, "{error}: {light:?}");
        }
    }
}

/// Small triangles keep their digits: they are flat, and means of samples are their centroids.
#[test]
fn small_triangles_are_sampled_like_flat_ones() {
    for (size, far) in [(1e-3_f32, 0.0_f32), (1e-5, 0.0), (1.0, 1e5), (1e-4, 1e3)] {
        let corners = [(1.0, 0.0), (-0.3, -1.0), (-0.7, 0.6)]
            .map(|(x, y)| Vec3::new(size * x, size * y, 1.0 + far + size * x));
        let flipped = [corners[0], corners[2], corners[1]];
        let set = Subtended::new(&triangle(flipped), Vec3::ZERO, Vec3::Z)
            .or_else(|| Subtended::new(&triangle(corners), Vec3::ZERO, Vec3::Z))
            .expect("one side is the front");
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let distance = f64::from(1.0 + far);
        let flat = 0.5 * ((b - a).cross(c - a)).dot(-(a + b + c) / 3.0).abs() / distance.powi(3);
        let ratio = set.solid_angle() / flat;
        assert!((ratio - 1.0).abs() < 4e-3, "{ratio}");
        let mut mean = DVec3::ZERO;
        for (i, j) in (0..64).flat_map(|i| (0..64).map(move |j| (i, j))) {
            let direction = set.sample([i, j].map(|k| (f64::from(k) + 0.5) / 64.0));
            let along = set.distance(direction);
            assert!((along / distance - 1.0).abs() < 2.0 * f64::from(size) / distance + 1e-9);
            mean += along * direction / 4096.0;
        }
        let error = (mean - (a + b + c) / 3.0).length() / f64::from(size);
        assert!(error < 1e-3 + f64::from(size / (1.0 + far)), "{error}");
    }
}

/// Distances are those of the analytic hits.
#[test]
fn distances_lead_to_the_surface() {
    for light in lights() {
        let set = subtended(&light);
        for k in 0..50 {
            let numbers = [0.1, 0.07].map(|step| (f64::from(k) * step).fract());
            let direction = set.sample(numbers);
            let hit = set.distance(direction) * direction;
            match light {
                AreaLight::Sphere { radius, .. } if radius >= 1.0 => assert_eq!(hit, DVec3::ZERO),
                AreaLight::Sphere { center, radius, .. } => {
                    let error = (hit - center.as_dvec3()).length() - f64::from(radius);
                    assert!(error.abs() < 1e-7, "{error}: {light:?}");
                }
                AreaLight::Triangle { corners: [a, b, c], .. } => {
                    let [a, b, c] = [a, b, c].map(Vec3::as_dvec3);
                    let normal = (b - a).cross(c - a).normalize();
                    assert!((hit - a).dot(normal).abs() < 1e-9, "{light:?}");
                }
            }
        }
    }
}
