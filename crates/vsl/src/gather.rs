//! The gather: batches of lights over all pixels, in compute passes.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{
    Binding, Buffer, Dispatch, Error, Gpu, Kernel, PassTime, Resource, UniformBatches, link,
};

use crate::Settings;
use crate::light_record::{GlossyLight, LambertLight, SphericalLight};

/// Lights a batch, as `shaders/gather.wesl` declares its array. Work on a light outweighs reading it,
/// so batches are small: with many samples one may take a second.
pub(crate) const CAPACITY: usize = 128;

const PIXELS_A_GROUP: u32 = 64;

/// The WGSL of the kernel for receivers and lights of the given lobes.
///
/// # Errors
/// Where the shader does not link.
pub fn linked_shader(
    glossy_receivers: bool,
    glossy_lights: bool,
    settings: &Settings,
) -> Result<String, Error> {
    let features = [
        ("glossy_receivers", glossy_receivers),
        ("glossy_lights", glossy_lights),
        ("brdf_samples", settings.sampling.has_brdf()),
        ("cone_samples", settings.sampling.has_cone()),
    ];
    let modules = [
        ("pair", include_str!("shaders/pair.wesl")),
        ("sampling", include_str!("shaders/sampling.wesl")),
    ];
    link("gather", include_str!("shaders/gather.wesl"), &modules, &features)
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct View {
    camera: Vec3,
    pixels: u32,
    samples: u32,
    padding: [u32; 3],
}

/// The pipelines for one scene and the sums so far.
pub(crate) struct Gather {
    gpu: Gpu,
    view: Buffer,
    radiance: Buffer,
    pixels: u32,
    from_lambert: Arc<Kernel>,
    /// For lights on glossy surfaces; the Lambertian kernel again where the scene has none.
    from_glossy: Arc<Kernel>,
}

/// Virtual lights in uniform memory, those on Lambertian surfaces first.
pub(crate) struct Batches {
    lambert: UniformBatches,
    glossy: UniformBatches,
}

impl Batches {
    pub(crate) fn new(gpu: &Gpu, lights: &[SphericalLight], seed: u64) -> Result<Self, Error> {
        let indexed = lights.iter().enumerate();
        let (glossy, lambert): (Vec<_>, Vec<_>) =
            indexed.partition(|(_, sphere)| sphere.light.brdf.has_specular());
        let lambert: Vec<_> =
            lambert.into_iter().map(|(i, sphere)| LambertLight::new(i, sphere, seed)).collect();
        let glossy: Vec<_> =
            glossy.into_iter().map(|(i, sphere)| GlossyLight::new(i, sphere, seed)).collect();
        Ok(Self {
            lambert: UniformBatches::new(gpu, "lambert lights", &lambert, CAPACITY)?,
            glossy: UniformBatches::new(gpu, "glossy lights", &glossy, CAPACITY)?,
        })
    }

    /// Batches in all.
    pub(crate) fn len(&self) -> usize {
        self.lambert.counts().len() + self.glossy.counts().len()
    }

    /// Lights in a range of batches.
    pub(crate) fn lights(&self, range: Range<usize>) -> u64 {
        let counts = self.lambert.counts().iter().chain(self.glossy.counts());
        counts.skip(range.start).take(range.len()).map(|&count| u64::from(count)).sum()
    }
}

impl Gather {
    /// For `pixels` surfaces seen from `camera`; without `specular` no kernel knows GGX.
    pub(crate) fn new(
        gpu: &Gpu,
        pixels: u32,
        camera: Vec3,
        specular: bool,
        settings: &Settings,
    ) -> Result<Self, Error> {
        let view = View { camera, pixels, samples: settings.samples, padding: [0; 3] };
        let kernel = |glossy_lights| {
            let wgsl = linked_shader(specular, glossy_lights, settings)?;
            let bindings =
                [Binding::Uniform, Binding::Storage, Binding::Batch, Binding::StorageMut];
            gpu.kernel("gather", &wgsl, &bindings)
        };
        Ok(Self {
            gpu: gpu.clone(),
            view: gpu.uniform("view", &view)?,
            radiance: gpu.zeroed("radiance", u64::from(pixels) * 16)?,
            pixels,
            from_lambert: kernel(false)?,
            from_glossy: kernel(specular)?,
        })
    }

    /// Adds a range of batches to all pixels and waits.
    pub(crate) fn add(
        &self,
        surfaces: &Buffer,
        batches: &Batches,
        range: Range<usize>,
    ) -> Result<Vec<PassTime>, Error> {
        let lambert = batches.lambert.counts().len();
        let chosen: Vec<_> = range
            .filter(|&index| batches.lights(index..index + 1) > 0)
            .map(|index| match index.checked_sub(lambert) {
                None => (&self.from_lambert, Resource::Batch(&batches.lambert, index)),
                Some(index) => (&self.from_glossy, Resource::Batch(&batches.glossy, index)),
            })
            .map(|(kernel, batch)| {
                let [view, surfaces, radiance] =
                    [&self.view, surfaces, &self.radiance].map(Resource::Buffer);
                (kernel, [view, surfaces, batch, radiance])
            })
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

    fn workgroups(&self) -> [u32; 3] {
        let groups = self.pixels.div_ceil(PIXELS_A_GROUP);
        // Rows of at most 2¹⁵ groups: adapters guarantee 65 535 in each direction.
        let columns = groups.min(1 << 15);
        [columns, groups.div_ceil(columns), 1]
    }

    /// The sums so far, W·m⁻²·sr⁻¹.
    pub(crate) fn radiance(&self) -> Result<Vec<[f32; 3]>, Error> {
        let pixels: Vec<[f32; 4]> = self.gpu.read(&self.radiance)?;
        Ok(pixels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect())
    }
}
