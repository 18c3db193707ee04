//! The kernel and what it reads.

use glam::Vec3;
use manylights_area_lights::{AreaGather, EstimatorShader, GatherShader, IRRADIANCE, LightRecords};
use manylights_gpu::{Buffer, Error, Gpu, PointBindings, SurfaceRecord, Table};
use manylights_harmonics::wgsl::{self, Function, polygon};
use manylights_harmonics::zonal::TriangleForm;
use manylights_reflectance::transformed_cosine::{self, TRANSFORMED_LOBES};
use manylights_reflectance::{
    Damping, Form, LOBES, MODULES, Materials, ReceiverKinds, SHAPES, Tables, diffuse, lobe_wgsl,
};
use manylights_scene::AreaLight;

use crate::exact::ExactRecord;
use crate::light_record::{CenterRecord, CornerRecord, OutlinedRecord};
use crate::{Approximation, Narrow, Settings};

/// Triangles a batch.
const CAPACITY: usize = 512;

/// What the kernel of an approximation reads of the lights; those without area are left out.
pub(crate) fn records(
    lights: &[AreaLight],
    kinds: ReceiverKinds,
    settings: &Settings,
) -> Box<dyn LightRecords> {
    match settings.approximation {
        Approximation::Exact(edges) => Box::new(ExactRecord::all(lights, edges)),
        Approximation::Sphere(form) if needs_corners(form) => {
            Box::new(lights.iter().filter_map(CornerRecord::new).collect::<Vec<_>>())
        }
        Approximation::Sphere(_) if transformed(kinds, settings) => {
            Box::new(lights.iter().filter_map(OutlinedRecord::new).collect::<Vec<_>>())
        }
        Approximation::Sphere(_) => {
            Box::new(lights.iter().filter_map(CenterRecord::new).collect::<Vec<_>>())
        }
    }
}

/// Whether a form needs the triangle's solid angle.
pub(crate) fn needs_corners(form: TriangleForm) -> bool {
    matches!(form, TriangleForm::SolidAngle | TriangleForm::Scaled | TriangleForm::Point)
}

/// Whether narrow lobes are transformed cosines.
pub(crate) fn transformed(kinds: ReceiverKinds, settings: &Settings) -> bool {
    kinds.narrow && settings.narrow == Narrow::Transformed
}

/// The kernel for receivers of the given lobes.
///
/// # Errors
/// Where the shader does not link.
pub fn linked_shader(kinds: ReceiverKinds, settings: &Settings) -> Result<GatherShader, Error> {
    let Settings { bands, approximation, .. } = *settings;
    let (estimator, form) = match approximation {
        Approximation::Exact(_) => (include_str!("shaders/exact.wesl"), None),
        Approximation::Sphere(form) => (include_str!("shaders/sphere.wesl"), Some(form)),
    };
    let made = [
        ("sh", wgsl::module(bands, &[Function::CapScalesOf, Function::EvaluateEven])),
        ("diffuse", diffuse::module(bands, Damping::None)),
        ("lobe", lobe_wgsl::module(bands, Form::Full)),
        ("points", points_module(bands)),
        ("polygon", polygon_module(kinds, bands)),
    ];
    let made = made.each_ref().map(|(name, text)| (*name, &**text));
    let own = [
        ("triangle", include_str!("shaders/triangle.wesl")),
        ("solid_angle", include_str!("shaders/solid_angle.wesl")),
        ("narrow", include_str!("shaders/narrow.wesl")),
        ("transformed_cosine", &*transformed_cosine::module()),
    ];
    let of_receivers = if transformed(kinds, settings) {
        kinds.transformed_features()
    } else {
        kinds.features(Form::Full)
    };
    let features = [
        // Kernels read the tables of harmonics alone.
        ("measured", false),
    ];
    EstimatorShader {
        estimator,
        modules: &[&made[..], &own, &IRRADIANCE, &MODULES].concat(),
        features: &[&features[..], &form_features(form), &of_receivers].concat(),
        capacity: CAPACITY,
        bindings: PointBindings { settings: &[], tables: table_names(kinds, settings) },
    }
    .link()
}

