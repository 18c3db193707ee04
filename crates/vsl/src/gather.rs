//! The kernels and what they read.

use glam::Vec3;
use manylights_gpu::{Buffer, Center, Error, Gpu, PointBindings, Reflectances, Shadows};
use manylights_virtual_lights::{
    EstimatorShader, GatherShader, LightBatches, LightGather, Lights, PixelsALane,
};

use crate::light_record::{GlossyLight, LambertLight};
use crate::{Settings, VirtualSphere};

/// Lights a batch. Work on a light outweighs reading it,
/// so batches are small: with many samples one may take a second.
pub(crate) const CAPACITY: usize = 128;

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
        ("brdf_samples", settings.sampling.has_brdf()),
        ("cone_samples", settings.sampling.has_cone()),
    ];
    EstimatorShader {
        estimator: include_str!("shaders/estimator.wesl"),
        modules: &[
            ("pair", include_str!("shaders/pair.wesl")),
            ("sampling", include_str!("shaders/sampling.wesl")),
        ],
        features: &[&features[..], &kinds.features()].concat(),
        traced,
        capacity: CAPACITY,
        pixels_a_lane: PixelsALane::One,
        bindings: PointBindings { settings: &[("samples", "u32")], tables: kinds.table_names() },
    }
    .link()
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
    // For each pair of pixel and light, of each strategy.
    let mut own = vec![gpu.uniform("settings of vsl", &[settings.directions, 0, 0, 0])?];
    own.extend(kinds.tables(gpu)?);
    let traced = shadows.is_some();
    let shaders = [
        linked_shader(kinds, false, traced, settings)?,
        linked_shader(kinds, kinds.specular, traced, settings)?,
    ];
    LightGather::new(gpu, surfaces, camera, shaders, own, shadows)
}
