//! Radii of virtual lights, from their local density: shared by all methods that inflate their lights.

use std::time::Instant;

use glam::Vec3;
use manylights_gpu::{PassTime, Projection};
use manylights_scene::{Light, Scene};
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::virtual_light::LitMap;

/// How far a virtual light reaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RadiusRule {
    /// Distance to the farthest of the ten nearest lights of all maps (Hašan et al. 2009; thesis 5.2.4 speaks of
    /// the closest neighbours).
    NearestNeighbours,
    /// r₁, thesis 5.9: the mean distance to the eight neighbours on the map, weighted by how alike
    /// their distances to the primary light are.
    MapNeighbours,
    /// r₂, thesis 5.10 and 5.12: the distance between diagonal neighbours on a surface that faces the
    /// primary light. For a directional light, whose map has no angle, the diagonal of a cell.
    FieldOfView,
    /// One metre, for the user's factor to scale (thesis figure 5.8: 0.25).
    Fixed,
}

impl RadiusRule {
    /// Every rule, in the order of the words of [`RADIUS`](crate::RADIUS).
    pub const ALL: [Self; 4] =
        [Self::NearestNeighbours, Self::MapNeighbours, Self::FieldOfView, Self::Fixed];
}

/// Lights that [`RadiusRule::NearestNeighbours`] asks.
const NEIGHBOURS: usize = 10;

/// ε of thesis 5.9, as a part of the scene's size: the thesis gives no value, and one in metres would
/// make the radius depend on the unit of length.
const EPSILON: f32 = 1e-3;

/// The radius of each light in metres, in the order of [`distribute`](crate::distribute), and what
/// computing them took on the processor.
///
/// A light that has no neighbours under the first two rules gets radius 0: it is a point.
pub fn radii(scene: &Scene, maps: &[LitMap], rule: RadiusRule) -> (Vec<f32>, PassTime) {
    let start = Instant::now();
    let radii = match rule {
        RadiusRule::NearestNeighbours => nearest_neighbours(maps),
        RadiusRule::MapNeighbours => {
            let epsilon = EPSILON * scene.size();
            maps.iter().flat_map(|map| map_neighbours(map, epsilon)).collect()
        }
        RadiusRule::FieldOfView => maps.iter().flat_map(field_of_view).collect(),
        RadiusRule::Fixed => {
            maps.iter().flat_map(|map| map.lights.iter().flatten()).map(|_| 1.0).collect()
        }
    };
    (radii, PassTime { pass: "radius", seconds: start.elapsed().as_secs_f64() })
}

fn nearest_neighbours(maps: &[LitMap]) -> Vec<f32> {
    let positions: Vec<[f32; 3]> = maps
        .iter()
        .flat_map(|map| map.lights.iter().flatten())
        .map(|light| light.position.to_array())
        .collect();
    let points = positions.iter().zip(0_usize..).map(|(&at, index)| GeomWithData::new(at, index));
    let tree = RTree::bulk_load(points.collect());
    let radius = |(position, index): (&[f32; 3], usize)| {
        let others = tree.nearest_neighbor_iter_with_distance_2(*position);
        let others = others.filter(|(point, _)| point.data != index).take(NEIGHBOURS);
        others.last().map_or(0.0, |(_, distance2)| distance2.sqrt())
    };
    positions.iter().zip(0..).map(radius).collect()
}

fn map_neighbours(lit: &LitMap, epsilon: f32) -> impl Iterator<Item = f32> {
    let [columns, rows] = lit.map.projection.resolution.map(i64::from);
    let light_at = move |column: i64, row: i64| {
        let inside = (0..columns).contains(&column) && (0..rows).contains(&row);
        inside.then(|| lit.lights[(row * columns + column) as usize].as_ref()).flatten()
    };
    (0..rows).flat_map(move |row| (0..columns).map(move |column| (column, row))).filter_map(
        move |(column, row)| {
            let light = light_at(column, row)?;
            let depth = depth(&lit.map.light, light.position);
            let steps = (0..9).filter(|step| *step != 4).map(|step| (step % 3 - 1, step / 3 - 1));
            let neighbours = steps.filter_map(|(x, y)| light_at(column + x, row + y));
            let (sum, weights) = neighbours.fold((0.0, 0.0), |(sum, weights), other| {
                let apart = (depth - self::depth(&lit.map.light, other.position)).abs();
                let weight = 1.0 / (apart + epsilon);
                (sum + weight * light.position.distance(other.position), weights + weight)
            });
            Some(if weights > 0.0 { sum / weights } else { 0.0 })
        },
    )
}

fn field_of_view(lit: &LitMap) -> impl Iterator<Item = f32> {
    let Projection { right, up, orthographic, resolution: [columns, rows], .. } =
        lit.map.projection;
    let lights = lit.lights.iter().flatten();
    let (columns, rows) = (columns as f32, rows as f32);
    let [half_width, half_height] = [right, up].map(Vec3::length);
    // √2 λ/side where a map has as many rows as columns.
    let gamma = 2.0 * (half_width.atan() / columns).hypot(half_height.atan() / rows);
    let tangent = gamma + gamma.powi(3) / 3.0;
    let diagonal = 2.0 * (half_width / columns).hypot(half_height / rows);
    lights.map(move |light| match orthographic {
        0 => depth(&lit.map.light, light.position) * tangent,
        _ => diagonal,
    })
}

/// Distance from the primary light in metres; for a directional one, along its direction.
fn depth(light: &Light, position: Vec3) -> f32 {
    match *light {
        Light::Point { position: origin, .. } | Light::Spot { position: origin, .. } => {
            position.distance(origin)
        }
        Light::Directional { direction, .. } => position.dot(direction),
    }
}
