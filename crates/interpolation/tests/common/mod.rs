//! Surfaces in a grid of coefficients that are made up.

use std::sync::LazyLock;

use crate::tensor;
use glam::{Quat, Vec3};
use manylights_gpu::{Buffer, Gpu, SurfaceRecord};
use manylights_harmonics::count;
use manylights_interpolation::{
    Grid, GridCoefficients, Order, Pixels, Scheme, Settings, Storage, pack,
};
use manylights_reflectance::{Damping, Form, Materials, Tables};
use manylights_scene::{Brdf, Lobe, Measured};

pub(crate) static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

pub(crate) const SCHEMES: [Scheme; 4] =
    [Scheme::Trilinear, Scheme::Taylor, Scheme::HermiteFlat, Scheme::Hermite];

pub(crate) const CAMERA: Vec3 = Vec3::new(0.4, 3.0, 7.0);

pub(crate) fn lambertian() -> Brdf {
    Brdf::lambert(Vec3::new(0.7, 0.5, 0.3))
}

pub(crate) fn grey(roughness: f32) -> Brdf {
    let (f0, lobe) = (Vec3::splat(0.04), Lobe::Schlick { f90: 1.0 });
    Brdf { f0, lobe, alpha: roughness * roughness, ..lambertian() }
}

pub(crate) fn colored(roughness: f32) -> Brdf {
    Brdf { diffuse: Vec3::ZERO, f0: Vec3::new(0.9, 0.7, 0.4), ..grey(roughness) }
}

/// The exact Fresnel term.
pub(crate) fn dielectric() -> Brdf {
    let f0 = Vec3::new(0.05, 0.04, 0.03);
    Brdf { f0, lobe: Lobe::Dielectric { index: 1.43 }, ..grey(0.5) }
}

/// A synthetic measurement with a lobe of its own for each channel.
pub(crate) fn measured() -> Brdf {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("synthetic.bsdf");
    std::fs::write(&path, tensor::satin()).expect("can write");
    Measured::load(&path).expect("valid").brdf()
}

/// Numbers below 1 in size that repeat nowhere.
pub(crate) fn noise(i: usize) -> f32 {
    ((i as f64 * 0.754_877_666_246_692_8).fract() * 2.0 - 1.0) as f32
}

pub(crate) fn grid() -> Grid<f32> {
    Grid::over([[-1.0, -0.5, 0.25], [1.0, 1.0, 2.0]], [4, 3, 5])
}

pub(crate) fn settings(scheme: Scheme, bands: usize, brdfs: &[Brdf]) -> Settings {
    let kinds = Materials::new(brdfs.iter().copied()).kinds();
    Settings { grid: grid(), scheme, bands, kinds, order: Order::Plain, storage: Storage::F32 }
}

/// As light has them: the higher the band, the less is in it.
pub(crate) fn coefficients(settings: &Settings) -> Vec<[f32; 4]> {
    let vectors = settings.vectors();
    let each = vectors / count(settings.bands);
    let value = |vertex: usize, i: usize| {
        let degree = (i / each).isqrt();
        let scale = if i < each { 2.0 } else { 1.0 / (1.0 + degree as f32) };
        let values = [0, 1, 2, 3].map(|k| scale * noise(4 * (vertex * vectors + i) + k));
        if i < each { values.map(|value| value + 3.0) } else { values }
    };
    let vertices = 0..settings.grid.count();
    vertices.flat_map(|vertex| (0..vectors).map(move |i| value(vertex, i))).collect()
}

/// The same on the adapter, packed.
pub(crate) fn packed(settings: &Settings, light: &[[f32; 4]]) -> Buffer {
    let buffer = GPU.storage("coefficients", light).expect("it fits");
    let Settings { grid, bands, scheme, .. } = *settings;
    let projected = GridCoefficients { grid, bands, gradients: scheme.reads_gradients(), buffer };
    pack(&GPU, &projected).expect("a run").0
}

/// Points all over the grid, on its vertices, edges and faces, and outside, of each reflectance in turn.
pub(crate) fn surfaces(brdfs: &[Brdf]) -> Vec<SurfaceRecord> {
    let grid = grid();
    let least = Vec3::from(grid.origin);
    let cells = Vec3::from(grid.vertices.map(|count| count as f32 - 1.0));
    let spacing = Vec3::from(grid.spacing);
    let inside = (0..40)
        .map(|i| 0.5 * (Vec3::new(noise(3 * i), noise(3 * i + 1), noise(3 * i + 2)) + 1.0) * cells);
    let special = [
        [0.0, 0.0, 0.0],
        [1.0, 1.0, 1.0],
        [3.0, 2.0, 4.0],
        [2.0, 0.3, 4.0],
        [1.0, 2.0, 2.5],
        [0.4, 1.0, 0.7],
        [-0.5, 0.3, 1.1],
        [1.5, 2.7, 9.0],
    ];
    let places = inside.chain(special.map(Vec3::from));
    let mut surfaces: Vec<_> = places
        .enumerate()
        .map(|(i, place)| {
            let position = least + place * spacing;
            let turn =
                Quat::from_rotation_y(2.4 * i as f32) * Quat::from_rotation_x(0.1 * i as f32);
            let normal = turn * Vec3::Y;
            let facing = if normal.dot(CAMERA - position) < 0.0 { -normal } else { normal };
            SurfaceRecord::new(position, facing.normalize(), brdfs[i % brdfs.len()])
        })
        .collect();
    surfaces[5].triangle = SurfaceRecord::NO_TRIANGLE;
    // Of these lie outside.
    assert_eq!(surfaces.len(), 48);
    surfaces
}

/// Of [`surfaces`].
pub(crate) const OUTSIDE: u32 = 2;

/// What a reading by `read` gives, and how many pixels are outside.
pub(crate) fn on_adapter(
    settings: &Settings,
    brdfs: &[Brdf],
    surfaces: &[SurfaceRecord],
    read: impl Fn(&Pixels<'_>) -> u32,
) -> (Vec<[f32; 4]>, u32) {
    let materials = Materials::new(brdfs.iter().copied());
    let buffer = |name: &str, records: &[[f32; 2]]| GPU.storage(name, records).expect("it fits");
    let mut tables = Vec::new();
    if settings.kinds.specular {
        let lobes =
            materials.lobe_records(Tables::shared(), settings.bands, Form::Full, Damping::None);
        tables = vec![buffer("shapes", &materials.shape_records()), buffer("lobes", &lobes)];
    }
    let on_gpu = GPU.storage("surfaces", surfaces).expect("it fits");
    let results = GPU.zeroed("results", 16 * surfaces.len() as u64).expect("it fits");
    let outside = read(&Pixels {
        surfaces: &on_gpu,
        count: surfaces.len() as u32,
        camera: CAMERA,
        tables: &tables,
        results: &results,
    });
    (GPU.read(&results).expect("results"), outside)
}
