//! The gather that many-light methods share: batches of lights over all pixels, in compute passes.
//!
//! What a light contributes to a pixel is the method's kernel; how lights lie in memory, how work is
//! cut and how sums are read back is the same for all.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::Pod;

use crate::{Binding, Buffer, Dispatch, Error, Gpu, Kernel, PassTime, Resource, UniformBatches};

/// Virtual lights in uniform memory, those on Lambertian surfaces first.
pub struct LightBatches {
    lambert: UniformBatches,
    glossy: UniformBatches,
}

impl LightBatches {
    /// Lays out the records, so many of each kind a batch.
    ///
    /// # Errors
    /// Where the adapter refuses the buffers.
    pub fn new<L: Pod, G: Pod>(
        gpu: &Gpu,
        (lambert, lambert_capacity): (&[L], usize),
        (glossy, glossy_capacity): (&[G], usize),
    ) -> Result<Self, Error> {
        Ok(Self {
            lambert: UniformBatches::new(gpu, "lambert lights", lambert, lambert_capacity)?,
            glossy: UniformBatches::new(gpu, "glossy lights", glossy, glossy_capacity)?,
        })
    }

    /// Batches in all.
    pub fn count(&self) -> usize {
        self.lambert.counts().len() + self.glossy.counts().len()
    }

    /// Lights in a range of batches.
    pub fn lights(&self, range: Range<usize>) -> u64 {
        let counts = self.lambert.counts().iter().chain(self.glossy.counts());
        counts.skip(range.start).take(range.len()).map(|&count| u64::from(count)).sum()
    }
}

/// The pipelines for one scene and the sums so far.
pub struct LightGather {
    gpu: Gpu,
    view: Buffer,
    radiance: Buffer,
    tables: Vec<Buffer>,
    pixels: u32,
    pixels_a_group: u32,
    from_lambert: Arc<Kernel>,
    /// For lights on glossy surfaces; the Lambertian kernel again where the scene has none.
    from_glossy: Arc<Kernel>,
}

impl LightGather {
    /// For `pixels` surfaces, `pixels_a_group` a workgroup. `view` is what the kernels are told beside
    /// surfaces and lights; `wgsl` are those for lights on Lambertian and on glossy surfaces, with the
    /// bindings 0 view, 1 surfaces, 2 batch of lights, 3 radiance, 5 … `tables`, in storage.
    ///
    /// # Errors
    /// Where the adapter refuses a kernel or a buffer.
    pub fn new(
        gpu: &Gpu,
        [pixels, pixels_a_group]: [u32; 2],
        view: &impl Pod,
        [lambert, glossy]: [&str; 2],
        tables: Vec<Buffer>,
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
            pixels,
            pixels_a_group,
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
        let lambert = batches.lambert.counts().len();
        let chosen: Vec<_> = range
            .filter(|&index| batches.lights(index..index + 1) > 0)
            .map(|index| match index.checked_sub(lambert) {
                None => (&self.from_lambert, Resource::Batch(&batches.lambert, index)),
                Some(index) => (&self.from_glossy, Resource::Batch(&batches.glossy, index)),
            })
            .map(|(kernel, batch)| (kernel, self.resources(surfaces, batch)))
            .collect();
        let dispatches: Vec<_> = chosen
            .iter()
            .map(|(kernel, resources)| Dispatch {
                pass: "gather",
                kernel,
                resources,
                workgroups: self.workgroups(),
            })
            .collect();
        self.gpu.run(&dispatches)
    }

    fn resources<'a>(&'a self, surfaces: &'a Buffer, batch: Resource<'a>) -> Vec<Resource<'a>> {
        let [view, surfaces, radiance] =
            [&self.view, surfaces, &self.radiance].map(Resource::Buffer);
        // Binding 4 is reserved: any buffer will do.
        let mut resources = vec![view, surfaces, batch, radiance, surfaces];
        resources.extend(self.tables.iter().map(Resource::Buffer));
        resources
    }

    fn workgroups(&self) -> [u32; 3] {
        let groups = self.pixels.div_ceil(self.pixels_a_group);
        // Rows of at most 2¹⁵ groups: adapters guarantee 65 535 in each direction.
        let columns = groups.min(1 << 15);
        [columns, groups.div_ceil(columns), 1]
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
