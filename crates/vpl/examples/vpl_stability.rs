//! Hard cases of the gather: the adapter's f32 against the f64 oracle, written to
//! `results/stability/vpl.md`. Run with
//! `cargo run --release -p manylights-vpl --example vpl_stability`.

use std::fmt::Write as _;

use glam::{Quat, Vec3};
use manylights_gpu::{Gpu, SurfaceRecord, VirtualLight};
use manylights_scene::{Brdf, Lobe};
use manylights_vpl::{Settings, gather, oracle};

/// A family of pairs of one surface and one light, all seen by one camera.
struct Case {
    name: String,
    pairs: Vec<(SurfaceRecord, VirtualLight)>,
    camera: Vec3,
    settings: Settings,
}

const PLAIN: Settings = Settings { lights: 1, clamp: None, radius: None };

fn light(position: Vec3, normal: Vec3, brdf: Brdf) -> VirtualLight {
    let incoming = (normal + 0.5 * normal.any_orthonormal_vector()).normalize();
    VirtualLight { position, geometric_normal: normal, normal, incoming, flux: Vec3::ONE, brdf }
}

fn materials() -> [(&'static str, Brdf); 3] {
    let glossy = |roughness: f32| Brdf {
        diffuse: Vec3::splat(0.5),
        f0: Vec3::splat(0.04),
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    };
    [
        ("Lambert", Brdf::lambert(Vec3::splat(0.5))),
        ("GGX 0.5", glossy(0.5)),
        ("GGX 0.1", glossy(0.1)),
    ]
}

/// Distances from `size` down to 1e-12 of it.
fn shrinking(size: f32) -> impl Iterator<Item = f32> {
    (0..=48).map(move |step| size * 10_f32.powf(-0.25 * step as f32))
}

/// An oblique frame, so that no coordinate is exact.
fn oblique(v: Vec3) -> Vec3 {
    Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7) * v
}

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (material, brdf) in materials() {
        let mut add = |name: &str, camera, settings, pairs| {
            cases.push(Case { name: format!("{name}, {material}"), pairs, camera, settings });
        };
        for size in [1e-3_f32, 1.0, 1e4] {
            let origin = size * Vec3::new(0.3, -0.2, 0.5);
            let camera = origin + size * oblique(Vec3::new(0.4, 1.0, 0.2));
            let up = oblique(Vec3::Y);
            let facing = |d: f32| {
                let across = oblique(Vec3::new(0.3, 1.0, 0.1)).normalize();
                (SurfaceRecord::new(origin, up, brdf), light(origin + d * across, -up, brdf))
            };
            let beside = |d: f32| {
                let across = oblique(Vec3::X);
                (SurfaceRecord::new(origin, up, brdf), light(origin + d * across, up, brdf))
            };
            let name = |what: &str| format!("{what}, scene of {size:e}");
            add(&name("distance → 0"), camera, PLAIN, shrinking(size).map(facing).collect());
            let coplanar = shrinking(size).map(beside).collect();
            add(&name("light on the lit surface"), camera, PLAIN, coplanar);
            let soft = Settings { radius: Some(0.1 * size), ..PLAIN };
            let pairs = shrinking(size).map(facing).collect();
            add(&name("distance → 0, attenuated"), camera, soft, pairs);
        }
        let up = oblique(Vec3::Y);
        let behind = (1..20).map(|i| {
            let away = oblique(Vec3::new(0.2, -0.1 * i as f32, 0.4));
            (SurfaceRecord::new(Vec3::ZERO, up, brdf), light(away, up, brdf))
        });
        add("back faces", up, PLAIN, behind.collect());
        let grazing = (1..=12).map(|i| {
            // The surface turns away from the camera, down to 1e-6 rad above its horizon.
            let angle = 10_f32.powf(-0.5 * i as f32);
            let normal = Vec3::new(angle.cos(), angle.sin(), 0.0);
            (
                SurfaceRecord::new(Vec3::ZERO, normal, brdf),
                light(Vec3::new(1.0, 0.7, 0.3), -Vec3::X, brdf),
            )
        });
        add("grazing view", Vec3::Y, PLAIN, grazing.collect());
    }
    cases
}

struct Outcome {
    worst: f64,
    largest: f64,
    non_finite: usize,
}

fn measure(gpu: &Gpu, case: &Case) -> Outcome {
    let mut outcome = Outcome { worst: 0.0, largest: 0.0, non_finite: 0 };
    for (surface, light) in &case.pairs {
        let lights = [*light];
        let pixel = gather(gpu, &[*surface], case.camera, &lights, &case.settings)
            .expect("the adapter gathers one light");
        let value = Vec3::from(pixel[0]).as_dvec3();
        let truth = oracle::radiance(surface, case.camera.as_dvec3(), &lights, &case.settings);
        if !value.is_finite() {
            outcome.non_finite += 1;
            continue;
        }
        let scale = truth.max_element().max(value.max_element());
        if scale > 0.0 {
            outcome.worst = outcome.worst.max((value - truth).abs().max_element() / scale);
        }
        outcome.largest = outcome.largest.max(truth.max_element());
    }
    outcome
}

fn main() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/bench installs one");
    let report = gpu.report();
    let mut table = format!(
        "# Virtual point lights: hard cases\n\n\
         `cargo run --release -p manylights-vpl --example vpl_stability` on {} ({} {}).\n\n\
         Worst difference of the adapter's f32 to the f64 oracle, relative to the larger of the \
         two, over each family of light and surface pairs; the largest true radiance shows how \
         hard the family is.\n\n\
         | case | pairs | worst relative error | largest radiance | non-finite |\n\
         |---|---|---|---|---|\n",
        report.name, report.driver, report.driver_info
    );
    let mut failed = false;
    for case in cases() {
        let Outcome { worst, largest, non_finite } = measure(&gpu, &case);
        failed |= non_finite > 0;
        let pairs = case.pairs.len();
        writeln!(table, "| {} | {pairs} | {worst:.1e} | {largest:.1e} | {non_finite} |", case.name)
            .expect("writing to a string");
    }
    let folder = "results/stability";
    std::fs::create_dir_all(folder).expect("the results folder can be made");
    std::fs::write(format!("{folder}/vpl.md"), &table).expect("the table can be written");
    print!("{table}");
    assert!(!failed, "a hard case is not finite");
}
