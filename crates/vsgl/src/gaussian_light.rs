//! Virtual spherical Gaussian lights, filtered from the texels of reflective shadow maps.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{
    Binding, Buffer, Error, Gpu, GpuFrame, PassTime, Reflectances, Resource, SurfaceRecord, link,
};
use manylights_scene::{Brdf, Scene};
use manylights_virtual_lights::{LIT_TEXEL, LitTexel, LitTexels, Map, lit_texels};

use crate::albedo::{ALBEDOS, albedos, exact_lobes};
use crate::{Approximation, Settings};

/// One spherical Gaussian that emits from a cloud of places, as `shaders/filter.wesl` writes it.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct GaussianLobe {
    /// Mean place, metres.
    pub position: Vec3,
    /// Variance of the places along one axis, m².
    pub variance: f32,
    /// Unit direction of emission.
    pub axis: Vec3,
    /// Sharpness of the emission.
    pub sharpness: f32,
    /// Emitted power, W; zero for a lobe that is not there.
    pub power: Vec3,
    /// Unused.
    pub padding: f32,
}

/// The lit texel of a group that is nearest to its mean place.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct FilteredCenter {
    position: Vec3,
    padding0: f32,
    geometric_normal: Vec3,
    padding1: f32,
}

/// What stands for one group of texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianLight {
    /// Of the Lambertian lobes.
    pub diffuse: GaussianLobe,
    /// Of the specular lobes.
    pub specular: GaussianLobe,
    /// The lit texel that is nearest to the mean place, metres: what shadow rays aim at, since the mean
    /// place may be inside a convex body.
    pub center: Vec3,
    /// Unit normal of that texel's triangle, on the lit side.
    pub geometric_normal: Vec3,
}

impl GaussianLight {
    /// Whether it has a specular lobe.
    pub fn has_specular(&self) -> bool {
        self.specular.power != Vec3::ZERO
    }
}

/// What the filter must know of the materials of its texels.
#[derive(Clone)]
pub(crate) struct Materials {
    pub(crate) kinds: Reflectances,
    /// What the filter reads, on the adapter.
    tables: Vec<Buffer>,
    /// Tables that were made: an exact lobe has one of its own.
    pub(crate) count: u64,
}

impl Materials {
    pub(crate) fn of_scene(gpu: &Gpu, scene: &Scene) -> Result<Self, Error> {
        let brdfs = scene.materials.iter().map(|material| material.brdf(material.base_color));
        Self::of(gpu, brdfs, albedos)
    }

    fn of(
        gpu: &Gpu,
        brdfs: impl Iterator<Item = Brdf> + Clone,
        albedos: impl FnOnce() -> Vec<[f32; 2]>,
    ) -> Result<Self, Error> {
        let kinds = Reflectances::of(brdfs.clone());
        let (mut tables, mut count) = (Vec::new(), 0);
        if kinds.specular {
            tables.push(gpu.storage("albedos", &albedos())?);
            count += 1;
        }
        if kinds.exact_fresnel {
            let lobes = exact_lobes(brdfs);
            tables.push(gpu.storage("exact lobes", &lobes)?);
            count += lobes.len() as u64;
        }
        Ok(Self { kinds, tables, count })
    }
}

/// The WGSL of the filter for texels of the given reflectances.
///
/// # Errors
/// Where the shader does not link.
pub fn filter_shader(kinds: &Reflectances, lobe: Approximation) -> Result<String, Error> {
    let modules = [LIT_TEXEL, ("emission", include_str!("shaders/emission.wesl"))];
    let of_method = [("specular", kinds.specular), ("thesis", lobe == Approximation::Thesis)];
    let features = [&of_method[..], &kinds.features()].concat();
    link("filter", include_str!("shaders/filter.wesl"), &modules, &features)
}

/// The lights that a picture with these maps uses, and the passes that made them. Groups that emit nothing are left
/// out.
///
/// # Errors
/// Where the maps exceed what the adapter holds.
pub fn gaussian_lights(
    frame: &GpuFrame,
    scene: &Scene,
    maps: &[Map],
    settings: &Settings,
) -> Result<(Vec<GaussianLight>, Vec<PassTime>), Error> {
    let materials = Materials::of_scene(frame.gpu(), scene)?;
    lights_of_materials(frame, maps, &materials, settings)
}

