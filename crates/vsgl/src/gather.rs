//! The kernels and what they read.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{Center, Error, Gpu, Reflectances, Shadows, link};
use manylights_virtual_lights::{LightBatches, LightGather, Lights};

use crate::light_record::{GlossyLight, LambertLight};
use crate::{GaussianLight, Settings, SpecularLobe};

/// Lights a batch, as `shaders/gather.wesl` declares its arrays: below 32 KiB each.
pub(crate) const LAMBERT_CAPACITY: usize = 512;
const GLOSSY_CAPACITY: usize = 256;

const PIXELS_A_GROUP: u32 = 64;

/// The WGSL of the kernel for receivers of the given reflectances and lights with or without a
/// specular lobe.
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
        ("filtered", settings.lobe == SpecularLobe::Filtered),
        ("traced", traced),
    ];
    let features = [&features[..], &kinds.features()].concat();
    let modules = [
        ("gaussian", include_str!("shaders/gaussian.wesl")),
        ("reflection", include_str!("shaders/reflection.wesl")),
    ];
    link("gather", include_str!("shaders/gather.wesl"), &modules, &features)
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct View {
    camera: Vec3,
    pixels: u32,
}

/// The lights in uniform memory.
///
/// # Errors
/// Where the adapter refuses.
pub(crate) fn batches(
    gather: &LightGather,
    lights: &[GaussianLight],
) -> Result<LightBatches, Error> {
    let (glossy, lambert): (Vec<_>, Vec<_>) = lights.iter().partition(|light| light.has_specular());
    let centers = [&lambert, &glossy].map(|lights| {
        let center = |light: &&GaussianLight| Center::new(light.center, light.geometric_normal);
        lights.iter().map(center).collect::<Vec<_>>()
    });
    let lambert: Vec<_> = lambert.into_iter().map(LambertLight::new).collect();
    let glossy: Vec<_> = glossy.into_iter().map(GlossyLight::new).collect();
    gather.batches(
        &Lights { records: &lambert, centers: &centers[0], capacity: LAMBERT_CAPACITY },
        &Lights { records: &glossy, centers: &centers[1], capacity: GLOSSY_CAPACITY },
    )
}

/// For `pixels` surfaces seen from `camera`; kernels know the given reflectances alone.
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
    let view = View { camera, pixels };
    let traced = shadows.is_some();
    let wgsl = [
        linked_shader(kinds, false, traced, settings)?,
        linked_shader(kinds, kinds.specular, traced, settings)?,
    ];
    let wgsl = wgsl.each_ref().map(String::as_str);
    LightGather::new(gpu, [pixels, PIXELS_A_GROUP], &view, wgsl, Vec::new(), shadows)
}
