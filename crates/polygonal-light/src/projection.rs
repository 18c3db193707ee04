//! Triangles at the vertices of a grid.

use bytemuck::{Pod, Zeroable};
use manylights_area_lights::IRRADIANCE;
use manylights_gpu::{Binding, Error, Gpu, PassTime, Resource, UniformBatches, link};
use manylights_harmonics::count;
use manylights_harmonics::polygon::PolygonProjection;
use manylights_harmonics::wgsl::{self, Function};
use manylights_harmonics::zonal::TriangleForm;
use manylights_interpolation::{
    self as interpolation, Grid, GridCoefficients, Held, Interpolation, ProjectionSettings,
    ProjectionShader, SourceShader,
};
use manylights_method::Parameters;
use manylights_scene::AreaLight;

use crate::gather::{form_features, needs_corners, points_module};
use crate::light_record::{CenterRecord, CornerRecord};
use crate::{Approximation, Settings};

/// Triangles a batch.
const CAPACITY: usize = 512;

/// Lanes of a workgroup.
const LANES: u32 = 64;

/// As the shaders have it.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Told {
    spacing: [f32; 3],
    vertices: u32,
}

/// As [`Estimator::PROJECT`](manylights_area_lights::Estimator::PROJECT).
pub(crate) fn project_lights(
    gpu: &Gpu,
    grid: Grid<f32>,
    how: Interpolation,
    parameters: &Parameters,
    held: &Held<'_>,
) -> Result<(GridCoefficients, Vec<PassTime>), Error> {
    project(gpu, grid, &Settings::new(parameters), how.projection(), held.far)
}

/// The coefficients of triangles at the vertices of a grid, and the time of each pass. Exact triangles have
/// no loops to choose, nor an evaluation of harmonics.
///
/// # Errors
/// Where the adapter refuses a kernel or a buffer, or the device gave up.
pub fn project(
    gpu: &Gpu,
    grid: Grid<f32>,
    settings: &Settings,
    how: ProjectionSettings,
    lights: &[AreaLight],
) -> Result<(GridCoefficients, Vec<PassTime>), Error> {
    let bands = settings.bands;
    let Approximation::Sphere(form) = settings.approximation else {
        return project_exactly(gpu, grid, (bands, how.gradients), lights);
    };
    let shader = linked_projection(form, bands, how)?;
    if needs_corners(form) {
        let records: Vec<_> = lights.iter().filter_map(CornerRecord::new).collect();
        return interpolation::project(gpu, grid, &shader, &records);
    }
    let records: Vec<_> = lights.iter().filter_map(CenterRecord::new).collect();
    interpolation::project(gpu, grid, &shader, &records)
}

/// The projection of spheres in the stead of triangles.
///
/// # Errors
/// Where the shader does not link.
pub fn linked_projection(
    form: TriangleForm,
    bands: usize,
    how: ProjectionSettings,
) -> Result<ProjectionShader, Error> {
    let function = if how.gradients { Function::CapScalesWithRate } else { Function::CapScalesOf };
    let own = [
        ("sh", &*wgsl::module(bands, &[function])),
        ("points", &*points_module(bands)),
        ("triangle", include_str!("shaders/triangle.wesl")),
        ("solid_angle", include_str!("shaders/solid_angle.wesl")),
    ];
    SourceShader {
        source: include_str!("shaders/source.wesl"),
        modules: &[&own[..], &IRRADIANCE].concat(),
        // A grid is read by lobes on harmonics alone.
        features: &[&form_features(Some(form))[..], &[("transformed", false)]].concat(),
        capacity: CAPACITY,
    }
    .link(bands, how)
}

