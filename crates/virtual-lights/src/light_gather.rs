//! The gather that many-light methods share: batches of lights over all pixels, in compute passes.
//!
//! What a light contributes to a pixel is the method's kernel; how lights lie in memory, how work is
//! cut, which lights a pixel sees and how sums are read back is the same for all.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::Pod;
use manylights_gpu::{
    Binding, Buffer, Center, Dispatch, Error, Gpu, Kernel, PassTime, Resource, Shadows,
    UniformBatches, workgroups,
};

/// Lights of one kind, in order.
pub struct Lights<'a, T> {
    /// As the method's kernel reads them.
    pub records: &'a [T],
    /// Of each; read where shadows are traced.
    pub centers: &'a [Center],
    /// Of the array that the kernel declares.
    pub capacity: usize,
}

/// Virtual lights in uniform memory, those on Lambertian surfaces first.
pub struct LightBatches {
    lambert: Batches,
    glossy: Batches,
}

struct Batches {
    records: UniformBatches,
    /// In the same batches.
    centers: Option<UniformBatches>,
}

impl Batches {
    fn new<T: Pod>(
        gpu: &Gpu,
        label: &str,
        lights: &Lights<'_, T>,
        shadows: Option<&Shadows>,
    ) -> Result<Self, Error> {
        let Lights { records, centers, capacity } = *lights;
        let most = shadows.map_or(capacity, |shadows| shadows.lights_a_batch().min(capacity));
        let centers = shadows.map(|_| {
            UniformBatches::new(gpu, "centres of lights", centers, Shadows::CAPACITY, most)
        });
        Ok(Self {
            records: UniformBatches::new(gpu, label, records, capacity, most)?,
            centers: centers.transpose()?,
        })
    }
}

impl LightBatches {
    /// Batches in all.
    pub fn count(&self) -> usize {
        self.lambert.records.counts().len() + self.glossy.records.counts().len()
    }

    /// Lights in a range of batches.
    pub fn lights(&self, range: Range<usize>) -> u64 {
        let counts = self.lambert.records.counts().iter().chain(self.glossy.records.counts());
        counts.skip(range.start).take(range.len()).map(|&count| u64::from(count)).sum()
    }
}

/// The pipelines for one scene and the sums so far.
pub struct LightGather {
    gpu: Gpu,
    view: Buffer,
    radiance: Buffer,
    tables: Vec<Buffer>,
    shadows: Option<Shadows>,
    pixels: u32,
    pixels_a_group: u32,
    from_lambert: Arc<Kernel>,
    /// For lights on glossy surfaces; the Lambertian kernel again where the scene has none.
    from_glossy: Arc<Kernel>,
}

impl LightGather {
    /// For `pixels` surfaces, `pixels_a_group` a workgroup. `view` is what the kernels are told beside
    /// surfaces and lights; `wgsl` are those for lights on Lambertian and on glossy surfaces, with the
    /// bindings 0 view, 1 surfaces, 2 batch of lights, 3 radiance, 4 hidden lights (see
    /// `shaders/visible.wesl`; read only where there are `shadows`), 5 … `tables`, in storage.
    ///
    /// # Errors
    /// Where the adapter refuses a kernel or a buffer.
    pub fn new(
        gpu: &Gpu,
        [pixels, pixels_a_group]: [u32; 2],
        view: &impl Pod,
        [lambert, glossy]: [&str; 2],
        tables: Vec<Buffer>,
        shadows: Option<Shadows>,
    ) -> Result<Self, Error> {
        let mut bindings =
            vec![Binding::Uniform, Binding::Storage, Binding::Batch, Binding::StorageMut];
        bindings.resize(5 + tables.len(), Binding::Storage);
        let kernel = |wgsl| gpu.kernel("gather", wgsl, &bindings);
        Ok(Self {
            gpu: gpu.clone(),
            view: gpu.uniform("view", view)?,
            radiance: gpu.zeroed("radiance", u64::from(pixels) * 16)?,
            from_lambert: kernel(lambert)?,
            from_glossy: kernel(glossy)?,
            tables,
            shadows,
            pixels,
            pixels_a_group,
        })
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
        let shadows = self.shadows.as_ref();
        Ok(LightBatches {
            lambert: Batches::new(&self.gpu, "lambert lights", lambert, shadows)?,
            glossy: Batches::new(&self.gpu, "glossy lights", glossy, shadows)?,
        })
    }

    /// Adds a range of batches to all pixels and waits.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn add(
        &self,
        surfaces: &Buffer,
        batches: &LightBatches,
        range: Range<usize>,
    ) -> Result<Vec<PassTime>, Error> {
        let lambert = batches.lambert.records.counts().len();
        let chosen: Vec<_> = range
            .filter(|&index| batches.lights(index..index + 1) > 0)
            .map(|index| match index.checked_sub(lambert) {
                None => (&self.from_lambert, &batches.lambert, index),
                Some(index) => (&self.from_glossy, &batches.glossy, index),
            })
            .map(|(kernel, batches, index)| {
                let shadows = self.shadows.as_ref().zip(batches.centers.as_ref());
                let shadows = shadows.map(|(shadows, centers)| {
                    (shadows, shadows.resources(surfaces, Resource::Batch(centers, index)))
                });
                (
                    shadows,
                    kernel,
                    self.resources(surfaces, Resource::Batch(&batches.records, index)),
                )
            })
            .collect();
        let mut dispatches = Vec::new();
        for (shadows, kernel, resources) in &chosen {
            dispatches.extend(shadows.as_ref().map(|(shadows, bound)| shadows.dispatch(bound)));
            let workgroups = workgroups(self.pixels, self.pixels_a_group);
            dispatches.push(Dispatch { pass: "gather", kernel, resources, workgroups });
        }
        self.gpu.run(&dispatches)
    }

    fn resources<'a>(&'a self, surfaces: &'a Buffer, batch: Resource<'a>) -> Vec<Resource<'a>> {
        // Where nothing reads which lights are hidden, any buffer will do.
        let hidden = self.shadows.as_ref().map_or(surfaces, Shadows::hidden);
        let [view, surfaces, radiance, hidden] =
            [&self.view, surfaces, &self.radiance, hidden].map(Resource::Buffer);
        let mut resources = vec![view, surfaces, batch, radiance, hidden];
        resources.extend(self.tables.iter().map(Resource::Buffer));
        resources
    }

    /// The sums so far, W·m⁻²·sr⁻¹, in the order of the surfaces.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn radiance(&self) -> Result<Vec<[f32; 3]>, Error> {
        let pixels: Vec<[f32; 4]> = self.gpu.read(&self.radiance)?;
        Ok(pixels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect())
    }
}
