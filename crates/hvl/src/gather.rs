//! The kernels and what they read.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{Buffer, Error, Gpu, LightBatches, LightGather, SphericalLight, link};
use manylights_harmonics::wgsl::{self, Function};

use crate::light_record::{GlossyLight, LambertLight};
use crate::lobes::LobeTable;
use crate::{Horizon, Settings, diffuse};

/// Spheres a batch, as `shaders/gather.wesl` declares its arrays: below 64 KiB of 64 bytes each.
pub(crate) const CAPACITY: usize = 1020;

/// Lanes, one pixel each: at ten bands a pixel's reflectance fills 110 registers.
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
    let sh = wgsl::module(settings.bands, &[Function::CapScales, Function::ZonalDotEven]);
    let modules = [
        ("sh", &*sh),
        ("diffuse", &*diffuse::module(settings.bands)),
        ("horizon", include_str!("shaders/horizon.wesl")),
        ("light", include_str!("shaders/light.wesl")),
    ];
    let features = [
        ("glossy_receivers", glossy_receivers),
        ("glossy_lights", glossy_lights),
        ("exact_horizon", settings.horizon == Horizon::Exact),
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
pub(crate) fn batches(gpu: &Gpu, lights: &[SphericalLight]) -> Result<LightBatches, Error> {
    let (glossy, lambert): (Vec<_>, Vec<_>) =
        lights.iter().partition(|sphere| sphere.light.brdf.has_specular());
    let lambert: Vec<_> = lambert.into_iter().map(LambertLight::new).collect();
    let glossy: Vec<_> = glossy.into_iter().map(GlossyLight::new).collect();
    LightBatches::new(gpu, (&lambert, CAPACITY), (&glossy, CAPACITY))
}

/// For `pixels` surfaces seen from `camera`. `alphas` are those of all receivers and lights with a
/// specular lobe; without any, no kernel knows GGX.
///
/// # Errors
/// Where a shader does not link or the adapter refuses.
pub(crate) fn gather(
    gpu: &Gpu,
    pixels: u32,
    camera: Vec3,
    alphas: &[f32],
    settings: &Settings,
) -> Result<LightGather, Error> {
    let specular = !alphas.is_empty();
    let wgsl =
        [linked_shader(specular, false, settings)?, linked_shader(specular, specular, settings)?];
    let wgsl = wgsl.each_ref().map(String::as_str);
    let tables = if specular { tables(gpu, alphas, settings.bands)? } else { Vec::new() };
    LightGather::new(gpu, [pixels, PIXELS_A_GROUP], &View { camera, pixels }, wgsl, tables)
}

/// The specular lobes of all materials, as bindings 5 and 6.
fn tables(gpu: &Gpu, alphas: &[f32], bands: usize) -> Result<Vec<Buffer>, Error> {
    let tables: Vec<_> = alphas.iter().map(|&alpha| LobeTable::of(alpha, bands)).collect();
    let values: Vec<[f32; 2]> = tables
        .iter()
        .flat_map(|table| table.values().iter().map(|pair| pair.map(|value| value as f32)))
        .collect();
    Ok(vec![gpu.storage("alphas", alphas)?, gpu.storage("lobes", &values)?])
}
