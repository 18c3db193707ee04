//! Reading a grid of coefficients, pixel by pixel and cell by cell, at 640 × 360 pixels of a bent surface in 8³
//! vertices, written to `results/throughput/interpolation.md`. Run with
//! `cargo run --release -p manylights-tests --example grid_reading`, and the commit as its argument.

use std::time::Instant;

use glam::{Quat, Vec3};
use manylights_gpu::{Gpu, PassTime, SurfaceRecord};
use manylights_harmonics::count;
use manylights_interpolation::{
    Grid, GridCoefficients, Order, Pixels, Reading, Scheme, Settings, Storage, pack,
};
use manylights_reflectance::{Damping, Form, Materials, Tables, diffuse};
use manylights_scene::{Brdf, Lobe};
use manylights_tests::{page, processors};

const WIDTH: u32 = 640;
const HEIGHT: u32 = 360;
const PIXELS: u32 = WIDTH * HEIGHT;
const ROUNDS: u32 = 9;

/// Operations per second of a processor in single precision, measured (`results/throughput/area-light-products.md`).
const PEAK: f64 = 80e9;

fn main() {
    let gpu = Gpu::new(None).expect("an adapter");
    let commit = std::env::args().nth(1).unwrap_or_else(|| "unknown".to_owned());
    let mut text = format!(
        "# Reading a grid of coefficients\n\n\
         `cargo run --release -p manylights-tests --example grid_reading` on {}, {}, two cores; commit {commit}.\n\n\
         230 400 pixels of a bent surface, 8³ vertices. `Plain`: each pixel by itself, its corners from storage. \
         `Sorted`: pixels sorted by cell (counted and scattered on the adapter, the sums between by the host), the \
         corners of cells that have pixels assembled in blocks of uniform memory, one dispatch a cell. `Packed`: in \
         half precision, gradients in 8 bits. Best of {ROUNDS} rounds, all ways in turn: wall clock, and the time of \
         all processors together (the mean), of which are the ratio and the share of the peak. `first` has compilation \
         in it, where the driver has no kernel cached. Errors are relative to plain reading in single precision.\n\n\
         | receivers | bands | scheme | storage | order | kB | first s | ms | of processors | ratio | % of peak | error \
         | passes ms |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        gpu.report().name,
        gpu.report().driver_info,
    );
    let lambert = Brdf::lambert(Vec3::new(0.7, 0.5, 0.3));
    let (f0, lobe) = (Vec3::splat(0.04), Lobe::Schlick { f90: 1.0 });
    let glossy = Brdf { f0, lobe, alpha: 0.25, ..lambert };
    for (name, brdf) in [("Lambertian", lambert), ("glossy", glossy)] {
        for bands in [5, 9] {
            for scheme in [Scheme::Trilinear, Scheme::Hermite] {
                text += &compare(&gpu, (name, brdf), bands, scheme);
            }
        }
    }
    page::write("results/throughput/interpolation.md", &text);
}

/// One way of reading a grid, and how it went.
struct Measured {
    order: Order,
    storage: Storage,
    bytes: u64,
    reading: Reading,
    radiance: Vec<[f32; 4]>,
    first: f64,
    best: f64,
    of_processors: f64,
    passes: String,
}

fn compare(gpu: &Gpu, (name, brdf): (&str, Brdf), bands: usize, scheme: Scheme) -> String {
    let materials = Materials::new([brdf].into_iter());
    let grid = Grid::over([[-1.0; 3], [1.0; 3]], [8; 3]);
    let kinds = materials.kinds();
    let (order, storage) = (Order::Plain, Storage::F32);
    let settings = Settings { grid, scheme, bands, kinds, order, storage };
    let gradients = scheme.reads_gradients();
    let buffer = gpu.storage("coefficients", &light(&settings)).expect("it fits");
    let single = GridCoefficients { grid, bands, gradients, buffer };
    let packed = pack(gpu, &single).expect("a run").0;
    let surfaces = gpu.storage("surfaces", &surfaces(brdf)).expect("it fits");
    let mut tables = Vec::new();
    if kinds.specular {
        let lobes = materials.lobe_records(Tables::shared(), bands, Form::Full, Damping::None);
        tables.push(gpu.storage("shapes", &materials.shape_records()).expect("it fits"));
        tables.push(gpu.storage("lobes", &lobes).expect("it fits"));
    }
    let measured = |order, storage| {
        let settings = Settings { order, storage, ..settings };
        let coefficients = if storage == Storage::F32 { &single.buffer } else { &packed };
        let results = gpu.zeroed("results", 16 * u64::from(PIXELS)).expect("it fits");
        let (camera, surfaces) = (Vec3::new(0.0, 0.0, 7.0), &surfaces);
        let (tables, results) = (&tables[..], &results);
        let pixels = Pixels { surfaces, count: PIXELS, camera, tables, results };
        let start = Instant::now();
        let mut reading = Reading::new(gpu, &settings, coefficients, &pixels).expect("kernels");
        reading.add().expect("a run");
        Measured {
            order,
            storage,
            bytes: (16 * settings.stored_vectors() * grid.count()) as u64,
            reading,
            first: start.elapsed().as_secs_f64(),
            radiance: gpu.read(results).expect("radiance"),
            best: f64::INFINITY,
            of_processors: 0.0,
            passes: String::new(),
        }
    };
    let mut ways = Vec::new();
    for storage in [Storage::F32, Storage::Packed] {
        ways.extend([Order::Plain, Order::Sorted].map(|order| measured(order, storage)));
    }
    for _ in 0..ROUNDS {
        ways.iter_mut().for_each(read_again);
    }
    let operations = operations(&settings);
    let line = |way: &Measured| {
        let Measured { order, storage, bytes, first, best, of_processors, ref passes, .. } = *way;
        format!(
            "| {name} | {bands} | {scheme:?} | {storage:?} | {order:?} | {} | {first:.1} | {:.1} | {:.0} | {:.1} | {:.0} \
             | {:.0e} | {passes} |\n",
            bytes / 1000,
            1e3 * best,
            1e3 * of_processors,
            ways[0].of_processors / of_processors,
            100.0 * operations / (PEAK * of_processors),
            difference(&way.radiance, &ways[0].radiance),
        )
    };
    ways.iter().map(line).collect()
}

