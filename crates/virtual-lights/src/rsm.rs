//! Reflective shadow maps (Dachsbacher and Stamminger 2005): which projections show a primary light
//! its surroundings, and what each cell of them carries.

use glam::Vec3;
use manylights_gpu::Projection;
use manylights_scene::{Light, Scene};

use crate::solid_angle::rectangle_solid_angle;

/// One map of a primary light. A point light has six.
#[derive(Clone, Copy, Debug)]
pub struct Map {
    /// Its rays.
    pub projection: Projection,
    /// The light that it belongs to.
    pub light: Light,
}

/// A ray of a map and what travels along it.
#[derive(Clone, Copy, Debug)]
pub struct MapCell {
    /// Unit direction in which the light travels.
    pub direction: Vec3,
    /// I(ω)·Δω of the cell, or E⊥·ΔA for a directional light: watts.
    pub flux: Vec3,
}

/// Spots wider than this take a cube as point lights do: a single perspective map would spend most
/// of its cells on the rim.
const WIDEST_SPOT_MAP: f32 = 1.2;

/// The maps of a light, with so many cells across what it lights and so many along: the square around a
/// spot's cone, the scene as a directional light sees it, or a face of the cube about a point light.
///
/// These need not be whole numbers: a single map reaches beyond what the light lights until it has whole
/// cells. Faces of a cube have no room for that, so their numbers are rounded.
///
/// Seed 0 samples cells at their centres, as the papers do. Other seeds shift the sample inside the
/// cells and turn the maps of a spot about its axis, so that seeds give independent placements.
pub fn maps(scene: &Scene, light: &Light, across: [f64; 2], seed: u64) -> Vec<Map> {
    let [u, v, turn] = placement(seed);
    let size = scene.size();
    let whole = across.map(|cells| cells.ceil().max(1.0));
    let resolution = whole.map(|cells| cells as u32);
    let margin: [f32; 2] = std::array::from_fn(|i| (whole[i] / across[i].max(1.0)) as f32);
    let rounded = across.map(|cells| (cells / 6_f64.sqrt()).round().max(1.0) as u32);
    let mut projections = match *light {
        Light::Spot { position, direction, outer, .. } if outer < WIDEST_SPOT_MAP => {
            let (right, up) = turned_axes(direction, turn);
            let [edge_right, edge_up] = margin.map(|margin| margin * outer.tan());
            let axes = [edge_right * right, edge_up * up, direction];
            vec![Projection::perspective(position, axes, resolution, size)]
        }
        Light::Spot { position, .. } | Light::Point { position, .. } => {
            cube_faces().map(|axes| Projection::perspective(position, axes, rounded, size)).to_vec()
        }
        Light::Directional { direction, .. } => {
            vec![covering(scene, direction, turn, resolution, margin)]
        }
    };
    for projection in &mut projections {
        projection.offset = [u, v];
    }
    projections.into_iter().map(|projection| Map { projection, light: *light }).collect()
}

impl Map {
    /// The same map with each cell cut into `side`² cells.
    pub fn refined(&self, side: u32) -> Self {
        let mut refined = *self;
        refined.projection.resolution = self.projection.resolution.map(|cells| cells * side);
        refined
    }

    /// Direction and flux of a cell. The cells of a light add up to its flux through the map, up to
    /// the variation of a spot's intensity inside a cell, which is taken at the sample.
    pub fn cell(&self, column: u32, row: u32) -> MapCell {
        let (_, direction) = self.projection.ray(column, row);
        let flux = match self.light {
            Light::Directional { irradiance, .. } => {
                let area = 4.0 * self.projection.right.length() * self.projection.up.length();
                let [width, height] = self.projection.resolution.map(|n| n as f32);
                irradiance * (area / (width * height))
            }
            _ => self.light.intensity(direction) * self.solid_angle(column, row) as f32,
        };
        MapCell { direction, flux }
    }

    /// Exact solid angle of a cell of a perspective map, sr.
    pub fn solid_angle(&self, column: u32, row: u32) -> f64 {
        let edges = |index: u32, cells: u32, half: f32| {
            let half = f64::from(half);
            let edge = |i: u32| (2.0 * f64::from(i) / f64::from(cells) - 1.0) * half;
            [edge(index), edge(index + 1)]
        };
        let [width, height] = self.projection.resolution;
        rectangle_solid_angle(
            edges(column, width, self.projection.right.length()),
            edges(row, height, self.projection.up.length()),
        )
    }
}

/// Offset in the cell and turn in units of 2π.
fn placement(seed: u64) -> [f32; 3] {
    if seed == 0 {
        return [0.5, 0.5, 0.0];
    }
    [1, 2, 3].map(|stream| {
        let hash = split_mix(seed.wrapping_mul(4).wrapping_add(stream));
        // 24 bits fill an f32; never 0 or 1, which would be the cell's edge.
        ((hash >> 40) as f32 + 0.5) / (1_u64 << 24) as f32
    })
}

/// `SplitMix64` (Steele et al. 2014).
fn split_mix(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

fn turned_axes(forward: Vec3, turn: f32) -> (Vec3, Vec3) {
    let (a, b) = forward.any_orthonormal_pair();
    let (sin, cos) = (turn * std::f32::consts::TAU).sin_cos();
    (cos * a + sin * b, cos * b - sin * a)
}

/// Right, up, forward of the six faces.
fn cube_faces() -> [[Vec3; 3]; 6] {
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    std::array::from_fn(|face| {
        let forward = if face % 2 == 0 { axes[face / 2] } else { -axes[face / 2] };
        [axes[(face / 2 + 1) % 3], axes[(face / 2 + 2) % 3], forward]
    })
}

/// The smallest orthographic map in these axes that shows the whole scene, `margin` times as wide and
/// high.
fn covering(
    scene: &Scene,
    forward: Vec3,
    turn: f32,
    resolution: [u32; 2],
    margin: [f32; 2],
) -> Projection {
    let (right, up) = turned_axes(forward, turn);
    let mut low = Vec3::INFINITY;
    let mut high = Vec3::NEG_INFINITY;
    for vertex in &scene.vertices {
        let p = vertex.position;
        let local = Vec3::new(p.dot(right), p.dot(up), p.dot(forward));
        low = low.min(local);
        high = high.max(local);
    }
    // A hair of slack keeps the outermost faces inside the depth range.
    let slack = 1e-4 * (high - low).max_element();
    low -= slack;
    high += slack;
    let center = 0.5 * (low + high);
    let half = 0.5 * (high - low);
    let origin = center.x * right + center.y * up + low.z * forward;
    let axes = [margin[0] * half.x * right, margin[1] * half.y * up, forward];
    Projection::orthographic(origin, axes, resolution, high.z - low.z)
}