/// [`gaussian_lights`] of a scene whose materials are known.
pub(crate) fn lights_of_materials(
    frame: &GpuFrame,
    maps: &[Map],
    materials: &Materials,
    settings: &Settings,
) -> Result<(Vec<GaussianLight>, Vec<PassTime>), Error> {
    let mut lights = Vec::new();
    let mut times = Vec::new();
    for map in maps {
        let (texels, passes) = lit_texels(frame, &map.refined(settings.texels))?;
        times.extend(passes);
        let groups = map.projection.resolution;
        let (filtered, time) = filter(frame.gpu(), &texels, groups, settings, materials)?;
        times.extend(time);
        lights.extend(filtered.into_iter().flatten());
    }
    Ok((lights, times))
}

/// The light of one group of texels, by the adapter's kernel: for hard cases that no scene brings about.
///
/// # Errors
/// Where the adapter refuses.
///
/// # Panics
/// Where the texels are no square.
pub fn filter_group(
    gpu: &Gpu,
    texels: &[(SurfaceRecord, LitTexel)],
    lobe: Approximation,
) -> Result<Option<GaussianLight>, Error> {
    let side = texels.len().isqrt();
    assert_eq!(side * side, texels.len(), "a group is a square of texels");
    let (surfaces, lit): (Vec<_>, Vec<_>) = texels.iter().copied().unzip();
    let brdfs = surfaces.iter().map(SurfaceRecord::brdf);
    let materials = Materials::of(gpu, brdfs, || ALBEDOS.clone())?;
    let texels = LitTexels {
        surfaces: gpu.storage("surfaces", &surfaces)?,
        texels: gpu.storage("lit texels", &lit)?,
    };
    let settings = Settings { texels: side as u32, lobe, ..Settings::default() };
    let (lights, _) = filter(gpu, &texels, [1, 1], &settings, &materials)?;
    Ok(lights.into_iter().flatten().next())
}

/// One light for each group of texels.
fn filter(
    gpu: &Gpu,
    map: &LitTexels,
    groups: [u32; 2],
    settings: &Settings,
    materials: &Materials,
) -> Result<(Vec<Option<GaussianLight>>, Vec<PassTime>), Error> {
    let kinds = if materials.kinds.specular { 2 } else { 1 };
    let count = groups[0] as usize * groups[1] as usize;
    let lobes = gpu.zeroed("lobes", (count * kinds * size_of::<GaussianLobe>()) as u64)?;
    let centers = gpu.zeroed("centers", (count * size_of::<FilteredCenter>()) as u64)?;
    let sides = gpu.uniform("groups", &[settings.texels, 0, 0, 0])?;
    let mut bindings = vec![Binding::Uniform, Binding::Storage, Binding::Storage];
    bindings.extend([Binding::StorageMut; 2]);
    let mut buffers: Vec<&Buffer> = vec![&sides, &map.surfaces, &map.texels, &lobes, &centers];
    bindings.resize(bindings.len() + materials.tables.len(), Binding::Storage);
    buffers.extend(&materials.tables);
    let kernel =
        gpu.kernel("filter", &filter_shader(&materials.kinds, settings.lobe)?, &bindings)?;
    let resources: Vec<_> = buffers.into_iter().map(Resource::Buffer).collect();
    let pass = gpu.pass("filter", &kernel, &resources)?;
    let times = gpu.run(&[pass.over([groups[0], groups[1], 1])])?;
    let lobes: Vec<GaussianLobe> = gpu.read(&lobes)?;
    let centers: Vec<FilteredCenter> = gpu.read(&centers)?;
    let light = |(group, center): (&[GaussianLobe], &FilteredCenter)| {
        let specular = group.get(1).copied().unwrap_or_else(GaussianLobe::zeroed);
        let FilteredCenter { position: center, geometric_normal, .. } = *center;
        let light = GaussianLight { diffuse: group[0], specular, center, geometric_normal };
        let emits = light.has_specular() || light.diffuse.power != Vec3::ZERO;
        emits.then_some(light)
    };
    Ok((lobes.chunks_exact(kinds).zip(&centers).map(light).collect(), times))
}
