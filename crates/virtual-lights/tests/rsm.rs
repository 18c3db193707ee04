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
    for (across, seed) in [([1.0; 2], 0), ([10.3, 9.6], 0), ([31.7; 2], 7)] {
        let maps = maps(&scene(), &light, across, seed);
        assert_eq!(maps.len(), 6);
        assert!((flux(&maps) / (8.0 * PI) - 1.0).abs() < 1e-5, "{across:?} {seed}");
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
            let across = (60_000.0 / count as f64).sqrt();
            let maps = maps(&scene(), &light, [across; 2], seed);
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
        let maps = maps(&scene(), &light, [31.3, 30.2], seed);
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

/// Beyond the cone of a spot no light goes, so a map that reaches farther carries the same.
#[test]
fn a_spot_emits_alike_on_any_map() {
    let [direction, position] = [Vec3::new(0.3, -0.5, -1.0).normalize(), Vec3::ONE];
    let light =
        Light::Spot { position, direction, intensity: Vec3::splat(2.0), inner: 0.4, outer: 0.7 };
    let fine = flux(&maps(&scene(), &light, [500.0; 2], 0));
    for (across, whole) in
        [([40.0, 40.0], [40, 40]), ([40.1, 40.9], [41, 41]), ([36.5, 44.2], [37, 45])]
    {
        let maps = maps(&scene(), &light, across, 3);
        assert_eq!(maps[0].projection.resolution, whole);
        assert!((flux(&maps) / fine - 1.0).abs() < 0.01, "{across:?}");
        // As wide as the cone has cells across.
        let width = maps[0].projection.right.length() / 0.7_f32.tan();
        assert!(
            (f64::from(width) * across[0] / f64::from(whole[0]) - 1.0).abs() < 1e-5,
            "{across:?}"
        );
    }
}
