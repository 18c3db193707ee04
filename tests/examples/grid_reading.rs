//! Reading a grid of coefficients, pixel by pixel and cell by cell, at 640 × 360 pixels of a bent surface in 8³
//! vertices. A row each: best of nine, both orders in turn, in milliseconds of wall clock with all that sorting
//! takes, and of all processors, where Linux tells.

use std::time::Instant;

use glam::{Quat, Vec3};
use manylights_gpu::{Gpu, SurfaceRecord};
use manylights_interpolation::{Grid, Order, Pixels, Reading, Scheme, Settings};
use manylights_reflectance::{Damping, Form, Materials, Tables};
use manylights_scene::{Brdf, Lobe};

const WIDTH: u32 = 640;
const HEIGHT: u32 = 360;
const ROUNDS: u32 = 9;

fn main() {
    let gpu = Gpu::new(None).expect("an adapter");
    println!("{}, {}", gpu.report().name, gpu.report().driver_info);
    println!(
        "| receivers | bands | scheme | order | first s | ms | of processors | ratio | passes ms |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let lambert = Brdf::lambert(Vec3::new(0.7, 0.5, 0.3));
    let (f0, lobe) = (Vec3::splat(0.04), Lobe::Schlick { f90: 1.0 });
    let glossy = Brdf { f0, lobe, alpha: 0.25, ..lambert };
    for (name, brdf) in [("Lambertian", lambert), ("glossy", glossy)] {
        for bands in [5, 9] {
            for scheme in [Scheme::Trilinear, Scheme::Hermite] {
                compare(&gpu, (name, brdf), bands, scheme);
            }
        }
    }
}

fn compare(gpu: &Gpu, (name, brdf): (&str, Brdf), bands: usize, scheme: Scheme) {
    let materials = Materials::new([brdf].into_iter());
    let grid = Grid::over([[-1.0; 3], [1.0; 3]], [8; 3]);
    let kinds = materials.kinds();
    let settings = Settings { grid, scheme, bands, kinds, order: Order::Plain };
    let numbers = settings.vectors() * grid.count();
    let light: Vec<_> = (0..numbers).map(|i| [0, 1, 2, 3].map(|k| noise(4 * i + k))).collect();
    let coefficients = gpu.storage("coefficients", &light).expect("it fits");
    let surfaces = gpu.storage("surfaces", &surfaces(brdf)).expect("it fits");
    let mut tables = Vec::new();
    if kinds.specular {
        let lobes = materials.lobe_records(Tables::shared(), bands, Form::Full, Damping::None);
        tables.push(gpu.storage("shapes", &materials.shape_records()).expect("it fits"));
        tables.push(gpu.storage("lobes", &lobes).expect("it fits"));
    }
    let results = gpu.zeroed("results", 16 * u64::from(WIDTH * HEIGHT)).expect("it fits");
    let pixels = Pixels {
        surfaces: &surfaces,
        count: WIDTH * HEIGHT,
        camera: Vec3::new(0.0, 0.0, 7.0),
        tables: &tables,
        results: &results,
    };
    let mut readings = [Order::Plain, Order::Sorted].map(|order| {
        let start = Instant::now();
        let settings = Settings { order, ..settings };
        let mut reading = Reading::new(gpu, &settings, &coefficients, &pixels).expect("kernels");
        reading.add().expect("a run");
        (order, reading, start.elapsed().as_secs_f64(), f64::INFINITY, 0.0, String::new())
    });
    for _ in 0..ROUNDS {
        for (_, reading, _, best, busy, passes) in &mut readings {
            let (start, before) = (Instant::now(), of_processors());
            let times = reading.add().expect("a run");
            *busy += (of_processors() - before) / f64::from(ROUNDS);
            let seconds = start.elapsed().as_secs_f64();
            if seconds < *best {
                *best = seconds;
                let pass = |time: &manylights_gpu::PassTime| {
                    format!("{} {:.1}", time.pass, 1e3 * time.seconds)
                };
                *passes = times.iter().map(pass).collect::<Vec<_>>().join(", ");
            }
        }
    }
    let plain = readings[0].4;
    for (order, _, first, best, busy, passes) in &readings {
        println!(
            "| {name} | {bands} | {scheme:?} | {order:?} | {first:.1} | {:.1} | {:.0} | {:.1} | {passes} |",
            1e3 * best,
            1e3 * busy,
            plain / busy
        );
    }
}

fn surfaces(brdf: Brdf) -> Vec<SurfaceRecord> {
    let place = |i: u32, size: u32| 2.0 * (i as f32 + 0.5) / size as f32 - 1.0;
    let surface = |i: u32| {
        let (x, y) = (place(i % WIDTH, WIDTH), place(i / WIDTH, HEIGHT));
        let z = 0.4 * (3.0 * x).sin() * (2.0 * y).cos() + 0.3 * x;
        let normal = Quat::from_rotation_x(0.5 * y) * Quat::from_rotation_y(x) * Vec3::Z;
        SurfaceRecord::new(Vec3::new(x, y, z), normal, brdf)
    };
    (0..WIDTH * HEIGHT).map(surface).collect()
}

fn noise(i: usize) -> f32 {
    ((i as f64 * 0.754_877_666_246_692_8).fract() * 2.0 - 1.0) as f32
}

/// Seconds of this program on all processors so far: what others run besides does not move it.
fn of_processors() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let ticks = text.rsplit(')').next().and_then(|rest| rest.split_whitespace().nth(11));
    ticks.and_then(|ticks| ticks.parse::<f64>().ok()).map_or(f64::NAN, |ticks| 0.01 * ticks)
}
