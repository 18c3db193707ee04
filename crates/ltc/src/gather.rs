//! The kernel and what it reads.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_area_lights::{
    AreaGather, Edges, EstimatorShader, GatherShader, IRRADIANCE, merged,
};
use manylights_gpu::{Buffer, Error, Gpu, PointBindings, Table};
use manylights_reflectance::transformed_cosine::{self, TRANSFORMED_LOBES};
use manylights_reflectance::{MODULES, Materials, ReceiverKinds, SHAPES};
use manylights_scene::AreaLight;

/// Lights a batch.
const CAPACITY: usize = 512;

/// A light as the shader reads it: 64 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct LightRecord {
    /// Of a triangle, or a sphere's centre; metres.
    pub corner: Vec3,
    kind: f32,
    /// From the corner to the next one, metres.
    pub first: Vec3,
    /// Of a sphere, metres.
    pub radius: f32,
    /// From the corner to the last one, metres.
    pub second: Vec3,
    padding: f32,
    /// W·m⁻²·sr⁻¹.
    pub radiance: Vec3,
    last_padding: f32,
}

/// What a record is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A triangle that shines to its front.
    OneSided,
    /// A triangle that shines from both sides.
    TwoSided,
    /// A sphere.
    Sphere,
}

/// In the order of their numbers.
const KINDS: [Kind; 3] = [Kind::OneSided, Kind::TwoSided, Kind::Sphere];

impl LightRecord {
    /// Of a light.
    pub fn new(light: &AreaLight) -> Self {
        let record = |kind: Kind, corner, [first, second]: [Vec3; 2], radius, radiance| Self {
            corner,
            kind: kind as u8 as f32,
            first,
            radius,
            second,
            padding: 0.0,
            radiance,
            last_padding: 0.0,
        };
        match *light {
            AreaLight::Sphere { center, radius, radiance } => {
                record(Kind::Sphere, center, [Vec3::ZERO; 2], radius, radiance)
            }
            AreaLight::Triangle { corners: [a, b, c], radiance, two_sided } => {
                let kind = if two_sided { Kind::TwoSided } else { Kind::OneSided };
                record(kind, a, [b - a, c - a], 0.0, radiance)
            }
        }
    }

    /// Of all lights, or of the fewest that shine as their triangles do.
    pub fn all(lights: &[AreaLight], edges: Edges) -> Vec<Self> {
        match edges {
            Edges::Own => lights.iter().map(Self::new).collect(),
            Edges::Shared => merged(lights).iter().map(Self::new).collect(),
        }
    }

    /// What it is of.
    pub fn kind(&self) -> Kind {
        KINDS[self.kind as usize]
    }
}

/// The kinds of lights that a kernel must know.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LightKinds {
    /// Some are triangles.
    pub triangles: bool,
    /// Some are spheres.
    pub spheres: bool,
}

impl LightKinds {
    /// Of these; of none, as where all are black, triangles, so that there is a kernel.
    pub fn of(lights: &[LightRecord]) -> Self {
        let spheres = lights.iter().filter(|light| light.kind() == Kind::Sphere).count();
        Self { triangles: spheres == 0 || spheres < lights.len(), spheres: spheres > 0 }
    }
}

/// The kernel for these lights and receivers of the given lobes.
///
/// # Errors
/// Where the shader does not link.
pub fn linked_shader(kinds: ReceiverKinds, lights: LightKinds) -> Result<GatherShader, Error> {
    let lobe = transformed_cosine::module();
    let own = [("transformed_cosine", &*lobe)];
    EstimatorShader {
        estimator: include_str!("shaders/transformed.wesl"),
        modules: &[&own[..], &IRRADIANCE, &MODULES].concat(),
        features: &[
            ("glossy_receivers", kinds.specular),
            ("triangles", lights.triangles),
            ("spheres", lights.spheres),
            // Declined.
            ("exact_fresnel", false),
            ("measured", false),
        ],
        capacity: CAPACITY,
        bindings: PointBindings { settings: &[], tables: table_names(kinds) },
    }
    .link()
}

/// Those of [`tables`].
fn table_names(kinds: ReceiverKinds) -> Vec<Table> {
    let shapes = Table { name: SHAPES, element: "vec2f" };
    let lobes = Table { name: TRANSFORMED_LOBES, element: "vec4f" };
    if kinds.specular { vec![shapes, lobes] } else { Vec::new() }
}

/// What kernels read, on the adapter, as [`table_names`] has it.
///
/// # Errors
/// Where the adapter refuses.
pub(crate) fn tables(gpu: &Gpu, materials: &Materials) -> Result<Vec<Buffer>, Error> {
    if !materials.kinds().specular {
        return Ok(Vec::new());
    }
    let shapes = gpu.storage("shapes", &materials.shape_records())?;
    Ok(vec![shapes, gpu.storage("lobes", &materials.transformed_records())?])
}

/// Radiance of given surfaces under given lights, by the adapter's kernels: what a picture does, for hard
/// cases that no scene brings about; nothing is declined.
///
/// # Errors
/// Where the adapter refuses.
pub fn gather(
    gpu: &Gpu,
    surfaces: &[manylights_gpu::SurfaceRecord],
    camera: Vec3,
    lights: &[LightRecord],
) -> Result<Vec<[f32; 3]>, Error> {
    let materials = Materials::new(surfaces.iter().map(|surface| surface.brdf()));
    let shader = linked_shader(materials.kinds(), LightKinds::of(lights))?;
    let tables = tables(gpu, &materials)?;
    let on_gpu = gpu.storage("surfaces", surfaces)?;
    let gather = AreaGather::new(gpu, (&on_gpu, surfaces.len() as u32), camera, &shader, tables)?;
    let batches = gather.batches(lights)?;
    gather.add(&batches, 0..batches.count())?;
    gather.radiance()
}
