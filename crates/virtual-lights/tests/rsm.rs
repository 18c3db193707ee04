//! Maps of primary lights against the light that they emit.

use std::f32::consts::PI;

use glam::Vec3;
use manylights_scene::{Light, Scene};
use manylights_virtual_lights::{Map, maps};

fn scene() -> Scene {
    manylights_scene::load("cornell", None).expect("built in")
}

fn flux(maps: &[Map]) -> f32 {
    let cells = |map: &Map| {
        let [columns, rows] = map.projection.resolution;
        let map = *map;
        (0..rows).flat_map(move |row| (0..columns).map(move |column| map.cell(column, row).flux.x))
    };
    maps.iter().flat_map(cells).sum()
}

#[test]
fn a_point_light_emits_4_pi_intensity() {
    let light = Light::Point { position: Vec3::Y, intensity: Vec3::splat(2.0) };
    for (count, seed) in [(1, 0), (100, 0), (1000, 7)] {
        let maps = maps(&scene(), &light, count, seed);
        assert_eq!(maps.len(), 6);
        assert!((flux(&maps) / (8.0 * PI) - 1.0).abs() < 1e-5, "{count} {seed}");
    }
}

/// 2π I ((1 − c) + (c − c')/3) of the cosines c and c' of the inner and the outer angle: the edge is the square
/// of a linear ramp in the cosine. A narrow spot has one map, a wide one a cube.
#[test]
fn a_spot_emits_what_its_edge_lets_through() {
    let direction = Vec3::new(0.3, -0.8, 0.4).normalize();
    for (inner, outer, count) in [(0.3_f32, 0.5_f32, 1), (0.9, 1.4, 6)] {
        let intensity = Vec3::splat(2.0);
        let light = Light::Spot { position: Vec3::Y, direction, intensity, inner, outer };
        let (c, c_outer) = (inner.cos(), outer.cos());
        let expected = 4.0 * PI * ((1.0 - c) + (c - c_outer) / 3.0);
        for seed in [0, 7] {
            let maps = maps(&scene(), &light, 60_000, seed);
            assert_eq!(maps.len(), count);
            let error = flux(&maps) / expected - 1.0;
            assert!(error.abs() < 1e-3, "{outer} {seed}: {error:e}");
        }
    }
}

/// The map covers the scene, and each cell carries E ΔA.
#[test]
fn parallel_light_fills_its_map() {
    let direction = Vec3::new(0.3, -0.5, -1.0).normalize();
    let light = Light::Directional { direction, irradiance: Vec3::splat(3.0) };
    for seed in [0, 7] {
        let maps = maps(&scene(), &light, 1000, seed);
        let [map] = &maps[..] else { panic!("one map") };
        let projection = &map.projection;
        let area = 4.0 * projection.right.cross(projection.up).length();
        assert!((flux(&maps) / (3.0 * area) - 1.0).abs() < 1e-5);
        for vertex in scene().vertices {
            let offset = vertex.position - projection.origin;
            for axis in [projection.right, projection.up] {
                let coordinate = offset.dot(axis) / axis.length_squared();
                assert!(coordinate.abs() <= 1.0, "{coordinate}");
            }
            assert!(offset.dot(direction) > 0.0);
        }
    }
}
