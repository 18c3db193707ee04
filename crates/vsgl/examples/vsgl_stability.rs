//! Hard cases of filter and gather: the adapter's f32 against the f64 oracle, written to
//! `results/stability/vsgl.md`. Run with
//! `cargo run --release -p manylights-vsgl --example vsgl_stability`.

use std::fmt::Write as _;

use glam::{DVec3, Quat, Vec3};
use manylights_gpu::{Gpu, LitTexel, SurfaceRecord};
use manylights_scene::Brdf;
use manylights_vsgl::{GaussianLight, Lobe, Settings, SpecularLobe, filter_group, gather, oracle};

/// Texels to be filtered into a light, and a surface that it shines on.
struct Pair {
    texels: Vec<(SurfaceRecord, LitTexel)>,
    surface: SurfaceRecord,
}

/// A family of pairs, all seen by one camera.
struct Case {
    name: String,
    pairs: Vec<Pair>,
    camera: Vec3,
}

const LOBES: [SpecularLobe; 2] = [SpecularLobe::Filtered, SpecularLobe::Anisotropic];

fn surface(position: Vec3, normal: Vec3, brdf: Brdf) -> SurfaceRecord {
    let Brdf { diffuse, f0, lobe, alpha } = brdf;
    let f90 = lobe.slot();
    SurfaceRecord { position, alpha, normal, f90, diffuse, triangle: 0, f0, material: 0 }
}

/// A slightly curved square of 6² texels about `center`; `extent` 0 puts all of them there.
fn group(center: Vec3, normal: Vec3, brdf: Brdf, extent: f32) -> Vec<(SurfaceRecord, LitTexel)> {
    let (a, b) = normal.any_orthonormal_pair();
    let texels = (0..36).map(|i| {
        let [x, y] = [i % 6, i / 6].map(|i| (i as f32 + 0.5) / 6.0 - 0.5);
        let bent = (normal + 0.3 * x * a - 0.2 * y * b).normalize();
        let incoming = (normal + (0.5 + 0.1 * x) * a).normalize();
        let texel = LitTexel {
            flux: Vec3::new(1.0, 1.0 + x, 1.0 - y) / 36.0,
            variance: (extent / 6.0).powi(2) / 12.0,
            incoming,
            padding0: 0.0,
            geometric_normal: bent,
            padding1: 0.0,
        };
        (surface(center + extent * (x * a + y * b), bent, brdf), texel)
    });
    texels.collect()
}

fn materials() -> Vec<(&'static str, Brdf)> {
    let glossy = |roughness: f32| Brdf {
        diffuse: Vec3::splat(0.5),
        f0: Vec3::splat(0.04),
        lobe: manylights_scene::Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    };
    vec![
        ("Lambert", Brdf::lambert(Vec3::splat(0.5))),
        ("GGX 1", glossy(1.0)),
        ("GGX 0.3", glossy(0.3)),
        ("GGX 0.1", glossy(0.1)),
        ("GGX 0.03", glossy(0.03)),
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
            let receiver = surface(origin, up, brdf);
            let facing = |d: f32, extent| Pair {
                texels: group(origin + d * across, -up, brdf, extent),
                surface: receiver,
            };
            let beside = |d: f32| Pair {
                texels: group(origin + d * oblique(Vec3::X), up, brdf, 0.2 * size),
                surface: receiver,
            };
            let name = |what: &str| format!("{what}, scene of {size:e}");
            let into = shrinking(size).map(|d| facing(d, 0.2 * size)).collect();
            add(&name("distance → 0, into the cloud"), camera, into);
            let narrow = shrinking(size).map(|extent| facing(size, extent)).collect();
            add(&name("extent → 0"), camera, narrow);
            let points = shrinking(size).take(13).map(|d| facing(d, 0.0)).collect();
            add(&name("points, distance → 1e-6"), camera, points);
            add(&name("on the same plane"), camera, shrinking(size).map(beside).collect());
        }
        let far = (0..=4).map(|i| {
            let origin = 10_f32.powi(i) * Vec3::new(0.6, -0.5, 0.6);
            let texels = group(origin + oblique(Vec3::new(0.4, 1.0, 0.2)), -up, brdf, 0.2);
            Pair { texels, surface: surface(origin, up, brdf) }
        });
        add("up to 1e4 from the origin", Vec3::new(3.0, 9.0, 2.0), far.collect());
        let behind = (1..20).map(|i| {
            let away = oblique(Vec3::new(0.2, -0.1 * i as f32, 0.4));
            let texels = group(away, up, brdf, 0.3);
            Pair { texels, surface: surface(Vec3::ZERO, up, brdf) }
        });
        add("back faces", up, behind.collect());
        let grazing = (1..=12).map(|i| {
            // The surface turns away from the camera, down to 1e-6 rad above its horizon.
            let angle = 10_f32.powf(-0.5 * i as f32);
            let normal = Vec3::new(angle.cos(), angle.sin(), 0.0);
            let texels = group(Vec3::new(1.0, 0.7, 0.3), -Vec3::X, brdf, 0.3);
            Pair { texels, surface: surface(Vec3::ZERO, normal, brdf) }
        });
        add("grazing view", Vec3::Y, grazing.collect());
    }
    cases
}

