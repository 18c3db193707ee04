//! What expanding the emission of glossy lights costs and changes, on `trio`: written to
//! `results/hvl/emission.md`. Run with
//! `cargo run --release -p manylights-hvl --example hvl_emission`.

use std::fmt::Write as _;

use manylights_gpu::{Gpu, GpuFrame};
use manylights_hvl::Hvl;
use manylights_method::{Frame, Method, Parameters};
use manylights_metrics::RadianceImage;
use manylights_scene::{Transport, Visibility};
use manylights_virtual_lights::VirtualLights;

const BANDS: [u32; 6] = [0, 1, 2, 3, 5, 9];
const ROUNDS: usize = 5;

fn picture(frame: &Frame<'_>, bands: u32) -> (RadianceImage, f64) {
    let bands = bands.to_string();
    let parameters =
        Parameters::new(VirtualLights(Hvl).parameters(), [("emission_bands", &*bands)]);
    let mut run = VirtualLights(Hvl)
        .prepare(frame, &parameters.expect("in range"))
        .expect("hvl renders the scene");
    while !run.step().expect("a step").finished() {}
    let image = run.resolve().expect("a picture");
    let times = run.pass_times();
    (image, times.iter().find(|time| time.pass == "gather").map_or(0.0, |time| time.seconds))
}

/// √(mean square of the difference over that of `truth`).
fn error(image: &RadianceImage, truth: &RadianceImage) -> f64 {
    let pairs = image.pixels.as_flattened().iter().zip(truth.pixels.as_flattened());
    let (square, whole) = pairs.fold((0.0, 0.0), |(square, whole), (&value, &truth)| {
        (square + f64::from(value - truth).powi(2), whole + f64::from(truth).powi(2))
    });
    (square / whole).sqrt()
}

fn main() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/bench installs one");
    let report = gpu.report();
    let scene = manylights_scene::load("trio", None).expect("built in");
    let (camera, resolution) = (&scene.cameras[0], [160, 120]);
    let on_gpu = GpuFrame::new(&gpu, &scene, camera, resolution).expect("the scene fits");
    let frame = Frame {
        scene: &scene,
        camera,
        resolution,
        transport: Transport::Indirect { bounces: 1, visibility: Visibility::Ignored },
        seed: 0,
        gpu: Some(&on_gpu),
    };
    let mut times = BANDS.map(|_| Vec::new());
    for _ in 0..ROUNDS {
        for (times, bands) in times.iter_mut().zip(BANDS) {
            times.push(picture(&frame, bands).1);
        }
    }
    let truth = picture(&frame, 0).0;
    let mut table = format!(
        "# Harmonics virtual lights: emission of glossy lights\n\n\
         `cargo run --release -p manylights-hvl --example hvl_emission` on {} ({} {}).\n\n\
         `trio`, 160×120, 400 lights, 5 bands at the receiver. Relative RMS difference of the picture \
         to the one whose lights emit by their reflectance itself; median time of the gather over \
         {ROUNDS} interleaved rounds, relative to that one's.\n\n\
         | emission_bands | difference | time |\n|---|---|---|\n",
        report.name, report.driver, report.driver_info
    );
    let medians = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[ROUNDS / 2]
    });
    for (bands, median) in BANDS.into_iter().zip(medians) {
        let difference = error(&picture(&frame, bands).0, &truth);
        let ratio = median / medians[0];
        writeln!(table, "| {bands} | {difference:.4} | {ratio:.2} |").expect("writing to a string");
    }
    let folder = "results/hvl";
    std::fs::create_dir_all(folder).expect("the results folder can be made");
    std::fs::write(format!("{folder}/emission.md"), &table).expect("the table can be written");
    print!("{table}");
}