/// The switches of triangle.wesl, for a sphere's form or for exact edges.
pub(crate) fn form_features(form: Option<TriangleForm>) -> [(&'static str, bool); 7] {
    [
        ("main", form == Some(TriangleForm::Main)),
        ("solid_angle", form == Some(TriangleForm::SolidAngle)),
        ("compromise", form == Some(TriangleForm::Compromise)),
        ("compromise_root", form == Some(TriangleForm::CompromiseRoot)),
        ("scaled", form == Some(TriangleForm::Scaled)),
        ("point", form == Some(TriangleForm::Point)),
        ("corners", form.is_some_and(needs_corners)),
    ]
}

/// c_l of a point.
pub(crate) fn points_module(bands: usize) -> String {
    let ones = vec!["1.0"; bands].join(", ");
    format!("fn point_scales() -> array<f32, {bands}> {{ return array({ones}); }}\n")
}

/// What exact edges meet the lobes with.
fn polygon_module(kinds: ReceiverKinds, bands: usize) -> String {
    if !kinds.specular {
        let lobe: Vec<_> = diffuse::lobes(bands, Damping::None).iter().map(|[k, _]| *k).collect();
        let edge = polygon::zonal_edge(&lobe).wgsl;
        return format!("const LAMBERT = {:?};\n\n{edge}", lobe[0] as f32);
    }
    let functions = [
        polygon::weights(bands),
        polygon::zonal_weights(bands),
        polygon::edge(bands, kinds.channels()),
    ];
    let (alone, together) = polygon::weight_counts(bands);
    let texts = functions.map(|function| function.wgsl).join("\n");
    format!("const ALONE = {alone}u;\nconst TOGETHER = {together}u;\n\n{texts}")
}

/// Those of [`tables`].
fn table_names(kinds: ReceiverKinds, settings: &Settings) -> Vec<Table> {
    let pairs = [SHAPES, LOBES].map(|name| Table { name, element: "vec2f" });
    let mut names = if kinds.specular { pairs.to_vec() } else { Vec::new() };
    if transformed(kinds, settings) {
        names.push(Table { name: TRANSFORMED_LOBES, element: "vec4f" });
    }
    names
}

/// What kernels read, on the adapter, as [`table_names`] has it.
///
/// # Errors
/// Where the adapter refuses.
pub(crate) fn tables(
    gpu: &Gpu,
    materials: &Materials,
    settings: &Settings,
    tables: &Tables,
) -> Result<Vec<Buffer>, Error> {
    if !materials.kinds().specular {
        return Ok(Vec::new());
    }
    let lobes = materials.lobe_records(tables, settings.bands, Form::Full, Damping::None);
    let shapes = gpu.storage("shapes", &materials.shape_records())?;
    let mut on_gpu = vec![shapes, gpu.storage("lobes", &lobes)?];
    if transformed(materials.kinds(), settings) {
        on_gpu.push(gpu.storage("transformed lobes", &materials.transformed_records())?);
    }
    Ok(on_gpu)
}

/// Radiance of given surfaces under given lights, by the adapter's kernels: what a picture does, for hard
/// cases that no scene brings about; nothing is declined, and a negative sum stays one.
///
/// # Errors
/// Where the adapter refuses.
pub fn gather(
    gpu: &Gpu,
    surfaces: &[SurfaceRecord],
    camera: Vec3,
    lights: &[AreaLight],
    settings: &Settings,
) -> Result<Vec<[f32; 3]>, Error> {
    let materials = Materials::new(surfaces.iter().map(|surface| surface.brdf()));
    let tables = tables(gpu, &materials, settings, Tables::shared())?;
    let shader = linked_shader(materials.kinds(), settings)?;
    let on_gpu = gpu.storage("surfaces", surfaces)?;
    let gather = AreaGather::new(gpu, (&on_gpu, surfaces.len() as u32), camera, &shader, tables)?;
    let batches = records(lights, materials.kinds(), settings).batches(&gather)?;
    gather.add(&batches, 0..batches.count())?;
    gather.radiance()
}
