//! Hard cases of the gather: the adapter's f32 against the f64 oracle, written to
//! `results/stability/vsl.md`. Run with
//! `cargo run --release -p manylights-vsl --example vsl_stability`.

use std::fmt::Write as _;

use glam::{Quat, Vec3};
use manylights_gpu::{Gpu, RadiusRule, SurfaceRecord, VirtualLight};
use manylights_scene::{Brdf, Lobe};
use manylights_vsl::{Sampling, Settings, SphericalLight, gather, oracle};

/// A family of pairs of one surface and one light, all seen by one camera.
struct Case {
    name: String,
    pairs: Vec<(SurfaceRecord, SphericalLight)>,
    camera: Vec3,
}

/// Cone samples alone: those of the lobes may fall on either side of a cone's rim in f32 and f64,
/// which says nothing about precision. They are counted for non-finite values.
const SETTINGS: Settings = Settings {
    lights: 1,
    samples: 25,
    sampling: Sampling::Cone,
    radius: RadiusRule::FieldOfView,
    scale: 1.0,
};

fn light(position: Vec3, normal: Vec3, brdf: Brdf, radius: f32) -> SphericalLight {
    let incoming = (normal + 0.5 * normal.any_orthonormal_vector()).normalize();
    let (geometric_normal, flux) = (normal, Vec3::ONE);
    let light = VirtualLight { position, geometric_normal, normal, incoming, flux, brdf };
    SphericalLight { light, radius }
}

fn materials() -> Vec<(&'static str, Brdf)> {
    let glossy = |roughness: f32| Brdf {
        diffuse: Vec3::splat(0.5),
        f0: Vec3::splat(0.04),
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    };
    vec![
        ("Lambert", Brdf::lambert(Vec3::splat(0.5))),
        ("GGX 0.5", glossy(0.5)),
        ("GGX 0.1", glossy(0.1)),
        ("GGX 0.01", glossy(0.01)),
    ]
}

/// Distances from `size` down to 1e-12 of it.
fn shrinking(size: f32) -> impl Iterator<Item = f32> {
    (0..=24).map(move |step| size * 10_f32.powf(-0.5 * step as f32))
}

/// An oblique frame, so that no coordinate is exact.
fn oblique(v: Vec3) -> Vec3 {
    Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7) * v
}

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let up = oblique(Vec3::Y);
    for (material, brdf) in materials() {
        let mut add = |name: &str, camera, pairs| {
            cases.push(Case { name: format!("{name}, {material}"), pairs, camera });
        };
        for size in [1e-3_f32, 1.0, 1e4] {
            let origin = size * Vec3::new(0.3, -0.2, 0.5);
            let camera = origin + size * oblique(Vec3::new(0.4, 1.0, 0.2));
            let across = oblique(Vec3::new(0.3, 1.0, 0.1)).normalize();
            let receiver = SurfaceRecord::new(origin, up, brdf);
            let facing = |d: f32, radius| (receiver, light(origin + d * across, -up, brdf, radius));
            let beside = |d: f32| {
                let away = oblique(Vec3::new(1.0, 0.01, 0.0));
                (receiver, light(origin + d * away, -up, brdf, 0.1 * size))
            };
            let name = |what: &str| format!("{what}, scene of {size:e}");
            let inside = shrinking(size).map(|d| facing(d, 0.1 * size)).collect();
            add(&name("distance → 0, through the sphere"), camera, inside);
            let narrow = shrinking(size).map(|radius| facing(size, radius)).collect();
            add(&name("radius → 0"), camera, narrow);
            add(
                &name("points, distance → 0"),
                camera,
                shrinking(size).map(|d| facing(d, 0.0)).collect(),
            );
            add(
                &name("sphere that touches the surface"),
                camera,
                shrinking(size).map(beside).collect(),
            );
        }
        let behind = (1..20).map(|i| {
            let away = oblique(Vec3::new(0.2, -0.1 * i as f32, 0.4));
            (SurfaceRecord::new(Vec3::ZERO, up, brdf), light(away, up, brdf, 0.3))
        });
        add("back faces", up, behind.collect());
        let grazing = (1..=12).map(|i| {
            // The surface turns away from the camera, down to 1e-6 rad above its horizon.
            let angle = 10_f32.powf(-0.5 * i as f32);
            let normal = Vec3::new(angle.cos(), angle.sin(), 0.0);
            let sphere = light(Vec3::new(1.0, 0.7, 0.3), -Vec3::X, brdf, 0.3);
            (SurfaceRecord::new(Vec3::ZERO, normal, brdf), sphere)
        });
        add("grazing view", Vec3::Y, grazing.collect());
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
    for (surface, sphere) in &case.pairs {
        let pixel = |sampling| {
            let settings = Settings { sampling, ..SETTINGS };
            gather(gpu, &[*surface], case.camera, &[*sphere], &settings, 0)
                .map(|pixels| Vec3::from(pixels[0]).as_dvec3())
                .expect("the adapter gathers one light")
        };
        let value = pixel(Sampling::Cone);
        let others = [pixel(Sampling::Brdf), pixel(Sampling::Both)];
        let all = others.iter().chain([&value]);
        outcome.non_finite += all.filter(|value| !value.is_finite()).count();
        let eye = case.camera.as_dvec3();
        let truth = oracle::radiance(0, surface, eye, &[*sphere], &SETTINGS, 0);
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
        "# Virtual spherical lights: hard cases\n\n\
         `cargo run --release -p manylights-vsl --example vsl_stability` on {} ({} {}).\n\n\
         Worst difference of the adapter's f32 to the f64 oracle with the same 25 cone samples, \
         relative to the larger of the two, over each family of light and surface pairs; the largest \
         true radiance shows how hard the family is. Non-finite values are counted over all three \
         samplings.\n\n\
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
    std::fs::write(format!("{folder}/vsl.md"), &table).expect("the table can be written");
    print!("{table}");
    assert!(!failed, "a hard case is not finite");
}
