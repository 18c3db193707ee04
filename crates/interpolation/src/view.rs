//! What all pixels are told.

use bytemuck::{Pod, Zeroable};
use glam::{UVec3, Vec3};
use manylights_gpu::Buffer;

use crate::Grid;

/// Pixels, and what is there.
pub struct Pixels<'a> {
    /// What each sees; the first `count` are read.
    pub surfaces: &'a Buffer,
    /// Their number.
    pub count: u32,
    /// From where, metres.
    pub camera: Vec3,
    /// The tables of the lobes where there are specular ones: [`SHAPES`](manylights_reflectance::SHAPES) and
    /// [`LOBES`](manylights_reflectance::LOBES).
    pub tables: &'a [Buffer],
    /// Radiance, a `vec4f` each, W·m⁻²·sr⁻¹: what is read is added.
    pub results: &'a Buffer,
}

/// As [`VIEW`] has it.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct View {
    camera: Vec3,
    pixels: u32,
    origin: Vec3,
    padding: u32,
    per_metre: Vec3,
    more_padding: u32,
    cells: UVec3,
    last_padding: u32,
}

/// The uniform `view`: the grid's spacing as its inverse, and its cells along each axis.
pub(crate) const VIEW: &str = "struct View {\n    camera: vec3f,\n    pixels: u32,\n    \
                               origin: vec3f,\n    per_metre: vec3f,\n    cells: vec3u,\n}\n";

impl View {
    pub(crate) fn new(grid: &Grid<f32>, pixels: &Pixels<'_>) -> Self {
        Self {
            camera: pixels.camera,
            pixels: pixels.count,
            origin: grid.origin.into(),
            per_metre: grid.spacing.map(f32::recip).into(),
            cells: grid.vertices.map(|vertices| vertices as u32 - 1).into(),
            padding: 0,
            more_padding: 0,
            last_padding: 0,
        }
    }
}
