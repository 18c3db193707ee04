//! The gather that many-light methods share: batches of lights over all pixels, in compute passes.
//!
//! What a light contributes to a pixel is the estimator's module; how lights lie in memory, how work is
//! cut, which lights a pixel sees and how sums are read back is the same for all.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{
    Buffer, Center, Dispatch, Error, Gpu, Kernel, Pass, PassTime, PointPass, Shadows,
    UniformBatches,
};

use crate::gather_shader::GatherShader;

/// Lights of one kind, in order.
pub struct Lights<'a, T> {
    /// As the estimator's `Light` reads them.
    pub records: &'a [T],
    /// Of each; read where shadows are traced.
    pub centers: &'a [Center],
}

/// Virtual lights in uniform memory, bound to their kernels; those on Lambertian surfaces first, and
/// no kind that has none.
pub struct LightBatches(Vec<Batches>);

struct Batches {
    counts: Vec<u32>,
    gather: Pass,
    workgroups: [u32; 3],
    shadow: Option<Pass>,
}

impl LightBatches {
    /// Batches in all.
    pub fn count(&self) -> usize {
        self.0.iter().map(|batches| batches.counts.len()).sum()
    }

    /// Lights in a range of batches.
    pub fn lights(&self, range: Range<usize>) -> u64 {
        let counts = self.0.iter().flat_map(|batches| &batches.counts);
        counts.skip(range.start).take(range.len()).map(|&count| u64::from(count)).sum()
    }

    /// Each batch: its kind and its place among those of the kind.
    fn places(&self) -> impl Iterator<Item = (&Batches, usize)> {
        self.0.iter().flat_map(|batches| (0..batches.counts.len()).map(move |i| (batches, i)))
    }
}

/// As `shaders/gather.wesl` has it.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct View {
    camera: Vec3,
    pixels: u32,
}

/// The pipelines for one scene and the sums so far.
pub struct LightGather {
    gpu: Gpu,
    pixels: PointPass,
    shadows: Option<Shadows>,
    /// For lights on Lambertian and on glossy surfaces; the same where the scene has no specular lobe.
    kernels: [GatherKernel; 2],
}

struct GatherKernel {
    kernel: Arc<Kernel>,
    capacity: usize,
    workgroups: [u32; 3],
}

impl LightGather {
    /// For the first `pixels` of `surfaces`, seen from `camera`. `shaders` are those for lights on
    /// Lambertian and on glossy surfaces; `own` are the estimator's settings, where it has some, and its
    /// tables, in the order of its [`PointBindings`](manylights_gpu::PointBindings).
    ///
    /// # Errors
    /// Where the adapter refuses a kernel or a buffer.
    pub fn new(
        gpu: &Gpu,
        (surfaces, pixels): (&Buffer, u32),
        camera: Vec3,
        shaders: [GatherShader; 2],
        own: Vec<Buffer>,
        shadows: Option<Shadows>,
    ) -> Result<Self, Error> {
        let (occluded, view) = (shadows.as_ref().map(Shadows::occluded), View { camera, pixels });
        let pixels = PointPass::new(gpu, "gather", (surfaces, pixels), 16, &view, occluded, own)?;
        let kernel = |shader: &GatherShader| {
            let workgroups = pixels.workgroups(shader.pixels_a_group);
            let kernel = shader.compile(gpu)?;
            Ok::<_, Error>(GatherKernel { kernel, capacity: shader.capacity, workgroups })
        };
        let [lambert, glossy] = &shaders;
        let kernels = [kernel(lambert)?, kernel(glossy)?];
        Ok(Self { gpu: gpu.clone(), pixels, shadows, kernels })
    }

    /// Most batches of a submission that casts shadow rays.
    pub fn traced_batches(&self) -> Option<usize> {
        self.shadows.as_ref().map(Shadows::batches_a_submission)
    }

    /// The lights in uniform memory.
    ///
    /// # Errors
    /// Where the adapter refuses the buffers.
    pub fn batches<L: Pod, G: Pod>(
        &self,
        lambert: &Lights<'_, L>,
        glossy: &Lights<'_, G>,
    ) -> Result<LightBatches, Error> {
        let [from_lambert, from_glossy] = &self.kernels;
        let lambert = self.of_kind("lambert lights", lambert, from_lambert)?;
        let glossy = self.of_kind("glossy lights", glossy, from_glossy)?;
        Ok(LightBatches(lambert.into_iter().chain(glossy).collect()))
    }

    fn of_kind<T: Pod>(
        &self,
        label: &str,
        lights: &Lights<'_, T>,
        kernel: &GatherKernel,
    ) -> Result<Option<Batches>, Error> {
        if lights.records.is_empty() {
            return Ok(None);
        }
        let GatherKernel { ref kernel, capacity, workgroups } = *kernel;
        let bits = self.shadows.as_ref().map_or(capacity, Shadows::lights_a_batch);
        let most = capacity.min(bits);
        let records = UniformBatches::new(&self.gpu, label, lights.records, capacity, most)?;
        let shadow = |shadows: &Shadows| {
            let (label, capacity) = ("centres of lights", Shadows::CAPACITY);
            shadows.pass(&UniformBatches::new(&self.gpu, label, lights.centers, capacity, most)?)
        };
        Ok(Some(Batches {
            counts: records.counts().to_vec(),
            gather: self.pixels.bind(kernel, &records)?,
            workgroups,
            shadow: self.shadows.as_ref().map(shadow).transpose()?,
        }))
    }

    /// Adds a range of batches to all pixels and waits.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn add(&self, batches: &LightBatches, range: Range<usize>) -> Result<Vec<PassTime>, Error> {
        let mut dispatches = Vec::new();
        for (batches, index) in batches.places().skip(range.start).take(range.len()) {
            dispatches.extend(self.shadow(batches, index));
            dispatches.push(batches.gather.over_batch(index, batches.workgroups));
        }
        self.gpu.run(&dispatches)
    }

    fn shadow<'a>(&self, batches: &'a Batches, index: usize) -> Option<Dispatch<'a>> {
        let (shadows, pass) = self.shadows.as_ref().zip(batches.shadow.as_ref())?;
        Some(shadows.dispatch(pass, index))
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
