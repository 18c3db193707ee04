//! Texels of reflective shadow maps with the light that they reflect, for methods that filter many
//! texels into one virtual light.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{Binding, Buffer, Error, GpuFrame, Module, PassTime, Resource, link};
use manylights_scene::Light;

use crate::rsm::Map;

/// The WESL module `lit_texel`: how kernels read a [`LitTexel`].
pub const LIT_TEXEL: Module<'static> = ("lit_texel", include_str!("shaders/lit_texel.wesl"));

/// What light does at a texel, beside its surface, as `shaders/lit_texel.wesl` lays it out. Each field
/// is that of [`VirtualLight`](crate::VirtualLight), made on the adapter.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct LitTexel {
    /// Incident flux, W, times n_s·ω / n_g·ω; zero where nothing is lit.
    pub flux: Vec3,
    /// Variance of the patch that the texel stands for, m²: half of that in its plane, so a square of
    /// area A that faces the light has A/12.
    pub variance: f32,
    /// Unit direction to the primary light.
    pub incoming: Vec3,
    /// Unused.
    pub padding0: f32,
    /// Unit normal of the triangle, on the lit side.
    pub geometric_normal: Vec3,
    /// Unused.
    pub padding1: f32,
}

/// A map on the adapter, row-major.
pub struct LitTexels {
    /// `array<Surface>`.
    pub surfaces: Buffer,
    /// `array<LitTexel>`.
    pub texels: Buffer,
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct PrimaryLight {
    intensity: Vec3,
    outer: f32,
    direction: Vec3,
    ramp: f32,
}

/// Renders a map: what each of its cells sees and reflects. Cells without flux or surface have no flux.
///
/// # Errors
/// Where the map exceeds what the adapter holds.
pub fn lit_texels(frame: &GpuFrame, map: &Map) -> Result<(LitTexels, Vec<PassTime>), Error> {
    let gpu = frame.gpu();
    let (surfaces, mut times) = frame.rasterise(&map.projection)?;
    let [width, height] = map.projection.resolution;
    let size = u64::from(width) * u64::from(height) * size_of::<LitTexel>() as u64;
    let texels = gpu.zeroed("lit texels", size)?;
    let projection = gpu.uniform("projection", &map.projection)?;
    let light = gpu.uniform("primary light", &PrimaryLight::new(&map.light))?;
    let wgsl = link("lit_texels", include_str!("shaders/lit_texels.wesl"), &[LIT_TEXEL], &[])?;
    let mut bindings = vec![Binding::Uniform; 2];
    bindings.extend([Binding::Storage; 3]);
    bindings.push(Binding::StorageMut);
    let kernel = gpu.kernel("lit texels", &wgsl, &bindings)?;
    let (vertices, triangles) = (frame.vertices(), frame.triangles());
    let buffers = [&projection, &light, vertices, triangles, &surfaces, &texels];
    let pass = gpu.pass("light texels", &kernel, &buffers.map(Resource::Buffer))?;
    times.extend(gpu.run(&[pass.over([width.div_ceil(64), height, 1])])?);
    // To a method they are one pass.
    let times = times.into_iter().map(|time| PassTime { pass: "distribute", ..time }).collect();
    Ok((LitTexels { surfaces, texels }, times))
}

impl PrimaryLight {
    fn new(light: &Light) -> Self {
        match *light {
            Light::Point { intensity, .. } => Self { intensity, ..Self::zeroed() },
            Light::Spot { direction, intensity, inner, outer, .. } => {
                let (inner, outer) = (inner.cos(), outer.cos());
                // As `spot_falloff` bounds it.
                let ramp = 1.0 / (inner - outer).max(1e-4);
                Self { intensity, outer, direction, ramp }
            }
            Light::Directional { irradiance, .. } => {
                Self { intensity: irradiance, ..Self::zeroed() }
            }
        }
    }
}
