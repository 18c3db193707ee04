//! Radii of virtual lights against what they are made of.

use std::f32::consts::{FRAC_PI_2, SQRT_2};

use glam::Vec3;
use manylights_gpu::Projection;
use manylights_scene::{Brdf, Light, Scene};
use manylights_virtual_lights::{LitMap, Map, RadiusRule, VirtualLight, radii};

const DISTANCE: f32 = 3.0;

fn scene() -> Scene {
    manylights_scene::load("cornell", None).expect("built in")
}

/// Lights on the plane z = `DISTANCE` where a spot at the origin with a field of view of 90° sees
/// them, as `place` moves them; none where it says so.
fn lit(side: u32, place: impl Fn(u32, Vec3) -> Option<Vec3>) -> LitMap {
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    let projection = Projection::perspective(Vec3::ZERO, axes, [side; 2], 1.0);
    let light = Light::Point { position: Vec3::ZERO, intensity: Vec3::ONE };
    let virtual_light = |index: u32| {
        let (_, direction) = projection.ray(index % side, index / side);
        let position = place(index, direction * (DISTANCE / direction.z))?;
        Some(VirtualLight {
            position,
            geometric_normal: -Vec3::Z,
            normal: -Vec3::Z,
            incoming: -direction,
            flux: Vec3::ONE,
            brdf: Brdf::lambert(Vec3::ONE),
        })
    };
    let lights = (0..side * side).map(virtual_light).collect();
    LitMap { map: Map { projection, light }, lights }
}

#[test]
fn ten_nearest_lights() {
    // Places without order, some cells empty, over two maps.
    let scattered = |index: u32, at: Vec3| {
        let shift = |factor: f32| (index as f32 * factor).sin();
        let moved = at + Vec3::new(shift(12.9), shift(78.2), 4.0 * shift(37.7));
        (!index.is_multiple_of(7)).then_some(moved)
    };
    let maps = [lit(12, scattered), lit(9, scattered)];
    let (found, _) = radii(&scene(), &maps, RadiusRule::NearestNeighbours);
    let positions: Vec<Vec3> =
        maps.iter().flat_map(|map| map.lights.iter().flatten()).map(|l| l.position).collect();
    assert_eq!(found.len(), positions.len());
    for (position, radius) in positions.iter().zip(found) {
        let mut distances: Vec<f32> = positions.iter().map(|p| p.distance(*position)).collect();
        distances.sort_by(f32::total_cmp);
        // The first is the light itself.
        assert!((distances[10] - radius).abs() < 1e-6 * distances[10]);
    }
}

#[test]
fn neighbours_on_the_map() {
    // A facing plane: neighbours at h and √2 h, in the middle of the map at almost equal distances
    // from the primary light.
    let side = 41;
    let (found, _) = radii(&scene(), &[lit(side, |_, at| Some(at))], RadiusRule::MapNeighbours);
    let spacing = 2.0 * DISTANCE / side as f32;
    let middle = found[(side * side / 2) as usize];
    let depth = |steps: f32| (DISTANCE.powi(2) + steps * spacing.powi(2)).sqrt() - DISTANCE;
    let [beside, diagonal] = [1.0, 2.0].map(|steps| 1.0 / (depth(steps) + 1e-3 * scene().size()));
    let expected = (beside + diagonal * SQRT_2) / (beside + diagonal) * spacing;
    assert!((middle / expected - 1.0).abs() < 1e-3, "{middle} {expected}");
    // A column that lies ten times as far: its own two neighbours outweigh the six before it, at
    // twenty times the spacing between them.
    let behind = |index: u32, at: Vec3| Some(if index % side == 20 { 10.0 * at } else { at });
    let (found, _) = radii(&scene(), &[lit(side, behind)], RadiusRule::MapNeighbours);
    let far = found[(20 * side + 20) as usize];
    let alike = 10.0 * spacing;
    assert!(alike < far && far < 1.1 * alike, "{far} {alike}");
}

#[test]
fn field_of_view() {
    // Thesis 5.10 and 5.12 for λ = 90°.
    let side = 41;
    let (found, _) = radii(&scene(), &[lit(side, |_, at| Some(at))], RadiusRule::FieldOfView);
    let angle = SQRT_2 * FRAC_PI_2 / side as f32;
    let middle = found[(side * side / 2) as usize];
    let expected = DISTANCE * (angle + angle.powi(3) / 3.0);
    assert!((middle / expected - 1.0).abs() < 1e-5, "{middle} {expected}");
    // The diagonal of cells that are half as high.
    let mut flat = lit(side, |_, at| Some(at));
    flat.map.projection.resolution[1] *= 2;
    let (flat, _) = radii(&scene(), &[flat], RadiusRule::FieldOfView);
    let angle = (FRAC_PI_2 / side as f32).hypot(FRAC_PI_2 / (2 * side) as f32);
    let expected = DISTANCE * (angle + angle.powi(3) / 3.0);
    let ratio = flat[(side * side / 2) as usize] / expected;
    assert!((ratio - 1.0).abs() < 1e-5, "{ratio}");
    // Proportional to the distance from the primary light.
    let corner = found[0] / middle;
    let farther = (2.0 * (1.0 - 1.0 / side as f32).powi(2) + 1.0).sqrt();
    assert!((corner / farther - 1.0).abs() < 1e-5, "{corner} {farther}");
}

/// Parallel light has no angle: the diagonal of a cell, which need not be square.
#[test]
fn field_of_view_of_parallel_light() {
    let axes = [2.0 * Vec3::X, 3.0 * Vec3::Y, Vec3::Z];
    let projection = Projection::orthographic(Vec3::ZERO, axes, [4; 2], 10.0);
    let light = Light::Directional { direction: Vec3::Z, irradiance: Vec3::ONE };
    let lights = lit(4, |_, at| Some(at)).lights;
    let (found, _) = radii(
        &scene(),
        &[LitMap { map: Map { projection, light }, lights }],
        RadiusRule::FieldOfView,
    );
    let expected = 1.0_f32.hypot(1.5);
    assert!(found.iter().all(|radius| (radius / expected - 1.0).abs() < 1e-6), "{found:?}");
}

#[test]
fn a_lone_light_is_a_point_without_neighbours() {
    let lone = [lit(5, |index, at| (index == 12).then_some(at))];
    for (rule, point) in [
        (RadiusRule::NearestNeighbours, true),
        (RadiusRule::MapNeighbours, true),
        (RadiusRule::FieldOfView, false),
    ] {
        let (found, _) = radii(&scene(), &lone, rule);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0] == 0.0, point, "{rule:?}: {found:?}");
    }
}
