//! Radiance of pixels from a grid of coefficients, on the adapter.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::{UVec3, Vec3};
use manylights_gpu::{
    Binding, Buffer, Error, Gpu, Kernel, Pass, PassTime, Resource, link, workgroups,
};
use manylights_harmonics::count;
use manylights_harmonics::wgsl::{self, Function};
use manylights_reflectance::{
    Damping, Form, LOBES, MODULES, ReceiverKinds, SHAPES, diffuse, lobe_wgsl,
};

use crate::bindings::Bindings;
use crate::{Grid, Scheme, reading_wgsl};

/// Lanes of a workgroup.
const LANES: u32 = 64;

/// What is read, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Where the vertices are, in the world.
    pub grid: Grid<f32>,
    /// Between them.
    pub scheme: Scheme,
    /// Of the light and of the lobes.
    pub bands: usize,
    /// The lobes that pixels have.
    pub kinds: ReceiverKinds,
}

impl Settings {
    /// Of a vertex, each a `vec4f`, in the frame of the world. With gradients three for each of bands²
    /// coefficients, one a channel: the value, and its three derivatives times the grid's spacing. Without them
    /// one, of red, green, blue and nothing. Vertices are in the order of the grid.
    pub fn vectors(&self) -> usize {
        let each = if self.scheme.reads_gradients() { 3 } else { 1 };
        each * count(self.bands)
    }
}

/// Pixels, and what is there.
pub struct Pixels<'a> {
    /// What each sees; the first `count` are read.
    pub surfaces: &'a Buffer,
    /// Their number.
    pub count: u32,
    /// From where, metres.
    pub camera: Vec3,
    /// The tables of the lobes, [`SHAPES`] and [`LOBES`], where there are specular ones.
    pub tables: &'a [Buffer],
    /// Radiance, a `vec4f` each, W·m⁻²·sr⁻¹: what is read is added.
    pub results: &'a Buffer,
}

/// As `view` in the shaders.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct View {
    camera: Vec3,
    pixels: u32,
    origin: Vec3,
    padding: u32,
    per_metre: Vec3,
    more_padding: u32,
    cells: UVec3,
    last_padding: u32,
}

const VIEW: &str = "struct View {\n    camera: vec3f,\n    pixels: u32,\n    origin: vec3f,\n    \
                    per_metre: vec3f,\n    cells: vec3u,\n}\n";

impl View {
    fn new(grid: &Grid<f32>, pixels: &Pixels<'_>) -> Self {
        Self {
            camera: pixels.camera,
            pixels: pixels.count,
            origin: grid.origin.into(),
            per_metre: grid.spacing.map(f32::recip).into(),
            cells: grid.vertices.map(|vertices| vertices as u32 - 1).into(),
            padding: 0,
            more_padding: 0,
            last_padding: 0,
        }
    }
}

/// Each pixel by itself.
pub struct Reading {
    gpu: Gpu,
    pass: Pass,
    workgroups: [u32; 3],
    outside: Buffer,
}

impl Reading {
    /// Of `coefficients` as [`Settings::vectors`] has them.
    ///
    /// # Errors
    /// Where the adapter refuses the kernel or a buffer.
    pub fn new(
        gpu: &Gpu,
        settings: &Settings,
        coefficients: &Buffer,
        pixels: &Pixels<'_>,
    ) -> Result<Self, Error> {
        let view = gpu.uniform("view", &View::new(&settings.grid, pixels))?;
        let outside = gpu.zeroed("pixels outside", 4)?;
        let (wgsl, bindings) = plain_shader(settings)?;
        let kernel: Arc<Kernel> = gpu.kernel("read", &wgsl, &bindings)?;
        let mut resources = [&view, pixels.surfaces, pixels.results, &outside, coefficients]
            .map(Resource::Buffer)
            .to_vec();
        resources.extend(pixels.tables.iter().map(Resource::Buffer));
        let pass = gpu.pass("read", &kernel, &resources)?;
        Ok(Self { gpu: gpu.clone(), pass, workgroups: workgroups(pixels.count, LANES), outside })
    }

    /// Adds what all pixels reflect of the grid, and waits.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn add(&self) -> Result<Vec<PassTime>, Error> {
        self.gpu.run(&[self.pass.over(self.workgroups)])
    }

    /// How often a pixel was read whose point is outside of the grid: the nearest point of the grid stands for it.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn outside(&self) -> Result<u32, Error> {
        Ok(self.gpu.read::<u32>(&self.outside)?[0])
    }
}

/// The kernel that reads each pixel by itself, and what it binds.
///
/// # Errors
/// Where the shader does not link.
pub fn plain_shader(settings: &Settings) -> Result<(String, Vec<Binding>), Error> {
    let mut bindings = vec![
        (Binding::Uniform, "view: View"),
        (Binding::Storage, "surfaces: array<Surface>"),
        (Binding::StorageMut, "pixels: array<vec4f>"),
        (Binding::StorageMut, "outside: atomic<u32>"),
        (Binding::Storage, "coefficients: array<Vertex>"),
    ];
    let tables = [SHAPES, LOBES].map(|name| format!("{name}: array<vec2f>"));
    if settings.kinds.specular {
        bindings.extend(tables.iter().map(|table| (Binding::Storage, &**table)));
    }
    let bindings = Bindings(bindings);
    let vertex =
        format!("struct Vertex {{\n    values: array<vec4f, {}>,\n}}\n", settings.vectors());
    let own = [("bindings", bindings.module(&format!("{VIEW}\n{vertex}")))];
    let wgsl = linked(settings, include_str!("shaders/plain.wesl"), "coefficients", &own)?;
    Ok((wgsl, bindings.layout()))
}

fn linked(
    settings: &Settings,
    entry: &str,
    source: &str,
    own: &[(&str, String)],
) -> Result<String, Error> {
    let Settings { scheme, bands, kinds, .. } = *settings;
    let gradients = scheme.reads_gradients();
    let made = [
        ("layout", format!("const LANES = {LANES}u;\n")),
        ("sh", wgsl::module(bands, &[Function::Evaluate, Function::SpreadEven])),
        ("diffuse", diffuse::module(bands, Damping::None)),
        ("lobe", lobe_wgsl::module(bands, Form::Full)),
        ("world_lobe", reading_wgsl::world_lobe(bands, kinds)),
        ("corner", reading_wgsl::corner(bands, kinds, gradients, source)),
    ];
    let mut modules: Vec<_> = made.iter().chain(own).map(|(name, text)| (*name, &**text)).collect();
    modules.extend(MODULES);
    modules.push(("place", include_str!("shaders/place.wesl")));
    modules.push(("weights", include_str!("shaders/weights.wesl")));
    let features = [
        ("gradients", gradients),
        ("hermite", matches!(scheme, Scheme::HermiteFlat | Scheme::Hermite)),
        ("mixed", scheme == Scheme::Hermite),
        // Kernels read the tables of harmonics alone.
        ("measured", false),
    ];
    let features = [&features[..], &kinds.features(Form::Full)].concat();
    link("read", entry, &modules, &features)
}
