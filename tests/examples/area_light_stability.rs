//! Hard cases of spherical lights: the adapter's f32 against the f64 oracle along paths of a light past a
//! receiver, written to `results/stability/area-lights.md`. Run with
//! `cargo run --release -p manylights-tests --example area_light_stability`.

use std::fmt::Write as _;

use glam::{Quat, Vec3};
use manylights_gpu::{AdapterReport, SurfaceRecord};
use manylights_scene::{Brdf, Lobe};
use manylights_spherical_light::{
    Coefficients, CosineProduct, Extent, Product, Settings, SphereLight, gather, oracle,
};
use manylights_tests::GPU;

const STEPS: u32 = 400;

/// Receivers as one light sees them on a path.
struct Family {
    name: &'static str,
    radius: f32,
    /// From the centre of the light to the receiver, in turn.
    offsets: Vec<Vec3>,
    /// The unit of length, m.
    unit: f32,
    /// Whether the offsets are a path, on which the truth is continuous.
    path: bool,
}

fn families() -> Vec<Family> {
    let parts = || (0..STEPS).map(|i| i as f32 / (STEPS - 1) as f32);
    let line = |from: Vec3, to: Vec3| parts().map(|t| from.lerp(to, t)).collect::<Vec<_>>();
    let decades = |from: f32, to: f32| {
        let toward = Vec3::new(0.3, -0.9, 0.2).normalize();
        parts().map(|t| toward * 10_f32.powf(from + t * (to - from))).collect::<Vec<_>>()
    };
    let below = |depth: f32| Vec3::new(0.6, depth, 0.1);
    let family = |name, radius, offsets| Family { name, radius, offsets, unit: 1.0, path: true };
    let sinking = line(below(-0.8), below(0.8));
    let unit = |name, unit| Family { unit, ..family(name, 0.3, sinking.clone()) };
    vec![
        family("far light, 1 to 1e6 of its radius", 1.0, decades(0.0, 6.0)),
        family("tiny light at 1 m, as a point of 1e-7 m", 1e-7, line(below(-0.8), below(-0.1))),
        family("from outside to the centre", 0.5, line(Vec3::new(0.3, -0.9, 0.2), Vec3::ZERO)),
        family("near the centre, down to 1e-12 m", 0.5, decades(-12.0, -1.0)),
        Family {
            path: false, // the direction to the centre turns about within a rounding
            ..family("at the centre and around it by 1e-20 m", 0.5, decades(-30.0, -20.0))
        },
        family("across the surface of the sphere, 1e-4 of the radius", 1.0, {
            let toward = Vec3::new(0.3, -0.9, 0.2).normalize();
            line(0.9999 * toward, 1.0001 * toward)
        }),
        family("sinking through the receiver's plane", 0.3, sinking.clone()),
        family("wholly below the horizon", 0.1, line(below(0.2), below(0.9))),
        unit("sinking, scene 1e-3 units large", 1e-3),
        unit("sinking, scene 1e4 units large", 1e4),
    ]
}

fn materials() -> [Brdf; 4] {
    let glossy = |diffuse: f32, f0: f32, roughness: f32| Brdf {
        diffuse: Vec3::splat(diffuse),
        f0: Vec3::splat(f0),
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    };
    let lambert = Brdf::lambert(Vec3::splat(0.5));
    [lambert, glossy(0.5, 0.04, 1.0), glossy(0.0, 0.8, 0.3), glossy(0.0, 0.8, 0.1)]
}

/// Of a family, relative to the largest truth.
#[derive(Default)]
struct Outcome {
    error: f64,
    /// The largest difference of two neighbours, the adapter's and the oracle's.
    jumps: [f64; 2],
    non_finite: usize,
}

