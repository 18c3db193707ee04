//! Reading a grid of coefficients.
use glam::{Quat, Vec3};
use manylights_gpu::{Gpu, SurfaceRecord};
use manylights_interpolation::{Grid, Order, Pixels, Reading, Scheme, Settings};
use manylights_reflectance::{Damping, Form, Materials, Tables};
use manylights_scene::{Brdf, Lobe};
use std::time::Instant;

fn noise(i: usize) -> f32 {
    ((i as f64 * 0.754_877_666_246_692_8).fract() * 2.0 - 1.0) as f32
}

/// Seconds of all processors so far.
fn busy() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").expect("Linux");
    let fields: Vec<_> = text.rsplit(')').next().expect("fields").split_whitespace().collect();
    fields[11].parse::<f64>().expect("ticks") * 0.01
}

fn main() {
    let gpu = Gpu::new(None).expect("an adapter");
    println!("{:?}", gpu.report());
    let lambert = Brdf::lambert(Vec3::new(0.7, 0.5, 0.3));
    let grey =
        Brdf { f0: Vec3::splat(0.04), lobe: Lobe::Schlick { f90: 1.0 }, alpha: 0.25, ..lambert };
    let camera = Vec3::new(0.0, 0.0, 7.0);
    let (width, height) = (640, 360);
    let arguments: Vec<String> = std::env::args().collect();
    let chosen = |name: &str| arguments.len() < 2 || arguments.iter().any(|a| a == name);
    for brdf in [lambert, grey] {
        if !chosen(if brdf == lambert { "lambert" } else { "grey" }) {
            continue;
        }
        let surfaces: Vec<_> = (0..width * height)
            .map(|i| {
                let (x, y) = (
                    (i % width) as f32 / width as f32 * 2.0 - 1.0,
                    (i / width) as f32 / height as f32 * 2.0 - 1.0,
                );
                let z = 0.4 * (3.0 * x).sin() * (2.0 * y).cos() + 0.3 * x;
                let normal = Quat::from_rotation_x(0.5 * y) * Quat::from_rotation_y(x) * Vec3::Z;
                SurfaceRecord::new(Vec3::new(x, y, z), normal, brdf)
            })
            .collect();
        let on_gpu = gpu.storage("surfaces", &surfaces).expect("fits");
        let materials = Materials::new([brdf].into_iter());
        let kinds = materials.kinds();
        for bands in [5, 9] {
            for scheme in [Scheme::Trilinear, Scheme::Hermite] {
                if !chosen(&format!("{scheme:?}{bands}")) {
                    continue;
                }
                let grid = Grid::over([[-1.0; 3], [1.0; 3]], [8; 3]);
                let settings = Settings { grid, scheme, bands, kinds, order: Order::Plain };
                let data: Vec<[f32; 4]> = (0..settings.vectors() * grid.count())
                    .map(|i| [0, 1, 2, 3].map(|k| noise(4 * i + k)))
                    .collect();
                let coefficients = gpu.storage("coefficients", &data).expect("fits");
                let tables = if kinds.specular {
                    let lobes =
                        materials.lobe_records(Tables::shared(), bands, Form::Full, Damping::None);
                    vec![
                        gpu.storage("shapes", &materials.shape_records()).expect("fits"),
                        gpu.storage("lobes", &lobes).expect("fits"),
                    ]
                } else {
                    vec![]
                };
                let results = gpu.zeroed("results", 16 * surfaces.len() as u64).expect("fits");
                let pixels = Pixels {
                    surfaces: &on_gpu,
                    count: surfaces.len() as u32,
                    camera,
                    tables: &tables,
                    results: &results,
                };
                let mut pictures = Vec::new();
                for order in [Order::Plain, Order::Sorted] {
                    if !chosen(&format!("{order:?}")) {
                        continue;
                    }
                    let settings = Settings { order, ..settings };
                    let results = gpu.zeroed("results", 16 * surfaces.len() as u64).expect("fits");
                    let pixels = Pixels { results: &results, ..pixels };
                    let start = Instant::now();
                    let mut reading =
                        Reading::new(&gpu, &settings, &coefficients, &pixels).expect("kernel");
                    reading.add().expect("a run");
                    let first = start.elapsed().as_secs_f64();
                    let compiled = busy();
                    pictures.push(gpu.read::<[f32; 4]>(&results).expect("results"));
                    let best = (0..9)
                        .map(|_| {
                            let start = Instant::now();
                            let times = reading.add().expect("a run");
                            (start.elapsed().as_secs_f64(), times)
                        })
                        .min_by(|a, b| a.0.total_cmp(&b.0))
                        .expect("some");
                    let busy = (busy() - compiled) / 9.0;
                    print!("cpu {:.0} ms (compile {compiled:.1} s) ", busy * 1e3);
                    print!(
                        "specular {} bands {bands} {scheme:?}: {order:?} {:.1} ms (first {first:.2} s);",
                        kinds.specular,
                        1e3 * best.0
                    );
                    for time in &best.1 {
                        print!(" {} {:.1}", time.pass, 1e3 * time.seconds);
                    }
                    println!();
                }
                if pictures.len() < 2 {
                    continue;
                }
                let most = pictures[0].iter().flatten().fold(0.0_f32, |m, v| m.max(v.abs()));
                let off = pictures[0]
                    .iter()
                    .flatten()
                    .zip(pictures[1].iter().flatten())
                    .fold(0.0_f32, |m, (a, b)| m.max((a - b).abs()));
                println!("   differ by {:.1e}", off / most);
            }
        }
    }
}
