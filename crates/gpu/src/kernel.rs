//! Compiling kernels and running them by the adapter's clock.

use std::sync::Arc;
use std::time::Instant;

use crate::pipeline::{Binding, Kernel, entry};
use crate::{Buffer, Error, Gpu, UniformBatches};

/// A set of timestamps holds 4096, two a pass.
const PASSES_A_SUBMISSION: usize = 1024;

/// What is bound.
#[derive(Clone, Copy)]
pub enum Resource<'a> {
    /// A whole buffer.
    Buffer(&'a Buffer),
    /// One batch.
    Batch(&'a UniformBatches, usize),
    #[doc(hidden)]
    Texture(&'a wgpu::TextureView),
}

/// One compute pass.
pub struct Dispatch<'a> {
    /// What it does, as timings name it: `distribute`, `gather`, …
    pub pass: &'static str,
    /// Its pipeline.
    pub kernel: &'a Kernel,
    /// In the order of the kernel's bindings.
    pub resources: &'a [Resource<'a>],
    /// Workgroups in x, y, z.
    pub workgroups: [u32; 3],
}

/// The time that a pass took on the adapter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassTime {
    /// [`Dispatch::pass`].
    pub pass: &'static str,
    /// Seconds between the adapter's timestamps around it. On a software adapter, and where there are
    /// no timestamps: wall clock around its submission.
    pub seconds: f64,
}

impl Gpu {
    /// The kernel of a WGSL module with one entry point; compiled once for each text and bindings.
    ///
    /// All methods under comparison get the same run-time checks: those that wgpu turns on.
    ///
    /// # Errors
    /// Where the WGSL or its bindings are invalid.
    pub fn kernel(
        &self,
        label: &str,
        wgsl: &str,
        bindings: &[Binding],
    ) -> Result<Arc<Kernel>, Error> {
        let mut kernels = self.shared.kernels.lock().unwrap_or_else(|poison| poison.into_inner());
        let key = (wgsl.to_owned(), bindings.to_owned());
        if let Some(kernel) = kernels.get(&key) {
            return Ok(kernel.clone());
        }
        let kernel = Arc::new(self.checked(label, || self.compile(label, wgsl, bindings))?);
        kernels.insert(key, kernel.clone());
        Ok(kernel)
    }

    fn compile(&self, label: &str, wgsl: &str, bindings: &[Binding]) -> Kernel {
        let device = self.device();
        let entries: Vec<_> =
            bindings.iter().enumerate().map(|(index, kind)| entry(index as u32, *kind)).collect();
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &entries,
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(label),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            cache: None,
        });
        Kernel { pipeline, layout }
    }

    /// Runs the passes in order, waits for their end and returns the time of each.
    ///
    /// # Errors
    /// Where a binding does not fit or the device was lost.
    pub fn run(&self, dispatches: &[Dispatch<'_>]) -> Result<Vec<PassTime>, Error> {
        let mut times = Vec::with_capacity(dispatches.len());
        for part in dispatches.chunks(PASSES_A_SUBMISSION) {
            let seconds = self.timed(part.len(), |encoder, index, queries| {
                self.encode(encoder, &part[index], queries, index as u32);
            })?;
            let passes = part.iter().map(|dispatch| dispatch.pass);
            times.extend(passes.zip(seconds).map(|(pass, seconds)| PassTime { pass, seconds }));
        }
        Ok(times)
    }

    fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        dispatch: &Dispatch<'_>,
        queries: Option<&wgpu::QuerySet>,
        index: u32,
    ) {
        let entries: Vec<_> = dispatch
            .resources
            .iter()
            .enumerate()
            .map(|(binding, resource)| wgpu::BindGroupEntry {
                binding: binding as u32,
                resource: resource.binding(),
            })
            .collect();
        let group = self.device().create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(dispatch.pass),
            layout: &dispatch.kernel.layout,
            entries: &entries,
        });
        let offsets: Vec<_> =
            dispatch.resources.iter().filter_map(Resource::dynamic_offset).collect();
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(dispatch.pass),
            timestamp_writes: queries.map(|query_set| wgpu::ComputePassTimestampWrites {
                query_set,
                beginning_of_pass_write_index: Some(2 * index),
                end_of_pass_write_index: Some(2 * index + 1),
            }),
        });
        pass.set_pipeline(&dispatch.kernel.pipeline);
        pass.set_bind_group(0, &group, &offsets);
        let [x, y, z] = dispatch.workgroups;
        pass.dispatch_workgroups(x, y, z);
    }

    /// Encodes `passes` passes, submits them, waits, and returns the seconds of each.
    pub(crate) fn timed(
        &self,
        passes: usize,
        encode: impl Fn(&mut wgpu::CommandEncoder, usize, Option<&wgpu::QuerySet>),
    ) -> Result<Vec<f64>, Error> {
        if self.shared.timestamps {
            return self.timed_by_adapter(passes, encode);
        }
        (0..passes)
            .map(|index| {
                let mut encoder = self.device().create_command_encoder(&Default::default());
                self.checked("pass", || encode(&mut encoder, index, None))?;
                let start = Instant::now();
                self.checked("pass", || self.shared.queue.submit([encoder.finish()]))?;
                self.wait()?;
                Ok(start.elapsed().as_secs_f64())
            })
            .collect()
    }

    fn timed_by_adapter(
        &self,
        passes: usize,
        encode: impl Fn(&mut wgpu::CommandEncoder, usize, Option<&wgpu::QuerySet>),
    ) -> Result<Vec<f64>, Error> {
        let device = self.device();
        let count = 2 * passes as u32;
        let size = u64::from(count) * 8;
        let staging = self.checked("passes", || {
            let queries = device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count,
            });
            let mut encoder = device.create_command_encoder(&Default::default());
            for index in 0..passes {
                encode(&mut encoder, index, Some(&queries));
            }
            let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
            let resolved = self.scratch("timestamps", size, usage);
            let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
            let staging = self.scratch("timestamps", size, usage);
            encoder.resolve_query_set(&queries, 0..count, &resolved, 0);
            encoder.copy_buffer_to_buffer(&resolved, 0, &staging, 0, size);
            self.shared.queue.submit([encoder.finish()]);
            staging
        })?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&self.mapped(&staging)?);
        let period = f64::from(self.shared.queue.get_timestamp_period()) * 1e-9;
        let seconds = |pair: &[u64]| pair[1].saturating_sub(pair[0]) as f64 * period;
        Ok(ticks.chunks_exact(2).map(seconds).collect())
    }

    fn scratch(&self, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage,
            mapped_at_creation: false,
        })
    }
}

impl Resource<'_> {
    pub(crate) fn binding(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Buffer(buffer) => buffer.raw.as_entire_binding(),
            Self::Batch(batches, _) => wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &batches.buffer.raw,
                offset: 0,
                size: wgpu::BufferSize::new(batches.batch_size),
            }),
            Self::Texture(view) => wgpu::BindingResource::TextureView(view),
        }
    }

    fn dynamic_offset(&self) -> Option<u32> {
        match self {
            Self::Batch(batches, index) => Some(*index as u32 * batches.stride),
            _ => None,
        }
    }
}
