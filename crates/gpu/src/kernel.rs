//! Compiling kernels.

use std::sync::Arc;

use crate::pipeline::{Binding, Kernel, entry};
use crate::{Error, Gpu};

impl Gpu {
    /// The kernel of a WGSL module with one entry point; compiled once for each text and bindings.
    ///
    /// All methods under comparison get the same run-time checks: those that wgpu turns on.
    ///
    /// # Errors
    /// Where the WGSL or its bindings are invalid, or it binds more storage buffers than allowed.
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
        let storage =
            |binding: &&Binding| matches!(binding, Binding::Storage | Binding::StorageMut);
        let storage = bindings.iter().filter(storage).count() as u64;
        let most = self.shared.limits.max_storage_buffers_per_shader_stage.into();
        let what = format!("the kernel `{label}`");
        self.fits(&what, [storage, most], "storage buffers", "bring tables together")?;
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
}
