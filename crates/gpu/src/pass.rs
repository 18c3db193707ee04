//! Kernels with what they read and write, and running them by the adapter's clock.

use std::sync::Arc;

use crate::pipeline::Kernel;
use crate::{Buffer, Error, Gpu, UniformBatches};

/// What is bound.
#[derive(Clone, Copy)]
pub enum Resource<'a> {
    /// A whole buffer.
    Buffer(&'a Buffer),
    /// One of many batches, which a [`Dispatch`] chooses: at most one such binding a kernel.
    Batches(&'a UniformBatches),
    #[doc(hidden)]
    Texture(&'a wgpu::TextureView),
}

/// A kernel with what it reads and writes: bound once, run any number of times.
pub struct Pass {
    name: &'static str,
    kernel: Arc<Kernel>,
    group: wgpu::BindGroup,
    /// Bytes from batch to batch, where it reads one.
    stride: Option<u32>,
}

/// One run of a pass, or several that are timed as one.
pub struct Dispatch<'a> {
    pass: &'a Pass,
    /// Offsets of their batches, and workgroups.
    runs: Vec<(Option<u32>, [u32; 3])>,
}

/// The time that a pass took on the adapter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassTime {
    /// What it does: `distribute`, `gather`, …
    pub pass: &'static str,
    /// Seconds between the adapter's timestamps around it. On a software adapter, and where there are
    /// no timestamps: wall clock around its submission. What the host does is by wall clock.
    pub seconds: f64,
}

impl Pass {
    /// Over so many workgroups in x, y, z; of batches, the first.
    pub fn over(&self, workgroups: [u32; 3]) -> Dispatch<'_> {
        self.over_batch(0, workgroups)
    }

    /// The same with the batch of this index.
    pub fn over_batch(&self, index: usize, workgroups: [u32; 3]) -> Dispatch<'_> {
        self.over_batches([(index, workgroups)])
    }

    /// Over batches of these indices, one after the other, each over workgroups of its own.
    pub fn over_batches(
        &self,
        batches: impl IntoIterator<Item = (usize, [u32; 3])>,
    ) -> Dispatch<'_> {
        let offset = |index: usize| self.stride.map(|stride| index as u32 * stride);
        let run = |(index, workgroups)| (offset(index), workgroups);
        Dispatch { pass: self, runs: batches.into_iter().map(run).collect() }
    }
}

impl Gpu {
    /// Binds `resources`, in the order of the kernel's bindings, to a pass of this name.
    ///
    /// # Errors
    /// Where a resource does not fit its binding.
    pub fn pass(
        &self,
        name: &'static str,
        kernel: &Arc<Kernel>,
        resources: &[Resource<'_>],
    ) -> Result<Pass, Error> {
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry {
                binding,
                resource: resource.binding(),
            })
            .collect();
        let group = self.checked(name, || {
            self.device().create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(name),
                layout: &kernel.layout,
                entries: &entries,
            })
        })?;
        let stride = resources.iter().find_map(|resource| match resource {
            Resource::Batches(batches) => Some(batches.stride),
            _ => None,
        });
        Ok(Pass { name, kernel: kernel.clone(), group, stride })
    }

    /// Runs the passes in order, waits for their end and returns the time of each.
    ///
    /// # Errors
    /// Where a pass has more workgroups than allowed or the device was lost.
    pub fn run(&self, dispatches: &[Dispatch<'_>]) -> Result<Vec<PassTime>, Error> {
        let most = self.shared.limits.max_compute_workgroups_per_dimension;
        for Dispatch { pass, runs } in dispatches {
            let needed = runs.iter().flat_map(|(_, workgroups)| *workgroups).fold(0, u32::max);
            let (what, mend) = (format!("the pass `{}`", pass.name), "choose less work");
            self.fits(&what, [needed.into(), most.into()], "workgroups in a row", mend)?;
        }
        let seconds = self.timed(dispatches.len(), |encoder, index, writes| {
            dispatches[index].encode(encoder, writes);
        })?;
        let names = dispatches.iter().map(|dispatch| dispatch.pass.name);
        Ok(names.zip(seconds).map(|(pass, seconds)| PassTime { pass, seconds }).collect())
    }
}

impl Dispatch<'_> {
    fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(self.pass.name),
            timestamp_writes,
        });
        pass.set_pipeline(&self.pass.kernel.pipeline);
        for (offset, [x, y, z]) in &self.runs {
            pass.set_bind_group(0, &self.pass.group, offset.as_slice());
            pass.dispatch_workgroups(*x, *y, *z);
        }
    }
}

impl Resource<'_> {
    pub(crate) fn binding(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Buffer(buffer) => buffer.raw.as_entire_binding(),
            Self::Batches(batches) => wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &batches.buffer.raw,
                offset: 0,
                size: wgpu::BufferSize::new(batches.batch_size),
            }),
            Self::Texture(view) => wgpu::BindingResource::TextureView(view),
        }
    }
}
