//! The kernels and what they read.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{Center, Error, Gpu, Reflectances, Shadows, link};
use manylights_virtual_lights::{LightBatches, LightGather, Lights};

use crate::light_record::{GlossyLight, LambertLight};
use crate::{Settings, VirtualSphere};

/// Lights a batch, as `shaders/gather.wesl` declares its array. Work on a light outweighs reading it,
/// so batches are small: with many samples one may take a second.
pub(crate) const CAPACITY: usize = 128;

const PIXELS_A_GROUP: u32 = 64;

/// The WGSL of the kernel for receivers of the given kinds, and lights that are Lambertian or not.
///
/// # Errors
/// Where the shader does not link.
pub fn linked_shader(
    kinds: &Reflectances,
    glossy_lights: bool,
    traced: bool,
    settings: &Settings,
) -> Result<String, Error> {
    let features = [
        ("glossy_receivers", kinds.specular),
        ("glossy_lights", glossy_lights),
        ("brdf_samples", settings.sampling.has_brdf()),
        ("cone_samples", settings.sampling.has_cone()),
        ("traced", traced),
    ];
    let features = [&features[..], &kinds.features()].concat();
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

/// The lights in uniform memory.
///
/// # Errors
/// Where the adapter refuses.
pub(crate) fn batches(
    gather: &LightGather,
    lights: &[VirtualSphere],
    seed: u64,
) -> Result<LightBatches, Error> {
    let indexed = lights.iter().enumerate();
    let (glossy, lambert): (Vec<_>, Vec<_>) =
        indexed.partition(|(_, sphere)| sphere.light.brdf.has_specular());
    let centers = [&lambert, &glossy].map(|lights| {
        lights.iter().map(|(_, sphere)| Center::from(&sphere.light)).collect::<Vec<_>>()
    });
    let lambert: Vec<_> =
        lambert.into_iter().map(|(i, sphere)| LambertLight::new(i, sphere, seed)).collect();
    let glossy: Vec<_> =
        glossy.into_iter().map(|(i, sphere)| GlossyLight::new(i, sphere, seed)).collect();
    gather.batches(
        &Lights { records: &lambert, centers: &centers[0], capacity: CAPACITY },
        &Lights { records: &glossy, centers: &centers[1], capacity: CAPACITY },
    )
}

/// For `pixels` surfaces of the given kinds, seen from `camera`.
///
/// # Errors
/// Where a shader does not link or the adapter refuses.
pub(crate) fn gather(
    gpu: &Gpu,
    pixels: u32,
    camera: Vec3,
    kinds: &Reflectances,
    settings: &Settings,
    shadows: Option<Shadows>,
) -> Result<LightGather, Error> {
    let view = View { camera, pixels, samples: settings.directions, padding: [0; 3] };
    let traced = shadows.is_some();
    let wgsl = [
        linked_shader(kinds, false, traced, settings)?,
        linked_shader(kinds, kinds.specular, traced, settings)?,
    ];
    let wgsl = wgsl.each_ref().map(String::as_str);
    let tables = kinds.tables(gpu)?;
    LightGather::new(gpu, [pixels, PIXELS_A_GROUP], &view, wgsl, tables, shadows)
}