fn outcome(family: &Family, brdf: Brdf, settings: &Settings) -> Outcome {
    // No coordinate is exact.
    let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7);
    let camera = turn * Vec3::new(0.6, 1.0, -0.2) * (1e3 * family.unit);
    let surfaces: Vec<_> = family
        .offsets
        .iter()
        .map(|&offset| SurfaceRecord::new(turn * (family.unit * offset), turn * Vec3::Y, brdf))
        .collect();
    let light = SphereLight::new(Vec3::ZERO, family.unit * family.radius, Vec3::ONE);
    let found = gather(&GPU, &surfaces, camera, &[light], settings).expect("a gather");
    let pairs: Vec<[f64; 2]> = surfaces
        .iter()
        .zip(found)
        .map(|(surface, found)| {
            let truth = oracle::radiance(surface, camera.as_dvec3(), &[light], settings);
            let distance = f64::from(surface.position.length().max(light.radius));
            let sine = f64::from(light.radius) / distance;
            [f64::from(found[0]), truth.x].map(|value| value / (sine * sine))
        })
        .collect();
    let largest = pairs.iter().map(|pair| pair[1].abs()).fold(0.0, f64::max);
    let mut outcome = Outcome::default();
    for pair in &pairs {
        outcome.error = outcome.error.max((pair[0] - pair[1]).abs() / largest);
        outcome.non_finite += pair.iter().filter(|value| !value.is_finite()).count();
    }
    for neighbours in pairs.windows(2) {
        let step = |k: usize| (neighbours[1][k] - neighbours[0][k]).abs() / largest;
        outcome.jumps = [0, 1].map(|k| outcome.jumps[k].max(step(k)));
    }
    outcome
}

fn main() {
    let AdapterReport { name, driver, driver_info, .. } = GPU.report();
    let mut table = format!(
        "# spherical-light: hard cases\n\n\
         `cargo run --release -p manylights-tests --example area_light_stability` on {name} ({driver} \
         {driver_info}).\n\n\
         Nine bands, five of 4.5; {STEPS} receivers along each path, on a Lambertian surface and on GGX of roughness 1, \
         0.3 and 0.1. Values are radiances over the square of the sine r/d, so that a far light counts as \
         much as a near one. Given is the largest difference of the adapter's f32 to the f64 oracle, of the \
         full lobe in each form of the coefficients and with discs for spheres, of the product 4.6 in the \
         surface's frame and of 4.5 in the world's, then the largest step from one receiver to the next, of the adapter and of \
         the oracle (sphere, analytic), all relative to the largest value of the path. Where the steps agree \
         none is the adapter's own.\n\n\
         | path | sphere | tabulated | disc | tabulated disc | 4.6 | 4.5 | step | oracle's step | non-finite \
         |\n|---|---|---|---|---|---|---|---|---|---|\n"
    );
    let full = Settings::default();
    let product = |product, bands| Settings { bands, product: Product::Cosine(product), ..full };
    let tabulated = Settings { coefficients: Coefficients::Tabulated, ..full };
    let settings = [
        full,
        tabulated,
        Settings { extent: Extent::Disc, ..full },
        Settings { extent: Extent::Disc, ..tabulated },
        product(CosineProduct::Local, 9),
        product(CosineProduct::Folded, 5), // 9 bands take an adapter 20 s to compile
    ];
    let mut finite = true;
    for family in families() {
        let (mut errors, mut jumps, mut non_finite) = ([0_f64; 6], [0_f64; 2], 0);
        for brdf in materials() {
            for (index, settings) in settings.iter().enumerate() {
                let outcome = outcome(&family, brdf, settings);
                errors[index] = errors[index].max(outcome.error);
                non_finite += outcome.non_finite;
                if index == 0 && outcome.jumps[0] > jumps[0] {
                    jumps = outcome.jumps;
                }
            }
        }
        finite &= non_finite == 0;
        let errors = errors.map(|error| format!("{error:.1e}")).join(" | ");
        let steps = match family.path {
            true => jumps.map(|step| format!("{step:.1e}")).join(" | "),
            false => "– | –".to_owned(),
        };
        writeln!(table, "| {} | {errors} | {steps} | {non_finite} |", family.name)
            .expect("writing to a string");
    }
    std::fs::create_dir_all("results/stability").expect("the results folder can be made");
    std::fs::write("results/stability/area-lights.md", &table).expect("the table can be written");
    print!("{table}");
    assert!(finite, "a hard case is not finite");
}
