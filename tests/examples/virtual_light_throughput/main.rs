//! What a pair of light and pixel takes in the gather of each virtual light, how far that is from the
//! adapter's arithmetic, and how it grows with lights and bands: written to
//! `results/throughput/virtual-lights.md`. Run with
//! `cargo run --release -p manylights-tests --example virtual_light_throughput`.

mod columns;
mod peak;

use std::fmt::Write as _;

use manylights_gpu::{AdapterReport, Gpu, GpuFrame};
use manylights_method::{Frame, Parameters, Transport, Visibility};

use columns::{Column, columns};

const RESOLUTION: [u32; 2] = [160, 120];
const ROUNDS: usize = 5;

/// Of the gather of one picture.
#[derive(Clone, Copy)]
struct Measurement {
    seconds: f64,
    lights: u64,
}

impl Measurement {
    fn pairs_a_second(self) -> f64 {
        self.lights as f64 * f64::from(RESOLUTION[0] * RESOLUTION[1]) / self.seconds
    }
}

fn measure(frame: &Frame<'_>, column: &Column) -> Measurement {
    let texts = column.parameters.iter().map(|(key, value)| (*key, &**value));
    let parameters = Parameters::new(column.method.parameters(), texts).expect("in range");
    let mut run = column.method.prepare(frame, &parameters).expect("the method renders the scene");
    while !run.step().expect("a step").finished() {}
    let gather = run.pass_times().into_iter().find(|time| time.pass == "gather");
    Measurement { seconds: gather.expect("a gather").seconds, lights: run.counters()[0].1 }
}

/// Medians of interleaved rounds; the first warms up.
fn medians(gpu: &Gpu, scene: &str, columns: &[Column]) -> Vec<Measurement> {
    let scene = manylights_scene::load(scene, None).expect("built in");
    let camera = &scene.cameras[0];
    let on_gpu = GpuFrame::new(gpu, &scene, camera, RESOLUTION).expect("the scene fits");
    let frame = Frame {
        scene: &scene,
        camera,
        resolution: RESOLUTION,
        transport: Transport::Indirect { bounces: 1, visibility: Visibility::Ignored },
        seed: 0,
        gpu: Some(&on_gpu),
    };
    let mut measurements = vec![Vec::new(); columns.len()];
    for _ in 0..=ROUNDS {
        for (measurements, column) in measurements.iter_mut().zip(columns) {
            measurements.push(measure(&frame, column));
        }
    }
    let median = |mut rounds: Vec<Measurement>| {
        rounds.remove(0);
        rounds.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        rounds[ROUNDS / 2]
    };
    measurements.into_iter().map(median).collect()
}

/// The exponent of y = c x^k that fits best.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<_> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let n = logs.len() as f64;
    let [mx, my] = [logs.iter().map(|p| p.0).sum::<f64>(), logs.iter().map(|p| p.1).sum()];
    let [mx, my] = [mx / n, my / n];
    let along: f64 = logs.iter().map(|(x, y)| (x - mx) * (y - my)).sum();
    along / logs.iter().map(|(x, _)| (x - mx).powi(2)).sum::<f64>()
}

/// Exponents over the columns of a method and form, in the lights and in the bands.
fn exponents(columns: &[Column], found: &[Measurement], name: &str) -> String {
    let of = |vary: &dyn Fn(&Column) -> bool, x: &dyn Fn(&Column, Measurement) -> f64| {
        let chosen = columns.iter().zip(found).filter(|(column, _)| column.name == name);
        let chosen = chosen.filter(|(column, _)| vary(column));
        let points: Vec<_> = chosen.map(|(c, &m)| (x(c, m), m.seconds)).collect();
        if points.len() < 3 { "–".to_owned() } else { format!("{:.2}", exponent(&points)) }
    };
    let lights = of(&|c| c.bands.is_none_or(|n| n == 5), &|_, m| m.lights as f64);
    let wide = |c: &Column| c.cells == 400 && c.bands.is_some_and(|n| n >= 5);
    let bands = of(&wide, &|c, _| c.bands.map_or(f64::NAN, |n| n as f64));
    format!("| {name} | {lights} | {bands} |\n")
}

fn main() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/bench installs one");
    let AdapterReport { name, driver, driver_info, .. } = gpu.report();
    let peak = peak::operations_a_second(&gpu);
    let mut table = format!(
        "# Throughput of the gathers\n\n\
         `cargo run --release -p manylights-tests --example virtual_light_throughput` on {name} ({driver} \
         {driver_info}).\n\n\
         {}×{} pixels, visibility ignored; median of {ROUNDS} interleaved rounds of the gather pass. \
         `vsl` takes 25 samples of the shaded point's BRDF, the thesis' setting. Operations are counted in \
         the shader's text (`manylights_gpu::operations`) for a pair that sees each other, lights on \
         Lambertian surfaces in `cornell`, on glossy ones in `trio`; pairs that face away leave early, so \
         that a share may be more than what the arithmetic units did. Special ones (roots, divisions, \
         exponentials) count as one, though they take several. The peak is that of multiplications and \
         additions that wait for nothing: {:.1} G operations/s.\n",
        RESOLUTION[0],
        RESOLUTION[1],
        peak / 1e9,
    );
    for (scene, glossy) in [("cornell", false), ("trio", true)] {
        let columns = columns(glossy);
        let found = medians(&gpu, scene, &columns);
        let base = columns.iter().position(|column| column.cells == 400).expect("vpl comes first");
        write!(
            table,
            "\n## {scene}\n\n\
             | method | bands | lights | M pairs/s | time of a pair ÷ vpl | operations | of these special | of the peak |\n\
             |---|---|---|---|---|---|---|---|\n"
        )
        .expect("writing to a string");
        for (column, found_one) in columns.iter().zip(&found) {
            let rate = found_one.pairs_a_second();
            let operations = column.operations;
            let all = operations.simple + operations.special;
            let bands = column.bands.map_or("–".to_owned(), |bands| bands.to_string());
            writeln!(
                table,
                "| {} | {bands} | {} | {:.1} | {:.2} | {all} | {} | {:.0} % |",
                column.name,
                found_one.lights,
                rate / 1e6,
                found[base].pairs_a_second() / rate,
                operations.special,
                100.0 * all as f64 * rate / peak,
            )
            .expect("writing to a string");
        }
        table += "\nExponents of the time: in the number of lights (100 to 1600 cells), in the number of \
                  bands (5 to 20):\n\n| method | lights | bands |\n|---|---|---|\n";
        for name in columns::NAMES {
            table += &exponents(&columns, &found, name);
        }
    }
    let folder = "results/throughput";
    std::fs::create_dir_all(folder).expect("the results folder can be made");
    std::fs::write(format!("{folder}/virtual-lights.md"), &table)
        .expect("the table can be written");
    print!("{table}");
}
