//! Rasterising the scene through a [`Projection`] into surfaces.

use crate::scene_buffers::SceneBuffers;
use crate::surface::SurfaceRecord;
use crate::{Binding, Buffer, Error, Gpu, PassTime, Projection, Resource, link};

/// The surfaces that a projection sees: a storage buffer of `array<Surface>`, row-major.
///
/// # Errors
/// Where the map is larger than the adapter allows.
pub(crate) fn rasterise(
    gpu: &Gpu,
    scene: &SceneBuffers,
    projection: &Projection,
) -> Result<(Buffer, Vec<PassTime>), Error> {
    let [width, height] = projection.resolution;
    let largest = gpu.shared.limits.max_texture_dimension_2d.into();
    let mend = "choose a lower resolution or fewer lights";
    let what = format!("a map of {width}x{height}");
    gpu.fits(&what, [width.max(height).into(), largest], "texels a side", mend)?;
    let texels = u64::from(width) * u64::from(height);
    let surfaces = gpu.zeroed("G-buffer", texels * size_of::<SurfaceRecord>() as u64)?;
    let uniform = gpu.uniform("projection", projection)?;
    let numbers = texture(gpu, projection, wgpu::TextureFormat::R32Uint);
    let numbers = numbers.create_view(&Default::default());
    let mut times = draw(gpu, scene, projection, &uniform, &numbers)?;
    let wgsl = link("resolve", include_str!("shaders/resolve.wesl"), &[], &[])?;
    let mut bindings = vec![Binding::Uniform];
    bindings.extend([Binding::Storage; 5]);
    bindings.extend([Binding::TextureUint, Binding::StorageMut]);
    let kernel = gpu.kernel("resolve", &wgsl, &bindings)?;
    let pass = gpu.pass(
        "resolve surfaces",
        &kernel,
        &[
            Resource::Buffer(&uniform),
            Resource::Buffer(&scene.vertices),
            Resource::Buffer(&scene.triangles),
            Resource::Buffer(&scene.materials),
            Resource::Buffer(&scene.textures),
            Resource::Buffer(&scene.texels),
            Resource::Texture(&numbers),
            Resource::Buffer(&surfaces),
        ],
    )?;
    times.extend(gpu.run(&[pass.over([width.div_ceil(64), height, 1])])?);
    Ok((surfaces, times))
}

fn draw(
    gpu: &Gpu,
    scene: &SceneBuffers,
    projection: &Projection,
    uniform: &Buffer,
    numbers: &wgpu::TextureView,
) -> Result<Vec<PassTime>, Error> {
    let pipeline = gpu.visibility_pipeline()?;
    let depth = texture(gpu, projection, wgpu::TextureFormat::Depth32Float);
    let depth = depth.create_view(&Default::default());
    let resources = [uniform, &scene.vertices, &scene.triangles].map(Resource::Buffer);
    let entries: Vec<_> = (0..)
        .zip(&resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.binding() })
        .collect();
    let group = gpu.checked("visibility", || {
        gpu.device().create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("visibility"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        })
    })?;
    let seconds = gpu.timed(1, |encoder, _, timestamps| {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("visibility"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: numbers,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    // NO_TRIANGLE: integer targets take the clear colour's integral value.
                    load: wgpu::LoadOp::Clear(wgpu::Color {
                        r: f64::from(u32::MAX),
                        ..wgpu::Color::BLACK
                    }),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: timestamps.map(|writes| wgpu::RenderPassTimestampWrites {
                query_set: writes.query_set,
                beginning_of_pass_write_index: writes.beginning_of_pass_write_index,
                end_of_pass_write_index: writes.end_of_pass_write_index,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3 * scene.triangle_count, 0..1);
    })?;
    Ok(vec![PassTime { pass: "rasterise", seconds: seconds[0] }])
}

fn texture(gpu: &Gpu, projection: &Projection, format: wgpu::TextureFormat) -> wgpu::Texture {
    let [width, height] = projection.resolution;
    gpu.device().create_texture(&wgpu::TextureDescriptor {
        label: Some("map"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}

impl Gpu {
    fn visibility_pipeline(&self) -> Result<wgpu::RenderPipeline, Error> {
        if let Some(pipeline) = self.shared.visibility.get() {
            return Ok(pipeline.clone());
        }
        let wgsl = link("visibility", include_str!("shaders/visibility.wesl"), &[], &[])?;
        let pipeline = self.checked("visibility", || self.create_visibility_pipeline(&wgsl))?;
        Ok(self.shared.visibility.get_or_init(|| pipeline).clone())
    }

    fn create_visibility_pipeline(&self, wgsl: &str) -> wgpu::RenderPipeline {
        let module = self.device().create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("visibility"),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        self.device().create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("visibility"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("corner"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            // Surfaces are two-sided: nothing is culled.
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: wgpu::TextureFormat::Depth32Float,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("number"),
                compilation_options: Default::default(),
                targets: &[Some(wgpu::TextureFormat::R32Uint.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}
