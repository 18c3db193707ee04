//! The kernels and what they read.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{Buffer, Center, Error, Gpu, PointBindings, Reflectances, Shadows};
use manylights_virtual_lights::{
    EstimatorShader, GatherShader, LightBatches, LightGather, Lights, PixelsALane, VirtualLight,
};

use crate::Settings;
use crate::light_record::{GlossyLight, LambertLight};

/// Lights a batch: below 64 KiB each.
pub(crate) const LAMBERT_CAPACITY: usize = 1024;
const GLOSSY_CAPACITY: usize = 480;

/// The kernel for receivers of the given kinds, and lights that are Lambertian or not.
///
/// # Errors
/// Where the shader does not link.
pub fn linked_shader(
    kinds: &Reflectances,
    glossy_lights: bool,
    traced: bool,
    settings: &Settings,
) -> Result<GatherShader, Error> {
    let features = [
        ("glossy_receivers", kinds.specular),
        ("glossy_lights", glossy_lights),
        ("clamped", settings.clamp.is_some()),
        ("attenuated", settings.attenuation_radius.is_some()),
    ];
    EstimatorShader {
        estimator: include_str!("shaders/estimator.wesl"),
        modules: &[],
        features: &[&features[..], &kinds.features()].concat(),
        traced,
        capacity: if glossy_lights { GLOSSY_CAPACITY } else { LAMBERT_CAPACITY },
        // Reading a light costs lavapipe more than shading with it: see benches/gather.rs.
        pixels_a_lane: PixelsALane::Four,
        bindings: PointBindings {
            settings: &[("clamp", "f32"), ("radius2", "f32")],
            tables: kinds.table_names(),
        },
    }
    .link()
}

/// The bound of the geometry term, m⁻², and the square of the radius of Yuksel's attenuation, m².
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Uniform {
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
        &Lights { records: &lambert, centers: &centers[0] },
        &Lights { records: &glossy, centers: &centers[1] },
    )
}

/// For the first `pixels` of `surfaces`, of the given kinds, seen from `camera`.
///
/// # Errors
/// Where a shader does not link or the adapter refuses.
pub(crate) fn gather(
    gpu: &Gpu,
    surfaces: (&Buffer, u32),
    camera: Vec3,
    kinds: &Reflectances,
    settings: &Settings,
    shadows: Option<Shadows>,
) -> Result<LightGather, Error> {
    let radius = settings.attenuation_radius.unwrap_or(0.0);
    let clamp = settings.clamp.unwrap_or(0.0);
    let uniform = Uniform { clamp, radius2: radius * radius, padding: [0; 2] };
    let mut own = vec![gpu.uniform("settings of vpl", &uniform)?];
    own.extend(kinds.tables(gpu)?);
    let traced = shadows.is_some();
    let shaders = [
        linked_shader(kinds, false, traced, settings)?,
        linked_shader(kinds, kinds.specular, traced, settings)?,
    ];
    LightGather::new(gpu, surfaces, camera, shaders, own, shadows)
}
