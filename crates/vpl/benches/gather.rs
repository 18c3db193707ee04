//! Throughput of the gather, in pairs of light and pixel, by the adapter's own clock.
//!
//! The limit on two cores with lavapipe (256-bit vectors of 8 lanes): a pair with GGX receiver and
//! Lambertian light is about 75 additions and multiplications, 3 square roots and 2 divisions a lane;
//! at two vector operations a cycle and 4 to 6 cycles for each root and division that is some 60 to
//! 70 cycles for 8 pairs, so 2 cores of 2.7 GHz could reach 600 to 700 M pairs/s.
//!
//! Where the rest goes: lavapipe reads a uniform by a bounds-checked scalar load and a broadcast for
//! each component, some ten instructions for each of the 9 to 28 floats of a light. One pixel a lane
//! spends most of its time there; by the processor time of one run (M pairs/s on two cores),
//! Lambert/Lambert, GGX/Lambert, GGX/GGX: 1 pixel a lane 205/149/66, 2 pixels 419/227/86,
//! 4 pixels 406/290/127. That was for synthetic pairs that all see each other, by processor time; the
//! scenes of the table are timed by wall clock.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use manylights_gpu::{Gpu, GpuFrame};
use manylights_method::{Frame, Method, Parameters};
use manylights_scene::Material;
use manylights_scene::{Transport, Visibility};
use manylights_virtual_lights::VirtualLights;
use manylights_vpl::Vpl;

const RESOLUTION: [u32; 2] = [256, 256];
const LIGHTS: u64 = 1024;

/// Adapter seconds of the gather passes, and the lights summed.
fn gather(frame: &Frame<'_>, parameters: &Parameters) -> (f64, u64) {
    let mut run = VirtualLights(Vpl).prepare(frame, parameters).expect("vpl renders the scene");
    while !run.step().expect("a step").finished() {}
    let seconds = run.pass_times().iter().find(|t| t.pass == "gather").map_or(0.0, |t| t.seconds);
    (seconds, run.counters()[0].1)
}

fn benchmark(criterion: &mut Criterion) {
    let gpu = Gpu::new(None).expect("an adapter");
    println!(
        "adapter: {} ({} {})",
        gpu.report().name,
        gpu.report().driver,
        gpu.report().driver_info
    );
    let lights = LIGHTS.to_string();
    let parameters =
        Parameters::new(VirtualLights(Vpl).parameters(), [("lights", &*lights)]).expect("in range");
    let mut group = criterion.benchmark_group("vpl gather");
    for (name, lobes) in [("cornell", "L/L"), ("cornell", "GGX/L"), ("trio", "GGX/GGX")] {
        let mut scene = manylights_scene::load(name, None).expect("built in");
        if lobes == "GGX/L" {
            // A material that no triangle has: the kernel knows GGX on all receivers, without a
            // branch, and all lights stay Lambertian.
            scene.materials.push(Material::glossy("unused", Vec3::ONE, 0.3));
        }
        let camera = &scene.cameras[0];
        let on_gpu = GpuFrame::new(&gpu, &scene, camera, RESOLUTION).expect("the scene fits");
        let frame = Frame {
            scene: &scene,
            camera,
            resolution: RESOLUTION,
            transport: Transport::Indirect { bounces: 1, visibility: Visibility::Ignored },
            seed: 0,
            gpu: Some(&on_gpu),
        };
        let (_, summed) = gather(&frame, &parameters);
        let pixels = u64::from(RESOLUTION[0]) * u64::from(RESOLUTION[1]);
        group.throughput(Throughput::Elements(summed * pixels)).sample_size(10);
        group.bench_function(BenchmarkId::new(name, lobes), |bencher| {
            bencher.iter_custom(|iterations| {
                let seconds: f64 = (0..iterations).map(|_| gather(&frame, &parameters).0).sum();
                Duration::from_secs_f64(seconds)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, benchmark);
criterion_main!(benches);
