//! The kernel and what it reads.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_area_lights::{AreaGather, EstimatorShader, GatherShader, IRRADIANCE, Narrow};
use manylights_gpu::{Buffer, Error, Gpu, PointBindings, Table};
use manylights_harmonics::wgsl::{self, Function};
use manylights_interpolation::Grid;
use manylights_reflectance::transformed_cosine::{self, TRANSFORMED_LOBES};
use manylights_reflectance::{
    CosineProduct, Damping, Form, LOBES, MODULES, Materials, ReceiverKinds, SHAPES, Tables,
    diffuse, lobe_wgsl,
};
use manylights_scene::AreaLight;

use crate::cap_table::{self, COEFFICIENTS, CapTable};
use crate::{Coefficients, Extent, Product, Settings};

/// Spheres a batch.
pub(crate) const CAPACITY: usize = 512;

/// A sphere of light as the shader reads it: 32 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct SphereLight {
    /// Metres.
    pub center: Vec3,
    /// Metres.
    pub radius: f32,
    /// W·m⁻²·sr⁻¹.
    pub radiance: Vec3,
    padding: f32,
}

impl SphereLight {
    /// Of these.
    pub fn new(center: Vec3, radius: f32, radiance: Vec3) -> Self {
        Self { center, radius, radiance, padding: 0.0 }
    }

    /// `None` of a light that is no sphere.
    pub fn of(light: &AreaLight) -> Option<Self> {
        match *light {
            AreaLight::Sphere { center, radius, radiance } => {
                Some(Self::new(center, radius, radiance))
            }
            AreaLight::Triangle { .. } => None,
        }
    }

    /// What a grid can hold of one near it: of at least half of the largest spacing, so that coefficients change
    /// little enough between vertices, and of the same power, L r². Seen as a disc ([`Extent::Disc`]).
    pub fn smoothed(&self, grid: &Grid<f32>) -> Self {
        let spacing = grid.spacing.into_iter().fold(0.0, f32::max);
        let radius = self.radius.max(0.5 * spacing);
        Self::new(self.center, radius, (self.radius / radius).powi(2) * self.radiance)
    }

    /// Of all that are spheres.
    pub(crate) fn all(lights: &[AreaLight]) -> Vec<Self> {
        lights.iter().filter_map(Self::of).collect()
    }
}

/// The kernel for receivers of the given lobes.
///
/// # Errors
/// Where the shader does not link.
pub fn linked_shader(kinds: ReceiverKinds, settings: &Settings) -> Result<GatherShader, Error> {
    let Settings { bands, coefficients, extent, .. } = *settings;
    let (estimator, modules, kinds_and_product) = match settings.product {
        Product::Full => full(kinds, settings),
        Product::Cosine(product) => cosine(kinds, product, settings),
    };
    let made: Vec<_> = modules.iter().map(|(name, text)| (*name, &**text)).collect();
    let own = [
        ("cap_table", &*cap_table::module(bands)),
        ("sphere", include_str!("shaders/sphere.wesl")),
    ];
    let features = [
        ("tabulated", coefficients == Coefficients::Tabulated),
        ("disc", extent == Extent::Disc),
        // Kernels read the tables of harmonics alone.
        ("measured", false),
    ];
    EstimatorShader {
        estimator,
        modules: &[&own[..], &made, &MODULES].concat(),
        features: &[&features[..], &kinds_and_product].concat(),
        capacity: CAPACITY,
        bindings: PointBindings { settings: &[], tables: table_names(kinds, settings) },
    }
    .link()
}

/// An estimator, the modules that it imports, and its switches.
type Estimator = (&'static str, Vec<(&'static str, String)>, Vec<(&'static str, bool)>);

fn full(kinds: ReceiverKinds, settings: &Settings) -> Estimator {
    let bands = settings.bands;
    let mut modules = vec![
        ("sh", wgsl::module(bands, &[Function::CapScalesOf, Function::EvaluateEven])),
        ("diffuse", diffuse::module(bands, Damping::None)),
        ("lobe", lobe_wgsl::module(bands, Form::Full)),
    ];
    let features = if transformed(kinds, settings) {
        modules.push(("transformed_cosine", transformed_cosine::module()));
        modules.extend(IRRADIANCE.map(|(name, text)| (name, text.to_owned())));
        kinds.transformed_features()
    } else {
        kinds.features(Form::Full)
    };
    (include_str!("shaders/full.wesl"), modules, features.into())
}

/// Whether narrow lobes are transformed cosines.
pub(crate) fn transformed(kinds: ReceiverKinds, settings: &Settings) -> bool {
    kinds.narrow && settings.narrow == Narrow::Transformed
}

fn cosine(kinds: ReceiverKinds, product: CosineProduct, settings: &Settings) -> Estimator {
    let Settings { bands, diffuse, .. } = *settings;
    let mut modules = Vec::from(product.modules(bands));
    modules.push(("lobe", lobe_wgsl::mirror_module(bands)));
    let features = [&kinds.mirror_features()[..], &product.features(diffuse)].concat();
    (include_str!("shaders/cosine.wesl"), modules, features)
}

/// Those of [`tables`].
fn table_names(kinds: ReceiverKinds, settings: &Settings) -> Vec<Table> {
    let pairs = [SHAPES, LOBES].map(|name| Table { name, element: "vec2f" });
    let mut names = if kinds.specular { pairs.to_vec() } else { Vec::new() };
    if settings.coefficients == Coefficients::Tabulated {
        names.push(Table { name: COEFFICIENTS, element: "vec4f" });
    }
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
    let bands = settings.bands;
    let mut on_gpu = Vec::new();
    if materials.kinds().specular {
        let lobes = match settings.product {
            Product::Full => materials.lobe_records(tables, bands, Form::Full, Damping::None),
            Product::Cosine(_) => materials.mirror_records(tables, bands),
        };
        on_gpu.push(gpu.storage("shapes", &materials.shape_records())?);
        on_gpu.push(gpu.storage("lobes", &lobes)?);
    }
    if settings.coefficients == Coefficients::Tabulated {
        on_gpu.push(gpu.storage("coefficients", &CapTable::new(bands).records())?);
    }
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
    surfaces: &[manylights_gpu::SurfaceRecord],
    camera: Vec3,
    lights: &[SphereLight],
    settings: &Settings,
) -> Result<Vec<[f32; 3]>, Error> {
    let materials = Materials::new(surfaces.iter().map(|surface| surface.brdf()));
    let tables = tables(gpu, &materials, settings, Tables::shared())?;
    let shader = linked_shader(materials.kinds(), settings)?;
    let on_gpu = gpu.storage("surfaces", surfaces)?;
    let gather = AreaGather::new(gpu, (&on_gpu, surfaces.len() as u32), camera, &shader, tables)?;
    let batches = gather.batches(lights)?;
    gather.add(&batches, 0..batches.count())?;
    gather.radiance()
}
