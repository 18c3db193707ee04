//! Passes with a lane or several for each point: the pixels of a picture, or any records in a buffer.

use std::sync::Arc;

use bytemuck::Pod;

use crate::pipeline::Kernel;
use crate::{Buffer, Error, Gpu, Pass, Resource, UniformBatches};

/// Workgroups of so many points, in rows of at most 2¹⁵: adapters guarantee 65 535 in each direction.
pub fn workgroups(points: u32, points_a_group: u32) -> [u32; 3] {
    let groups = points.div_ceil(points_a_group);
    let columns = groups.min(1 << 15);
    [columns, groups.div_ceil(columns), 1]
}

/// Points, and what the kernels of a family are given there: each adds what a batch of records sends
/// to every point to that point's result.
///
/// Kernels bind 0 a uniform that all points are told, 1 the points, 2 a batch of
/// [`UniformBatches`], 3 the results, then what [`PointBindings`](crate::PointBindings) numbers.
pub struct PointPass {
    gpu: Gpu,
    name: &'static str,
    count: u32,
    points: Buffer,
    results: Buffer,
    uniform: Buffer,
    occluded: Buffer,
    own: Vec<Buffer>,
}

impl PointPass {
    /// The first `count` records of `points`, of any type, with results of `stride` bytes each, which
    /// start as zeros. `occluded` has the bits that `package::visible` reads, where a kernel does; `own`
    /// are the estimator's settings, where it has some, and its tables.
    ///
    /// # Errors
    /// Where the adapter refuses a buffer.
    pub fn new(
        gpu: &Gpu,
        name: &'static str,
        (points, count): (&Buffer, u32),
        stride: u32,
        uniform: &impl Pod,
        occluded: Option<&Buffer>,
        own: Vec<Buffer>,
    ) -> Result<Self, Error> {
        Ok(Self {
            gpu: gpu.clone(),
            name,
            count,
            points: points.clone(),
            results: gpu.zeroed(name, u64::from(count) * u64::from(stride))?,
            uniform: gpu.uniform(name, uniform)?,
            // Where no kernel reads which records are occluded, any buffer will do.
            occluded: occluded.unwrap_or(points).clone(),
            own,
        })
    }

    /// Binds a kernel to batches; a pass runs with any of them, over [`PointPass::workgroups`].
    ///
    /// # Errors
    /// Where the kernel binds something else.
    pub fn bind(&self, kernel: &Arc<Kernel>, batches: &UniformBatches) -> Result<Pass, Error> {
        let [uniform, points, results, occluded] =
            [&self.uniform, &self.points, &self.results, &self.occluded].map(Resource::Buffer);
        let mut resources = vec![uniform, points, Resource::Batches(batches), results, occluded];
        resources.extend(self.own.iter().map(Resource::Buffer));
        self.gpu.pass(self.name, kernel, &resources)
    }

    /// That cover all points.
    pub fn workgroups(&self, points_a_group: u32) -> [u32; 3] {
        workgroups(self.count, points_a_group)
    }

    /// Where the results are, for passes of another kind.
    pub fn results_buffer(&self) -> &Buffer {
        &self.results
    }

    /// The results so far, in the order of the points.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn results<T: Pod>(&self) -> Result<Vec<T>, Error> {
        self.gpu.read(&self.results)
    }
}
