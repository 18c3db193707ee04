//! What a pair of light and pixel takes in the gather of each virtual light, how far that is from the
//! adapter's arithmetic, and how it grows with lights and bands: written to
//! `results/throughput/virtual-lights.md`. Run with
//! `cargo run --release -p manylights-tests --example virtual_light_throughput`.

mod columns;
mod peak;

use std::fmt::Write as _;

use manylights_gpu::AdapterReport;
use manylights_scene::Visibility;
use manylights_tests::{GPU, Stage};

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

fn measure(stage: &Stage, column: &Column) -> Measurement {
    let parameters: Vec<_> =
        column.parameters.iter().map(|(key, value)| (*key, &**value)).collect();
    let run = stage.run(column.method, &parameters, Visibility::Ignored, 0);
    let gather = run.pass_times().into_iter().find(|time| time.pass == "gather");
    Measurement { seconds: gather.expect("a gather").seconds, lights: run.counters()[0].1 }
}

/// A built-in scene as it is, or with a lobe on every Lambertian material.
fn stage(scene: &str, glossy: bool) -> Stage {
    let mut scene = manylights_scene::load(scene, None).expect("built in");
    if glossy {
        for material in &mut scene.materials {
            if !material.brdf(material.base_color).has_specular() {
                (material.specular, material.roughness) = (1.0, 0.5);
            }
        }
    }
    Stage::new(scene, RESOLUTION)
}

/// Medians of interleaved rounds; the first warms up.
fn medians(stage: &Stage, columns: &[Column]) -> Vec<Measurement> {
    let mut measurements = vec![Vec::new(); columns.len()];
    for _ in 0..=ROUNDS {
        for (measurements, column) in measurements.iter_mut().zip(columns) {
            measurements.push(measure(stage, column));
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
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / logs.len() as f64;
    let (mx, my) = (mean(|p| p.0), mean(|p| p.1));
    let along: f64 = logs.iter().map(|(x, y)| (x - mx) * (y - my)).sum();
    along / logs.iter().map(|(x, _)| (x - mx).powi(2)).sum::<f64>()
}

/// A line of exponents over the columns of a name.
fn exponents(columns: &[Column], found: &[Measurement], name: &str) -> String {
    let fit = |x: &dyn Fn(&Column, Measurement) -> Option<f64>| {
        let all = columns.iter().zip(found).filter(|(column, _)| column.name == name);
        let points = all.filter_map(|(column, &m)| Some((x(column, m)?, m.seconds)));
        let points: Vec<_> = points.collect();
        if points.len() < 2 { "–".to_owned() } else { format!("{:.2}", exponent(&points)) }
    };
    let lights = fit(&|column, found| {
        column.bands.is_none_or(|bands| bands == 5).then_some(found.lights as f64)
    });
    let [all, most] = [5, 15].map(|least| {
        fit(&|column, _| {
            let bands = column.bands.filter(|&bands| column.cells == 400 && bands >= least);
            bands.map(|bands| bands as f64)
        })
    });
    format!("| {name} | {lights} | {all} | {most} |\n")
}

/// A line a column: rates and shares of `peak`.
fn rates(columns: &[Column], found: &[Measurement], peak: f64) -> String {
    let base = columns.iter().position(|column| column.cells == 400).expect("vpl comes first");
    let mut lines = String::new();
    for (column, &measurement) in columns.iter().zip(found) {
        let rate = measurement.pairs_a_second();
        let bands = column.bands.map_or("–".to_owned(), |bands| bands.to_string());
        let arithmetic = column.operations.map_or("– | – | –".to_owned(), |operations| {
            let all = operations.simple + operations.special;
            let share = 100.0 * all as f64 * rate / peak;
            format!("{all} | {} | {share:.0} %", operations.special)
        });
        writeln!(
            lines,
            "| {} | {bands} | {} | {:.1} | {:.2} | {arithmetic} |",
            column.name,
            measurement.lights,
            rate / 1e6,
            found[base].pairs_a_second() / rate,
        )
        .expect("writing to a string");
    }
    lines
}

fn main() {
    let AdapterReport { name, driver, driver_info, .. } = GPU.report();
    let peak = peak::operations_a_second(&GPU);
    let mut table = format!(
        "# Throughput of the gathers\n\n\
         `cargo run --release -p manylights-tests --example virtual_light_throughput` on {name} ({driver} \
         {driver_info}).\n\n\
         {}×{} pixels, visibility ignored; median of {ROUNDS} interleaved rounds of the gather pass. \
         `vsl` takes 25 directions, of the shaded point's BRDF as in the thesis (sampling=brdf) or of the cone \
         (sampling=cone). Operations on floats are counted in the shader's text \
         (`manylights_gpu::operations`) for a pair that sees each other, both sides of branches; whole \
         numbers and memory are not counted, and pairs that face away leave early, so that a share may \
         be more than what the arithmetic units did. Special ones (roots, divisions, exponentials) count \
         as one, though they take several. The peak is that of multiplications and additions that wait \
         for nothing: {:.1} G operations/s.\n",
        RESOLUTION[0],
        RESOLUTION[1],
        peak / 1e9,
    );
    for (scene, glossy, note) in [
        ("cornell", false, "Lambertian all over"),
        ("trio", true, "glossy all over: a lobe of roughness 0.5 on what is Lambertian"),
    ] {
        let (columns, stage) = (columns(glossy), stage(scene, glossy));
        let found = medians(&stage, &columns);
        let rates = rates(&columns, &found, peak);
        write!(
            table,
            "\n## {scene}, {note}\n\n\
             | method | bands | lights | M pairs/s | time of a pair ÷ that of vpl at 400 cells | operations | of these special | of the peak |\n\
             |---|---|---|---|---|---|---|---|\n{rates}\n\
             Exponents of the time, fitted to three counts of lights (100 to 1600 cells), to four numbers \
             of bands (5 to 20) and to the last two of them, where what does not depend on bands is a \
             smaller part:\n\n| method | lights | 5 to 20 bands | 15 to 20 |\n|---|---|---|---|\n"
        )
        .expect("writing to a string");
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
