//! How fine the maps of primary lights are, so that as many of their cells as asked for carry a light.
//!
//! Cells outside of a spot's cone, in front of which no surface lies, or whose surface turns away carry
//! none. How many these are depends on the scene, so the maps are found by trying.

use manylights_gpu::{Error, GpuFrame};
use manylights_scene::Scene;

use crate::rsm::{Map, maps};
use crate::virtual_light::lit_maps;

/// Lit cells may miss what is sought by this part of it.
const TOLERANCE: f64 = 0.01;

/// Maps that are tried for a primary light.
const TRIES: i32 = 16;

/// By how much cells are longer than wide in later tries, and again every two tries.
const STRETCH: f64 = 1.04;

/// Lit cells that are counted at most: beyond, the share of cells that are lit is known well enough.
const COUNTED: u64 = 1 << 14;

/// Cells for each light at most, so that the maps of a primary light that lights nearly nothing do not
/// outgrow the adapter.
const CELLS_A_LIGHT: f64 = 64.0;

/// The maps of all primary lights on which `count` cells in all carry a light, split evenly between the
/// primary lights. Of each at least one is sought.
///
/// # Errors
/// Where the maps exceed what the adapter holds.
pub fn scene_maps(
    frame: &GpuFrame,
    scene: &Scene,
    count: u64,
    seed: u64,
) -> Result<Vec<Map>, Error> {
    let among = scene.lights.len() as u64;
    let mut found = Vec::new();
    for (light, index) in scene.lights.iter().zip(0_u64..) {
        let share = count * (index + 1) / among - count * index / among;
        let maps = |across| maps(scene, light, across, seed);
        let across = cells_across(share.max(1), |across| lit_cells(frame, scene, &maps(across)))?;
        found.extend(maps(across));
    }
    Ok(found)
}

fn lit_cells(frame: &GpuFrame, scene: &Scene, maps: &[Map]) -> Result<u64, Error> {
    let (lit, _) = lit_maps(frame, scene, maps)?;
    Ok(lit.iter().map(|map| map.lights.iter().flatten().count() as u64).sum())
}

/// How many cells across have `wanted` lit ones, or nearly; the square of `wanted` where none are.
///
/// The share of lit cells among all that were tried tells how many the next try has. What is lit jumps
/// where a row of cells meets an edge, by the whole row where the map lies parallel to it, as with seed 0;
/// so where the right number is jumped over, later tries have cells that are not quite square.
fn cells_across(
    wanted: u64,
    lit_cells: impl Fn([f64; 2]) -> Result<u64, Error>,
) -> Result<[f64; 2], Error> {
    let sought = wanted.min(COUNTED) as f64;
    let most = CELLS_A_LIGHT * sought;
    let (mut cells, mut across) = (sought, [sought.sqrt(); 2]);
    let (mut nearest, mut least) = (across, sought);
    let (mut tried, mut lit) = (0.0, 0.0);
    for step in 1..=TRIES {
        let found = lit_cells(across)? as f64;
        let missed = (found - sought).abs();
        if missed < least {
            (nearest, least) = (across, missed);
        }
        if missed <= TOLERANCE * sought || cells == most {
            break;
        }
        (tried, lit) = (tried + cells, lit + found);
        cells = if lit == 0.0 { 8.0 * tried } else { sought * tried / lit };
        cells = cells.min(most);
        let alternating = if step % 2 == 0 { 1 - step } else { step - 1 };
        let stretch = STRETCH.powi(alternating / 2);
        across = [cells * stretch, cells / stretch].map(f64::sqrt);
    }
    Ok(nearest.map(|cells| cells * (wanted as f64 / sought).sqrt()))
}
