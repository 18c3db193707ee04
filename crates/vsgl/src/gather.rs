//! The kernels and what they read.

use glam::Vec3;
use manylights_gpu::{Buffer, Center, Error, Gpu, PointBindings, Reflectances, Shadows};
use manylights_virtual_lights::{
    EstimatorShader, GatherShader, LightBatches, LightGather, Lights, PixelsALane,
};

use crate::light_record::{GlossyLight, LambertLight};
use crate::{Approximation, GaussianLight, Settings};

/// Lights a batch: below 32 KiB each.
pub(crate) const LAMBERT_CAPACITY: usize = 512;
const GLOSSY_CAPACITY: usize = 256;

/// The kernel for receivers of the given reflectances and lights with or without a specular lobe.
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
        ("filtered", settings.lobe == Approximation::Filtered),
        ("cut_behind", settings.cut_behind),
    ];
    EstimatorShader {
        estimator: include_str!("shaders/estimator.wesl"),
        modules: &[
            ("gaussian", include_str!("shaders/gaussian.wesl")),
            ("reflection", include_str!("shaders/reflection.wesl")),
        ],
        features: &[&features[..], &kinds.features()].concat(),
        traced,
        capacity: if glossy_lights { GLOSSY_CAPACITY } else { LAMBERT_CAPACITY },
        pixels_a_lane: PixelsALane::One,
        bindings: PointBindings::default(),
    }
    .link()
}

/// The lights in uniform memory.
///
/// # Errors
/// Where the adapter refuses.
pub(crate) fn batches(
    gather: &LightGather,
    lights: &[GaussianLight],
    settings: &Settings,
) -> Result<LightBatches, Error> {
    let (glossy, lambert): (Vec<_>, Vec<_>) = lights.iter().partition(|light| light.has_specular());
    let centers = [&lambert, &glossy].map(|lights| {
        let center = |light: &&GaussianLight| Center::new(light.center, light.geometric_normal);
        lights.iter().map(center).collect::<Vec<_>>()
    });
    let lambert = lambert.into_iter().map(|light| LambertLight::new(light, settings));
    let glossy = glossy.into_iter().map(|light| GlossyLight::new(light, settings));
    let (lambert, glossy): (Vec<_>, Vec<_>) = (lambert.collect(), glossy.collect());
    gather.batches(
        &Lights { records: &lambert, centers: &centers[0] },
        &Lights { records: &glossy, centers: &centers[1] },
    )
}

/// For the first `pixels` of `surfaces`, seen from `camera`; kernels know the given reflectances alone.
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
    let traced = shadows.is_some();
    let shaders = [
        linked_shader(kinds, false, traced, settings)?,
        linked_shader(kinds, kinds.specular, traced, settings)?,
    ];
    LightGather::new(gpu, surfaces, camera, shaders, Vec::new(), shadows)
}