#[derive(Default)]
struct Outcome {
    /// Of power, variance and sharpness of the lobes.
    filter: f64,
    /// Of radiance by each approximation of the lobe, from the adapter's lights.
    gather: [f64; 2],
    largest: f64,
    non_finite: usize,
}

fn filter_error(found: &Lobe, truth: &oracle::Lobe) -> f64 {
    let relative = |found: f32, truth: f64| (f64::from(found) - truth).abs() / truth.abs();
    let power = (found.power.as_dvec3() - truth.power).length() / truth.power.length();
    let sharpness = relative(found.sharpness, truth.sharpness);
    // Extents below the last digit of the places have none left in f32 records.
    let digit = f64::from(f32::EPSILON) * truth.position.length();
    let variance = match truth.variance.sqrt() > 1e3 * digit {
        true => relative(found.variance, truth.variance),
        false => 0.0,
    };
    power.max(sharpness).max(variance)
}

fn measure(gpu: &Gpu, case: &Case) -> Outcome {
    let mut outcome = Outcome::default();
    for Pair { texels, surface } in &case.pairs {
        let light = filter_group(gpu, texels).expect("the adapter filters 36 texels");
        let Some(light) = light else { continue };
        let GaussianLight { diffuse, specular, .. } = light;
        for (found, truth) in [diffuse, specular].iter().zip(&oracle::filter(texels)) {
            if truth.power != DVec3::ZERO {
                outcome.filter = outcome.filter.max(filter_error(found, truth));
            }
        }
        for (lobe, worst) in LOBES.into_iter().zip(&mut outcome.gather) {
            let settings = Settings { lights: 1, texels: 6, lobe };
            let pixels = gather(gpu, &[*surface], case.camera, &[light], &settings)
                .expect("the adapter gathers one light");
            let value = Vec3::from(pixels[0]).as_dvec3();
            outcome.non_finite += usize::from(!value.is_finite());
            let eye = case.camera.as_dvec3();
            let truth = oracle::radiance(surface, eye, &[light], &settings);
            let scale = truth.max_element().max(value.max_element());
            if scale > 0.0 {
                *worst = worst.max((value - truth).abs().max_element() / scale);
            }
            outcome.largest = outcome.largest.max(truth.max_element());
        }
    }
    outcome
}

fn main() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/bench installs one");
    let report = gpu.report();
    let mut table = format!(
        "# Virtual spherical Gaussian lights: hard cases\n\n\
         `cargo run --release -p manylights-vsgl --example vsgl_stability` on {} ({} {}).\n\n\
         Worst differences of the adapter's f32 to the f64 oracle, over each family of a group of 6² \
         texels and a surface. Filter: power, variance and sharpness of the lobes, relative. Gather: \
         radiance under the adapter's lobes, relative to the larger of the two, with filtered normals \
         and with the anisotropic Gaussian; the largest true radiance shows how hard the family is. Of \
         lights below the horizon next to nothing is left, less than the error of erfc in f32 (1.5e-7 \
         of what a facing light gives). Views within 1e-6 of the horizon have a cosine of one digit in \
         f32.\n\n\
         | case | pairs | filter | gather, filtered | gather, anisotropic | largest radiance | \
         non-finite |\n|---|---|---|---|---|---|---|\n",
        report.name, report.driver, report.driver_info
    );
    let mut failed = false;
    for case in cases() {
        let Outcome { filter, gather: [filtered, anisotropic], largest, non_finite } =
            measure(&gpu, &case);
        failed |= non_finite > 0;
        let (name, pairs) = (&case.name, case.pairs.len());
        writeln!(
            table,
            "| {name} | {pairs} | {filter:.1e} | {filtered:.1e} | {anisotropic:.1e} | {largest:.1e} \
             | {non_finite} |"
        )
        .expect("writing to a string");
    }
    let folder = "results/stability";
    std::fs::create_dir_all(folder).expect("the results folder can be made");
    std::fs::write(format!("{folder}/vsgl.md"), &table).expect("the table can be written");
    print!("{table}");
    assert!(!failed, "a hard case is not finite");
}
