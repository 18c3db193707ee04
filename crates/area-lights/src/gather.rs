//! Batches of lights over all pixels, in compute passes.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{Buffer, Error, Gpu, Kernel, Pass, PassTime, PointPass, UniformBatches};

use crate::gather_shader::{GatherShader, LANES};

/// Records of lights in uniform memory, bound to their kernel.
pub struct LightBatches {
    counts: Vec<u32>,
    pass: Pass,
}

impl LightBatches {
    /// Batches in all.
    pub fn count(&self) -> usize {
        self.counts.len()
    }

    /// Records in the first so many batches.
    pub fn records(&self, batches: usize) -> u64 {
        self.counts[..batches].iter().map(|&count| u64::from(count)).sum()
    }
}

/// Records of lights, whatever a kernel wants of them.
pub trait LightRecords {
    /// As [`AreaGather::batches`].
    ///
    /// # Errors
    /// As there.
    fn batches(&self, gather: &AreaGather) -> Result<LightBatches, Error>;
}

impl<R: Pod> LightRecords for Vec<R> {
    fn batches(&self, gather: &AreaGather) -> Result<LightBatches, Error> {
        gather.batches(self)
    }
}

/// As `shaders/gather.wesl` has it.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct View {
    camera: Vec3,
    pixels: u32,
}

/// The pipeline for one scene and the sums so far.
pub struct AreaGather {
    gpu: Gpu,
    pixels: PointPass,
    kernel: Arc<Kernel>,
    capacity: usize,
    workgroups: [u32; 3],
}

impl AreaGather {
    /// For the first `pixels` of `surfaces`, seen from `camera`. `own` are the estimator's settings, where
    /// it has some, and its tables, in the order of its [`PointBindings`](manylights_gpu::PointBindings).
    ///
    /// # Errors
    /// Where the adapter refuses the kernel or a buffer.
    pub fn new(
        gpu: &Gpu,
        (surfaces, pixels): (&Buffer, u32),
        camera: Vec3,
        shader: &GatherShader,
        own: Vec<Buffer>,
    ) -> Result<Self, Error> {
        let view = View { camera, pixels };
        let pixels = PointPass::new(gpu, "gather", (surfaces, pixels), 16, &view, None, own)?;
        let (kernel, workgroups) = (shader.compile(gpu)?, pixels.workgroups(LANES));
        Ok(Self { gpu: gpu.clone(), pixels, kernel, capacity: shader.capacity, workgroups })
    }

    /// Records a batch.
    pub(crate) fn capacity(&self) -> usize {
        self.capacity
    }

    /// The records in uniform memory, each a multiple of 16 bytes.
    ///
    /// # Errors
    /// Where the adapter refuses the buffer.
    pub fn batches<R: Pod>(&self, records: &[R]) -> Result<LightBatches, Error> {
        let records =
            UniformBatches::new(&self.gpu, "lights", records, self.capacity, self.capacity)?;
        let pass = self.pixels.bind(&self.kernel, &records)?;
        Ok(LightBatches { counts: records.counts().to_vec(), pass })
    }

    /// Adds a range of batches to all pixels, in one submission, and waits.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn add(&self, batches: &LightBatches, range: Range<usize>) -> Result<Vec<PassTime>, Error> {
        let dispatch = |index| batches.pass.over_batch(index, self.workgroups);
        self.gpu.run(&range.map(dispatch).collect::<Vec<_>>())
    }

    /// Where the sums are, a `vec4f` a surface: what else reaches the surfaces may be added.
    pub fn results(&self) -> &Buffer {
        self.pixels.results_buffer()
    }

    /// The sums so far, W·m⁻²·sr⁻¹, in the order of the surfaces.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn radiance(&self) -> Result<Vec<[f32; 3]>, Error> {
        let pixels: Vec<[f32; 4]> = self.pixels.results()?;
        Ok(pixels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect())
    }
}