fn read_again(way: &mut Measured) {
    // Sorting is a part of reading.
    way.reading.move_surfaces();
    let (start, before) = (Instant::now(), processors::seconds(true));
    let times = way.reading.add().expect("a run");
    way.of_processors += (processors::seconds(true) - before) / f64::from(ROUNDS);
    let seconds = start.elapsed().as_secs_f64();
    if seconds < way.best {
        way.best = seconds;
        let pass = |time: &PassTime| format!("{} {:.1}", time.pass, 1e3 * time.seconds);
        way.passes = times.iter().map(pass).collect::<Vec<_>>().join(", ");
    }
}

/// Of all pixels' lobes with all corners, two for a number that is multiplied and added.
fn operations(settings: &Settings) -> f64 {
    let lambertian = diffuse::lobes(settings.bands, Damping::None);
    let is_used = |i: &usize| settings.kinds.specular || lambertian[i.isqrt()][0] != 0.0;
    let coefficients = (0..count(settings.bands)).filter(is_used).count();
    let numbers = if settings.scheme.reads_gradients() { 4 } else { 1 };
    (2 * 8 * coefficients * 3 * numbers) as f64 * f64::from(PIXELS)
}

/// Over the norm of what it is compared with.
fn difference(radiance: &[[f32; 4]], truth: &[[f32; 4]]) -> f64 {
    let (radiance, truth) = (radiance.as_flattened(), truth.as_flattened());
    let squares = |values: &mut dyn Iterator<Item = f32>| -> f64 {
        values.map(|value| f64::from(value).powi(2)).sum()
    };
    let error = squares(&mut radiance.iter().zip(truth).map(|(a, b)| a - b));
    (error / squares(&mut truth.iter().copied())).sqrt()
}

/// As lights have them: the higher the band, the less is in it; derivatives a tenth of values.
fn light(settings: &Settings) -> Vec<[f32; 4]> {
    let (vectors, gradients) = (settings.vectors(), settings.scheme.reads_gradients());
    let vector = |k: usize| {
        let i = (k % vectors) / if gradients { 3 } else { 1 };
        let parts = [0, 1, 2, 3].map(|j| noise(4 * k + j) / (1.0 + i.isqrt() as f32));
        let [value, x, y, z] = if i == 0 { parts.map(|part| part + 3.0) } else { parts };
        if gradients { [value, 0.1 * x, 0.1 * y, 0.1 * z] } else { [value, x, y, 0.0] }
    };
    (0..vectors * settings.grid.count()).map(vector).collect()
}

fn surfaces(brdf: Brdf) -> Vec<SurfaceRecord> {
    let place = |i: u32, size: u32| 2.0 * (i as f32 + 0.5) / size as f32 - 1.0;
    let surface = |i: u32| {
        let (x, y) = (place(i % WIDTH, WIDTH), place(i / WIDTH, HEIGHT));
        let z = 0.4 * (3.0 * x).sin() * (2.0 * y).cos() + 0.3 * x;
        let normal = Quat::from_rotation_x(0.5 * y) * Quat::from_rotation_y(x) * Vec3::Z;
        SurfaceRecord::new(Vec3::new(x, y, z), normal, brdf)
    };
    (0..PIXELS).map(surface).collect()
}

fn noise(i: usize) -> f32 {
    ((i as f64 * 0.754_877_666_246_692_8).fract() * 2.0 - 1.0) as f32
}
