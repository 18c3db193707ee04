//! Kernels and what they bind.

/// The kind of a binding of group 0, in the order of their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binding {
    /// `var<storage, read>`.
    Storage,
    /// `var<storage, read_write>`.
    StorageMut,
    /// `var<uniform>`.
    Uniform,
    /// `var<uniform>` behind a dynamic offset: one of [`UniformBatches`](crate::UniformBatches).
    Batch,
    /// `texture_2d<u32>`.
    TextureUint,
}

/// A compute pipeline with its one bind group layout.
pub struct Kernel {
    pub(crate) pipeline: wgpu::ComputePipeline,
    pub(crate) layout: wgpu::BindGroupLayout,
}

/// The layout of a binding.
pub(crate) fn entry(binding: u32, kind: Binding) -> wgpu::BindGroupLayoutEntry {
    let buffer = |ty, has_dynamic_offset| wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset,
        min_binding_size: None,
    };
    let ty = match kind {
        Binding::Storage => buffer(wgpu::BufferBindingType::Storage { read_only: true }, false),
        Binding::StorageMut => buffer(wgpu::BufferBindingType::Storage { read_only: false }, false),
        Binding::Uniform => buffer(wgpu::BufferBindingType::Uniform, false),
        Binding::Batch => buffer(wgpu::BufferBindingType::Uniform, true),
        Binding::TextureUint => wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Uint,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
    };
    let visibility = wgpu::ShaderStages::COMPUTE;
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}
