//! The kernels and what they read.

use std::cmp::Ordering;

use glam::Vec3;
use manylights_gpu::{Buffer, Center, Error, Gpu, PointBindings, Shadows, Table};
use manylights_harmonics::wgsl::{self, Function};
use manylights_scene::{Brdf, Lobe, Material, Scene};
use manylights_virtual_lights::{
    EstimatorShader, GatherShader, LightBatches, LightGather, Lights, PixelsALane, VirtualSphere,
};

use crate::emission::{self, EMISSIONS, EmissionTables};
use crate::light_record::{GlossyLight, LambertLight, rounded_shape};
use crate::{Horizon, Settings};
use manylights_reflectance::{
    Form, LOBES, LobeShape, RECEIVER, SHAPES, Tables, diffuse, lobe_wgsl,
};

/// Spheres a batch.
pub(crate) const CAPACITY: usize = 512;

/// The lobes that kernels must know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LobeKinds {
    /// Some receiver may have a specular lobe.
    pub receivers: bool,
    /// Some light of the batch has one, and its emission is not isotropic.
    pub lights: bool,
    /// Some specular lobe is not grey at normal incidence.
    pub colored: bool,
    /// Some specular lobe has the exact Fresnel term.
    pub exact_fresnel: bool,
    /// Some reflectance is measured: receivers have a lobe for each channel.
    pub measured: bool,
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
    let modules = [
        ("sh", &*sh),
        ("diffuse", &*diffuse::module(bands, damping)),
        ("lobe", &*lobe_wgsl::module(bands, settings.form)),
        ("emission_sh", &*emission_sh),
        ("emission", &*emission::module(emission_bands.max(1))),
        ("horizon", include_str!("shaders/horizon.wesl")),
        RECEIVER,
        ("light", include_str!("shaders/light.wesl")),
    ];
    let features = [
        ("glossy_receivers", lobes.receivers),
        ("glossy_lights", lobes.lights),
        ("colored", lobes.colored && !lobes.measured),
        ("rgb_lobes", lobes.measured),
        ("zonal", settings.form == Form::Zonal),
        ("exact_horizon", settings.horizon == Horizon::Exact),
        ("expanded_emission", expanded),
        ("exact_fresnel", lobes.exact_fresnel),
        // Kernels read the tables of harmonics alone.
        ("measured", false),
    ];
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

/// Those of [`Materials::tables`].
fn table_names(lobes: LobeKinds) -> Vec<Table> {
    let tables = [SHAPES, LOBES, EMISSIONS].map(|name| Table { name, element: "vec2f" });
    if lobes.receivers { tables.to_vec() } else { Vec::new() }
}

/// What all specular lobes of a picture have.
pub(crate) struct Materials {
    /// Their shapes, in order.
    shapes: Vec<LobeShape>,
    colored: bool,
    exact_fresnel: bool,
    measured: bool,
}

impl Materials {
    pub(crate) fn new(brdfs: impl Iterator<Item = Brdf>) -> Self {
        let specular: Vec<_> = brdfs.filter(Brdf::has_specular).collect();
        let mut shapes: Vec<_> = specular.iter().copied().flat_map(LobeShape::all_of).collect();
        shapes.sort_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Equal));
        shapes.dedup();
        let grey = |brdf: &Brdf| brdf.f0 == Vec3::splat(brdf.f0.x);
        let measured = |brdf: &Brdf| matches!(brdf.lobe, Lobe::Measured(_));
        let exact = |brdf: &Brdf| matches!(brdf.lobe, Lobe::Dielectric { .. });
        Self {
            shapes,
            colored: !specular.iter().all(grey),
            exact_fresnel: specular.iter().any(exact),
            measured: specular.iter().any(measured),
        }
    }

    pub(crate) fn of_scene(scene: &Scene) -> Self {
        let materials = &scene.materials;
        let plain = Self::new(materials.iter().map(|material| material.brdf(material.base_color)));
        let textured = |m: &Material| m.metallic > 0.0 && m.base_color_texture.is_some();
        Self { colored: plain.colored || materials.iter().any(textured), ..plain }
    }

    /// First element in the table of emissions of the row for a light.
    fn emission_row(&self, sphere: &VirtualSphere, bands: usize) -> u32 {
        let shape = LobeShape::from(sphere.light.brdf);
        // Rounding keeps the order.
        let table = self.shapes.partition_point(|&other| rounded_shape(other) < shape);
        let row = table * emission::ANGLES + emission::degrees(&sphere.light);
        (row * emission::terms(bands).count()) as u32
    }

    /// Why these settings cannot show them, if so.
    pub(crate) fn declined(&self, settings: &Settings) -> Option<&'static str> {
        match (self.measured, settings) {
            (true, Settings { form: Form::Zonal, .. }) => {
                Some("one circular lobe is no measured material: set form=full")
            }
            (true, Settings { emission_bands: 0, .. }) => {
                Some("measured materials emit by expansion alone: set emission_bands ≥ 1")
            }
            _ => None,
        }
    }

    /// Scalar lobes that a pixel is multiplied with.
    pub(crate) fn channels(&self) -> usize {
        if self.measured { 3 } else { 1 + usize::from(self.colored) }
    }

    fn lobes(&self, settings: &Settings) -> [LobeKinds; 2] {
        let receivers = !self.shapes.is_empty();
        let lights = receivers && settings.emission_bands != 1;
        let Self { colored, exact_fresnel, measured, .. } = *self;
        [false, lights].map(|lights| LobeKinds {
            receivers,
            lights,
            colored,
            exact_fresnel,
            measured,
        })
    }

    /// Their tables among these, on the adapter, as [`table_names`] has them.
    pub(crate) fn tables(
        &self,
        gpu: &Gpu,
        settings: &Settings,
        (receivers, emissions): (&Tables, &EmissionTables),
    ) -> Result<Vec<Buffer>, Error> {
        if self.shapes.is_empty() {
            return Ok(Vec::new());
        }
        let lobes = self.shapes.iter().flat_map(|&shape| {
            let Settings { bands, damping, .. } = *settings;
            match settings.form {
                Form::Full => single(receivers.lobes(shape, bands, damping).values()),
                Form::Zonal => single(receivers.zonal(shape, bands, damping).values()),
            }
        });
        let lobes: Vec<_> = lobes.collect();
        let shapes: Vec<_> = self.shapes.iter().map(|shape| shape.record()).collect();
        let mut tables = vec![gpu.storage("shapes", &shapes)?, gpu.storage("lobes", &lobes)?];
        let bands = settings.emission_bands;
        // The adapter keeps kernels by their text: that of Lambertian lights, which is the same for all
        // bands of emission, must find the same bindings.
        if bands <= 1 {
            tables.push(gpu.storage("emissions", &[[0_f32; 2]])?);
        } else {
            let rows = |&shape| single(emissions.get(rounded_shape(shape), bands).values());
            let rows: Vec<_> = self.shapes.iter().flat_map(rows).collect();
            tables.push(gpu.storage("emissions", &rows)?);
        }
        Ok(tables)
    }
}

fn single(values: &[[f64; 2]]) -> Vec<[f32; 2]> {
    values.iter().map(|pair| pair.map(|value| value as f32)).collect()
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
    let record = |sphere| GlossyLight::new(sphere, materials.emission_row(sphere, bands));
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
    let [lambert, glossy] = materials.lobes(settings);
    let traced = shadows.is_some();
    let shaders =
        [linked_shader(lambert, traced, settings)?, linked_shader(glossy, traced, settings)?];
    LightGather::new(gpu, surfaces, camera, shaders, tables, shadows)
}