/// The coefficients of triangles at the vertices of a grid, lobe by lobe (Wu et al. 2020), and the time of each
/// pass: zonal integrals about 2n − 1 directions, a lane each, then the inverse of the addition theorem once a
/// vertex. Lights without area are left out.
///
/// # Errors
/// Where the adapter refuses a kernel or a buffer, or the device gave up.
fn project_exactly(
    gpu: &Gpu,
    grid: Grid<f32>,
    (bands, gradients): (usize, bool),
    lights: &[AreaLight],
) -> Result<(GridCoefficients, Vec<PassTime>), Error> {
    let projection = PolygonProjection::<f64>::new(bands);
    let lobes = projection.directions().len() as u32;
    let result = GridCoefficients::zero(gpu, grid, bands, gradients)?;
    let vertices = grid.count() as u32;
    let positions: Vec<[f32; 4]> = grid.positions().map(|[x, y, z]| [x, y, z, 1.0]).collect();
    let positions = gpu.storage("vertices", &positions)?;
    let told = gpu.uniform("grid", &Told { spacing: grid.spacing, vertices })?;
    let records: Vec<_> = lights.iter().filter_map(CornerRecord::new).collect();
    let batches = UniformBatches::new(gpu, "lights", &records, CAPACITY, CAPACITY)?;
    let inverses: Vec<f32> = projection.inverses().iter().map(|&value| value as f32).collect();
    let inverses = gpu.storage("inverses", &inverses)?;
    let channels = if gradients { 3 } else { 1 };
    let size = (grid.count() * lobes as usize * bands * channels * size_of::<[f32; 4]>()) as u64;
    let integrals = gpu.zeroed("zonal integrals", size)?;
    let [first, second] = linked_exact_projection(&projection, gradients)?;
    let layout = [Binding::Uniform, Binding::Storage, Binding::Batch, Binding::StorageMut];
    let first = gpu.kernel("project", &first, &layout)?;
    let layout = [Binding::Uniform, Binding::Storage, Binding::Storage, Binding::StorageMut];
    let second = gpu.kernel("invert", &second, &layout)?;
    let [told, positions, inverses, integrals, coefficients] =
        [&told, &positions, &inverses, &integrals, &result.buffer].map(Resource::Buffer);
    let batched = Resource::Batches(&batches);
    let first = gpu.pass("project", &first, &[told, positions, batched, integrals])?;
    let second = gpu.pass("invert", &second, &[told, inverses, integrals, coefficients])?;
    let groups = vertices.div_ceil(LANES);
    let mut dispatches: Vec<_> = (0..batches.counts().len())
        .map(|index| first.over_batch(index, [groups, lobes, 1]))
        .collect();
    dispatches.push(second.over([groups, count(bands) as u32, 1]));
    let times = gpu.run(&dispatches)?;
    Ok((result, times))
}

/// Both passes of the projection of exact triangles.
///
/// # Errors
/// Where a shader does not link.
pub fn linked_exact_projection(
    projection: &PolygonProjection<f64>,
    gradients: bool,
) -> Result<[String; 2], Error> {
    let directions = projection.directions();
    let vector =
        |[x, y, z]: &[f64; 3]| format!("vec3f({:?}, {:?}, {:?})", *x as f32, *y as f32, *z as f32);
    let vectors = directions.iter().map(vector).collect::<Vec<_>>().join(",\n        ");
    let (bands, count) = (projection.bands(), directions.len());
    let lobes = format!(
        "const BANDS = {bands}u;\nconst LOBES = {count}u;\n\nfn lobe(k: u32) -> vec3f {{\n    \
         var lobes = array<vec3f, {count}>(\n        {vectors},\n    );\n    return lobes[k];\n}}\n"
    );
    let layout = format!("const CAPACITY = {CAPACITY}u;\nconst LANES = {LANES}u;\n");
    // The record alone is of that module.
    let sh = format!("const BANDS = {bands}u;\n");
    let own = [
        ("lobes", &*lobes),
        ("layout", &*layout),
        ("sh", &*sh),
        ("triangle", include_str!("shaders/triangle.wesl")),
        ("solid_angle", include_str!("shaders/solid_angle.wesl")),
    ];
    let modules = [&own[..], &IRRADIANCE].concat();
    let forms = ["main", "solid_angle", "compromise", "compromise_root", "scaled"];
    let features = forms.map(|form| (form, false));
    let own = [("gradients", gradients), ("corners", true), ("point", false)];
    let features = [&features[..], &own].concat();
    let first = include_str!("shaders/zonal_integrals.wesl");
    let second = include_str!("shaders/coefficients.wesl");
    Ok([link("project", first, &modules, &features)?, link("invert", second, &modules, &features)?])
}
