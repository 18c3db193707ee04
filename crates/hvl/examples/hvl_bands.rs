//! What a number of bands leaves of the integral over the sphere, and what one circular lobe holds of
//! the specular one: written to `results/hvl/bands.md`. Run with
//! `cargo run --release -p manylights-hvl --example hvl_bands`.

use std::fmt::Write as _;

use glam::{DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_harmonics::window::Window;
use manylights_hvl::{Horizon, Settings, VirtualSphere, oracle};
use manylights_reflectance::lobes::LobeTable;
use manylights_reflectance::zonal::ZonalTable;
use manylights_reflectance::{Damping, Form};
use manylights_scene::{Brdf, Lobe};
use manylights_virtual_lights::VirtualLight;

const BANDS: [usize; 6] = [1, 3, 5, 10, 15, 20];
const ROUGHNESS: [f32; 6] = [1.0, 0.6, 0.4, 0.3, 0.2, 0.1];

fn glossy(roughness: f32) -> Brdf {
    // A metal: nothing but the specular lobe.
    Brdf {
        diffuse: Vec3::ZERO,
        f0: Vec3::ONE,
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    }
}

/// Spheres that cover 0.2 rad from all over the hemisphere, each shining at the surface.
fn spheres() -> Vec<VirtualSphere> {
    (0..256)
        .map(|i| {
            let height = (i as f32 + 0.5) / 256.0;
            let (sin, cos) = (i as f32 * 2.399_963).sin_cos();
            let level = (1.0 - height * height).sqrt();
            let position = Vec3::new(level * cos, height, level * sin);
            let light = VirtualLight {
                position,
                geometric_normal: -position,
                normal: -position,
                incoming: -position,
                flux: Vec3::ONE,
                brdf: Brdf::lambert(Vec3::ONE),
            };
            VirtualSphere { light, radius: 0.2 }
        })
        .collect()
}

/// √(mean square of the difference over that of the integral), over all spheres and views.
fn error(brdf: Brdf, truths: &[Vec<DVec3>], settings: &Settings) -> f64 {
    let (mut square, mut whole) = (0.0, 0.0);
    for (view, truths) in views().into_iter().zip(truths) {
        for (sphere, truth) in spheres().iter().zip(truths) {
            let value = oracle::radiance(&surface(brdf), view, &[*sphere], settings);
            square += (value.x - truth.x).powi(2);
            whole += truth.x.powi(2);
        }
    }
    (square / whole).sqrt()
}

fn views() -> [DVec3; 3] {
    [0_f64, 40.0, 75.0].map(|degrees| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        DVec3::new(10.0 * sin, 10.0 * cos, 0.0)
    })
}

fn surface(brdf: Brdf) -> SurfaceRecord {
    SurfaceRecord::new(Vec3::ZERO, Vec3::Y, brdf)
}

fn main() {
    let mut table = "# Harmonics virtual lights: bands\n\n\
         `cargo run --release -p manylights-hvl --example hvl_bands`, f64 on the processor.\n\n\
         Relative RMS error of the radiance that a purely specular GGX surface reflects of spheres of \
         0.2 rad all over its hemisphere, seen from 0°, 40° and 75°, against a quadrature over each \
         sphere. `w` is under a Hann window as wide as the expansion, `d` under the weakest sinc⁴ \
         window that keeps a lobe positive; `zonal` is one circular lobe.\n\n\
         | roughness | form |"
        .to_owned();
    let mut line = |cells: &mut dyn Iterator<Item = String>, head: &str| {
        write!(table, "{head}").expect("writing to a string");
        for cell in cells {
            write!(table, " {cell} |").expect("writing to a string");
        }
        table.push('\n');
    };
    line(&mut BANDS.iter().map(|n| format!("{n} bands")), "");
    line(&mut BANDS.iter().map(|_| "---".to_owned()), "|---|---|");
    let plain = Settings { horizon: Horizon::Exact, ..Settings::default() };
    let hann = Settings { damping: Damping::Window(Window::Hann), ..plain };
    let weakest = Settings { damping: Damping::Weakest, ..plain };
    let zonal = Settings { form: Form::Zonal, ..plain };
    for roughness in ROUGHNESS {
        let brdf = glossy(roughness);
        let truth = |view, sphere: &VirtualSphere| {
            oracle::by_quadrature(&surface(brdf), view, sphere, |_, _| 1.0, 48)
        };
        let truths: Vec<Vec<_>> = views()
            .into_iter()
            .map(|view| spheres().iter().map(|sphere| truth(view, sphere)).collect())
            .collect();
        for (name, settings) in [("", plain), ("w", hann), ("d", weakest), ("zonal", zonal)] {
            let error = |&bands| error(brdf, &truths, &Settings { bands, ..settings });
            let mut cells = BANDS.iter().map(|bands| format!("{:.3}", error(bands)));
            line(&mut cells, &format!("| {roughness} | {name} |"));
        }
    }
    table += "\nShare of the square of the cosine-weighted lobe that one circular lobe about the best axis \
         holds (20 bands), and that axis, by the angle of the view:\n\n| roughness | 0° | 30° | 60° | 80° |\n|---|---|---|---|---|\n";
    for roughness in ROUGHNESS {
        let lobes = LobeTable::of(roughness * roughness, 20, Damping::None);
        let zonal = ZonalTable::of(roughness * roughness, 20, Damping::None);
        write!(table, "| {roughness} |").expect("writing to a string");
        for degrees in [0, 30, 60, 80] {
            let ([x, z], _) = zonal.at(f64::from(degrees).to_radians());
            let held = zonal.captured(&lobes, degrees as usize);
            let axis = (-x).atan2(z).to_degrees();
            write!(table, " {held:.3} at {axis:.1}° |").expect("writing to a string");
        }
        table.push('\n');
    }
    let folder = "results/hvl";
    std::fs::create_dir_all(folder).expect("the results folder can be made");
    std::fs::write(format!("{folder}/bands.md"), &table).expect("the table can be written");
    print!("{table}");
}
