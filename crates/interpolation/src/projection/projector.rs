//! Batches of lights over all vertices, in compute passes.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use manylights_gpu::{Buffer, Error, Gpu, Kernel, PassTime, Resource, UniformBatches};
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

/// What projects lights at the vertices of one grid: kept for lights that move, so that nothing is made anew but
/// their records.
pub struct Projector {
    gpu: Gpu,
    kernel: Arc<Kernel>,
    capacity: usize,
    workgroups: [u32; 3],
    told: Buffer,
    positions: Buffer,
    coefficients: GridCoefficients,
}

impl Projector {
    /// Of no light yet.
    ///
    /// # Errors
    /// Where the adapter refuses the kernel or a buffer.
    pub fn new(gpu: &Gpu, grid: Grid<f32>, shader: &ProjectionShader) -> Result<Self, Error> {
        let none = GridCoefficients::zero(gpu, grid, shader.bands, shader.gradients)?;
        Self::onto(gpu, shader, none)
    }

    fn onto(
        gpu: &Gpu,
        shader: &ProjectionShader,
        coefficients: GridCoefficients,
    ) -> Result<Self, Error> {
        let grid = coefficients.grid;
        let vertices = grid.count() as u32;
        let positions: Vec<[f32; 4]> = grid.positions().map(|[x, y, z]| [x, y, z, 1.0]).collect();
        Ok(Self {
            gpu: gpu.clone(),
            kernel: shader.compile(gpu)?,
            capacity: shader.capacity,
            workgroups: [vertices.div_ceil(LANES), shader.lanes, 1],
            told: gpu.uniform("grid", &Told { spacing: grid.spacing, vertices })?,
            positions: gpu.storage("vertices", &positions)?,
            coefficients,
        })
    }

    /// The coefficients of the lights that were projected last.
    pub fn coefficients(&self) -> &GridCoefficients {
        &self.coefficients
    }

    /// Replaces the coefficients by those of these lights, `records` of the kernel's, and gives the time of each
    /// pass.
    ///
    /// # Errors
    /// Where the adapter refuses a buffer, or the device gave up.
    pub fn project<R: Pod>(&self, records: &[R]) -> Result<Vec<PassTime>, Error> {
        self.gpu.clear(&self.coefficients.buffer)?;
        self.add(records)
    }

    fn add<R: Pod>(&self, records: &[R]) -> Result<Vec<PassTime>, Error> {
        let Self { gpu, capacity, .. } = self;
        let batches = UniformBatches::new(gpu, "lights", records, *capacity, *capacity)?;
        let resources = [
            Resource::Buffer(&self.told),
            Resource::Buffer(&self.positions),
            Resource::Batches(&batches),
            Resource::Buffer(&self.coefficients.buffer),
        ];
        let pass = gpu.pass("project", &self.kernel, &resources)?;
        let of_batch = |index| pass.over_batch(index, self.workgroups);
        gpu.run(&(0..batches.counts().len()).map(of_batch).collect::<Vec<_>>())
    }
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
    let projector = Projector::new(gpu, grid, shader)?;
    let times = projector.project(records)?;
    Ok((projector.coefficients, times))
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
        Projector::onto(gpu, shader, self.clone())?.add(records)
    }
}
