//! The kernels and what they read.

use glam::Vec3;
use manylights_gpu::{Buffer, Center, Error, Gpu, PointBindings, Shadows, Table};
use manylights_harmonics::wgsl::{self, Function};
use manylights_virtual_lights::{
    EstimatorShader, GatherShader, LightBatches, LightGather, Lights, PixelsALane, VirtualSphere,
};

use crate::emission::{self, EMISSIONS, EmissionTables};
use crate::light_record::{GlossyLight, LambertLight, rounded_shape};
use crate::{Horizon, Settings};
use manylights_reflectance::{
    Form, LOBES, LobeShape, MODULES, Materials, ReceiverKinds, SHAPES, Tables, diffuse, lobe_wgsl,
    single,
};

/// Spheres a batch.
pub(crate) const CAPACITY: usize = 512;

/// The lobes that kernels must know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LobeKinds {
    /// Of receivers.
    pub receivers: ReceiverKinds,
    /// Some light of the batch has one, and its emission is not isotropic.
    pub lights: bool,
}

/// The kernel for receivers and lights of the given lobes.
///
/// # Errors
/// Where the shader does not link.
pub fn linked_shader(
    lobes: LobeKinds,
    traced: bool,
    settings: &Settings,
) -> Result<GatherShader, Error> {
    let Settings { bands, emission_bands, damping, .. } = *settings;
    let expanded = emission_bands > 0;
    let sh = wgsl::module(bands, &[Function::CapScales, Function::EvaluateEven]);
    let emission_sh = wgsl::module(emission_bands.max(1), &[Function::EvaluateEven]);
    let own = [
        ("sh", &*sh),
        ("diffuse", &*diffuse::module(bands, damping)),
        ("lobe", &*lobe_wgsl::module(bands, settings.form)),
        ("emission_sh", &*emission_sh),
        ("emission", &*emission::module(emission_bands.max(1))),
        ("horizon", include_str!("shaders/horizon.wesl")),
        ("light", include_str!("shaders/light.wesl")),
    ];
    let modules = [&own[..], &MODULES].concat();
    let features = [
        ("glossy_lights", lobes.lights),
        ("exact_horizon", settings.horizon == Horizon::Exact),
        ("expanded_emission", expanded),
        // Kernels read the tables of harmonics alone.
        ("measured", false),
    ];
    let features = [&features[..], &lobes.receivers.features(settings.form)].concat();
    EstimatorShader {
        estimator: include_str!("shaders/estimator.wesl"),
        modules: &modules,
        features: &features,
        traced,
        capacity: CAPACITY,
        // At ten bands a pixel's reflectance fills 55 registers, of colours and measurements two and
        // three times that. Two pixels gained nothing on lavapipe and made 20 bands take minutes to
        // compile.
        pixels_a_lane: PixelsALane::One,
        bindings: PointBindings { settings: &[], tables: table_names(lobes) },
    }
    .link()
}

/// Those of [`tables`].
fn table_names(lobes: LobeKinds) -> Vec<Table> {
    let tables = [SHAPES, LOBES, EMISSIONS].map(|name| Table { name, element: "vec2f" });
    if lobes.receivers.specular { tables.to_vec() } else { Vec::new() }
}

/// First element in the table of emissions of the row for a light.
fn emission_row(materials: &Materials, sphere: &VirtualSphere, bands: usize) -> u32 {
    let shape = LobeShape::from(sphere.light.brdf);
    // Rounding keeps the order.
    let table = materials.shapes().partition_point(|&other| rounded_shape(other) < shape);
    let row = table * emission::ANGLES + emission::degrees(&sphere.light);
    (row * emission::terms(bands).count()) as u32
}

/// Why these settings cannot show the materials, if so.
pub(crate) fn declined(materials: &Materials, settings: &Settings) -> Option<&'static str> {
    match (materials.kinds().measured, settings) {
        (true, Settings { form: Form::Zonal, .. }) => {
            Some("one circular lobe is no measured material: set form=full")
        }
        (true, Settings { emission_bands: 0, .. }) => {
            Some("measured materials emit by expansion alone: set emission_bands ≥ 1")
        }
        _ => None,
    }
}

fn lobe_kinds(materials: &Materials, settings: &Settings) -> [LobeKinds; 2] {
    let receivers = materials.kinds();
    let lights = receivers.specular && settings.emission_bands != 1;
    [false, lights].map(|lights| LobeKinds { receivers, lights })
}

/// Tables of the materials among these, on the adapter, as [`table_names`] has them.
pub(crate) fn tables(
    materials: &Materials,
    gpu: &Gpu,
    settings: &Settings,
    (receivers, emissions): (&Tables, &EmissionTables),
) -> Result<Vec<Buffer>, Error> {
    if materials.shapes().is_empty() {
        return Ok(Vec::new());
    }
    let Settings { bands, form, damping, .. } = *settings;
    let lobes = materials.lobe_records(receivers, bands, form, damping);
    let shapes = materials.shape_records();
    let mut tables = vec![gpu.storage("shapes", &shapes)?, gpu.storage("lobes", &lobes)?];
    let bands = settings.emission_bands;
    // The adapter keeps kernels by their text: that of Lambertian lights, which is the same for all
    // bands of emission, must find the same bindings.
    if bands <= 1 {
        tables.push(gpu.storage("emissions", &[[0_f32; 2]])?);
    } else {
        let rows = |&shape| single(emissions.get(rounded_shape(shape), bands).values());
        let rows: Vec<_> = materials.shapes().iter().flat_map(rows).collect();
        tables.push(gpu.storage("emissions", &rows)?);
    }
    Ok(tables)
}

/// The lights in uniform memory.
///
/// # Errors
/// Where the adapter refuses.
pub(crate) fn batches(
    gather: &LightGather,
    lights: &[VirtualSphere],
    materials: &Materials,
    settings: &Settings,
) -> Result<LightBatches, Error> {
    let bands = settings.emission_bands;
    let (glossy, lambert): (Vec<_>, Vec<_>) =
        lights.iter().partition(|sphere| bands != 1 && sphere.light.brdf.has_specular());
    let centers = [&lambert, &glossy].map(|lights: &Vec<&VirtualSphere>| {
        lights.iter().map(|sphere| Center::from(&sphere.light)).collect::<Vec<_>>()
    });
    let lambert: Vec<_> = lambert.into_iter().map(LambertLight::new).collect();
    let record = |sphere| GlossyLight::new(sphere, emission_row(materials, sphere, bands));
    let glossy: Vec<_> = glossy.into_iter().map(record).collect();
    gather.batches(
        &Lights { records: &lambert, centers: &centers[0] },
        &Lights { records: &glossy, centers: &centers[1] },
    )
}

/// For the first `pixels` of `surfaces`, seen from `camera`; without a specular lobe no kernel knows
/// GGX.
///
/// # Errors
/// Where a shader does not link or the adapter refuses.
pub(crate) fn gather(
    gpu: &Gpu,
    surfaces: (&Buffer, u32),
    camera: Vec3,
    materials: &Materials,
    tables: Vec<Buffer>,
    settings: &Settings,
    shadows: Option<Shadows>,
) -> Result<LightGather, Error> {
    let [lambert, glossy] = lobe_kinds(materials, settings);
    let traced = shadows.is_some();
    let shaders =
        [linked_shader(lambert, traced, settings)?, linked_shader(glossy, traced, settings)?];
    LightGather::new(gpu, surfaces, camera, shaders, tables, shadows)
}
