//! The kernels and what they read.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{Center, Error, Gpu, Reflectances, Shadows, link};
use manylights_virtual_lights::{LightBatches, LightGather, Lights, VirtualLight};

use crate::Settings;
use crate::light_record::{GlossyLight, LambertLight};

/// Lights a batch, as `shaders/gather.wesl` declares its arrays: below 64 KiB each.
pub(crate) const LAMBERT_CAPACITY: usize = 1024;
const GLOSSY_CAPACITY: usize = 480;

/// 64 lanes of four pixels.
const PIXELS_A_GROUP: u32 = 256;

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
        ("clamped", settings.clamp.is_some()),
        ("attenuated", settings.attenuation_radius.is_some()),
        ("traced", traced),
    ];
    let features = [&features[..], &kinds.features()].concat();
    link("gather", include_str!("shaders/gather.wesl"), &[], &features)
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct View {
    camera: Vec3,
    pixels: u32,
    clamp: f32,
    radius2: f32,
    padding: [u32; 2],
}

/// The lights in uniform memory.
///
/// # Errors
/// Where the adapter refuses.
pub(crate) fn batches(
    gather: &LightGather,
    lights: &[VirtualLight],
) -> Result<LightBatches, Error> {
    let (glossy, lambert): (Vec<_>, Vec<_>) =
        lights.iter().partition(|light| light.brdf.has_specular());
    let centers = [&lambert, &glossy]
        .map(|lights| lights.iter().copied().map(Center::from).collect::<Vec<_>>());
    let lambert: Vec<_> = lambert.into_iter().map(LambertLight::new).collect();
    let glossy: Vec<_> = glossy.into_iter().map(GlossyLight::new).collect();
    gather.batches(
        &Lights { records: &lambert, centers: &centers[0], capacity: LAMBERT_CAPACITY },
        &Lights { records: &glossy, centers: &centers[1], capacity: GLOSSY_CAPACITY },
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
    let radius = settings.attenuation_radius.unwrap_or(0.0);
    let view = View {
        camera,
        pixels,
        clamp: settings.clamp.unwrap_or(0.0),
        radius2: radius * radius,
        padding: [0; 2],
    };
    let traced = shadows.is_some();
    let wgsl = [
        linked_shader(kinds, false, traced, settings)?,
        linked_shader(kinds, kinds.specular, traced, settings)?,
    ];
    let wgsl = wgsl.each_ref().map(String::as_str);
    let tables = kinds.tables(gpu)?;
    LightGather::new(gpu, [pixels, PIXELS_A_GROUP], &view, wgsl, tables, shadows)
}
