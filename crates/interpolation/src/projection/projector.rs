//! Batches of lights over all vertices, in compute passes.

use bytemuck::{Pod, Zeroable};
use manylights_gpu::{Buffer, Error, Gpu, PassTime, Resource, UniformBatches};
use manylights_harmonics::count;

use super::shader::{LANES, ProjectionShader};
use crate::Grid;

/// Coefficients of radiance at all vertices of a grid, in the world's frame.
#[derive(Clone)]
pub struct GridCoefficients {
    /// Where the vertices lie.
    pub grid: Grid<f32>,
    /// Of each expansion.
    pub bands: usize,
    /// Whether gradients are there.
    pub gradients: bool,
    /// `array<vec4f>`, as the crate's head has it, W·m⁻²·sr⁻¹ times sr.
    pub buffer: Buffer,
}

impl GridCoefficients {
    /// Of no light.
    ///
    /// # Errors
    /// Where the adapter refuses the buffer.
    pub fn zero(gpu: &Gpu, grid: Grid<f32>, bands: usize, gradients: bool) -> Result<Self, Error> {
        let channels = if gradients { 3 } else { 1 };
        let size = (grid.count() * count(bands) * channels * size_of::<[f32; 4]>()) as u64;
        let buffer = gpu.zeroed("coefficients of a grid", size)?;
        Ok(Self { grid, bands, gradients, buffer })
    }
}

/// As `shaders/vertices.wesl` has it.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Told {
    spacing: [f32; 3],
    vertices: u32,
}

/// The coefficients of lights, `records` of a kernel's, at the vertices of a grid, and the time of each pass.
///
/// # Errors
/// Where the adapter refuses the kernel or a buffer, or the device gave up.
pub fn project<R: Pod>(
    gpu: &Gpu,
    grid: Grid<f32>,
    shader: &ProjectionShader,
    records: &[R],
) -> Result<(GridCoefficients, Vec<PassTime>), Error> {
    let result = GridCoefficients::zero(gpu, grid, shader.bands, shader.gradients)?;
    let times = result.add(gpu, shader, records)?;
    Ok((result, times))
}

impl GridCoefficients {
    /// Adds those of further lights, and tells the time of each pass.
    ///
    /// # Errors
    /// As [`project`].
    pub fn add<R: Pod>(
        &self,
        gpu: &Gpu,
        shader: &ProjectionShader,
        records: &[R],
    ) -> Result<Vec<PassTime>, Error> {
        let grid = self.grid;
        let vertices = grid.count() as u32;
        let positions: Vec<[f32; 4]> = grid.positions().map(|[x, y, z]| [x, y, z, 1.0]).collect();
        let positions = gpu.storage("vertices", &positions)?;
        let told = gpu.uniform("grid", &Told { spacing: grid.spacing, vertices })?;
        let batches =
            UniformBatches::new(gpu, "lights", records, shader.capacity, shader.capacity)?;
        let resources = [
            Resource::Buffer(&told),
            Resource::Buffer(&positions),
            Resource::Batches(&batches),
            Resource::Buffer(&self.buffer),
        ];
        let pass = gpu.pass("project", &shader.compile(gpu)?, &resources)?;
        let workgroups = [vertices.div_ceil(LANES), shader.lanes, 1];
        let dispatches: Vec<_> =
            (0..batches.counts().len()).map(|index| pass.over_batch(index, workgroups)).collect();
        gpu.run(&dispatches)
    }
}
