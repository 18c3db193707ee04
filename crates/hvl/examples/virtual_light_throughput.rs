//! Pairs of light and pixel a second for virtual point, spherical and harmonics lights, and what a pair
//! of the last takes: written to `results/hvl-throughput/table.md`. Run with
//! `cargo run --release -p manylights-hvl --example virtual_light_throughput`.

use std::fmt::Write as _;

use manylights_gpu::{Gpu, GpuFrame};
use manylights_harmonics::even_count;
use manylights_harmonics::wgsl::Function;
use manylights_hvl::Hvl;
use manylights_method::{Frame, Method, Parameters, Transport, Visibility};
use manylights_vpl::Vpl;
use manylights_vsl::Vsl;

const RESOLUTION: [u32; 2] = [160, 120];
const BANDS: [usize; 5] = [3, 5, 10, 15, 20];
const ROUNDS: usize = 7;

struct Column {
    method: &'static dyn Method,
    parameters: Vec<(&'static str, String)>,
    /// Bands and whether the form is zonal.
    expansion: Option<(usize, bool)>,
}

fn columns() -> Vec<Column> {
    let column = |method: &'static dyn Method, parameters: &[(&'static str, usize)], expansion| {
        let parameters = parameters.iter().chain(&[("lights", 400)]);
        let parameters = parameters.map(|&(key, value)| (key, value.to_string())).collect();
        Column { method, parameters, expansion }
    };
    let mut columns =
        vec![column(&Vpl, &[], None), column(&Vsl, &[("samples", 25), ("sampling", 0)], None)];
    for zonal in [false, true] {
        for bands in BANDS {
            let parameters = [("bands", bands), ("form", usize::from(zonal))];
            columns.push(column(&Hvl, &parameters, Some((bands, zonal))));
        }
    }
    columns
}

/// Adapter seconds of the gather, and the lights summed.
fn gather(frame: &Frame<'_>, column: &Column) -> (f64, u64) {
    let Column { method, parameters, .. } = column;
    let texts = parameters.iter().map(|(key, value)| (*key, &**value));
    let parameters = Parameters::new(method.parameters(), texts).expect("in range");
    let mut run = method.prepare(frame, &parameters).expect("the method renders the scene");
    while !run.step().expect("a step").finished() {}
    let seconds = run.pass_times().iter().find(|t| t.pass == "gather").map_or(0.0, |t| t.seconds);
    (seconds, run.counters()[0].1)
}

/// Additions and multiplications of a pair: generated code by its own count, the rest counted in the
/// shaders (geometry 36, horizon 5 where no cap is cut).
fn operations(glossy_receivers: bool, (n, zonal): (usize, bool)) -> usize {
    let of = |function: Function| {
        let operations = function.generate(n).operations;
        operations.additions + operations.multiplications
    };
    // P_l by its recurrence 4 (n − 2), then two products and a sum a band.
    let legendre = 4 * n.saturating_sub(2);
    let scales = of(Function::CapScales);
    let lambert = if zonal { 4 } else { scales + legendre + 3 * n + 4 };
    // One dot product each for f0 and f90 where f0 has a colour.
    let specular = match (glossy_receivers, zonal) {
        (false, _) => 0,
        (true, false) => 10 + of(Function::EvaluateEven) + 2 * (2 * even_count(n) + n) + 7,
        (true, true) => 17 + scales + legendre + 2 * 3 * n + 7,
    };
    36 + 5 + lambert + specular
}

fn main() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/bench installs one");
    let report = gpu.report();
    let mut table = format!(
        "# Throughput of the gathers\n\n\
         `cargo run --release -p manylights-hvl --example virtual_light_throughput` on {} ({} {}).\n\n\
         {}×{} pixels, 400 cells, visibility ignored; median of {ROUNDS} interleaved rounds by the \
         adapter's clock. `vsl` takes 25 samples of the shaded point's BRDF, the thesis' setting. \
         Operations are additions and multiplications of a pair that sees each other, 115 more where \
         the light lies on a GGX surface; pairs that face away cost less.\n",
        report.name, report.driver, report.driver_info, RESOLUTION[0], RESOLUTION[1]
    );
    let columns = columns();
    for (name, glossy) in [("cornell", false), ("trio", true)] {
        let scene = manylights_scene::load(name, None).expect("built in");
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
        let mut rates: Vec<Vec<f64>> = columns.iter().map(|_| Vec::new()).collect();
        let pixels = f64::from(RESOLUTION[0] * RESOLUTION[1]);
        // The first round warms up.
        for round in 0..=ROUNDS {
            for (rates, column) in rates.iter_mut().zip(&columns) {
                let (seconds, lights) = gather(&frame, column);
                if round > 0 {
                    rates.push(lights as f64 * pixels / seconds);
                }
            }
        }
        let medians: Vec<_> = rates
            .into_iter()
            .map(|mut rates| {
                rates.sort_by(f64::total_cmp);
                rates[ROUNDS / 2]
            })
            .collect();
        write!(
            table,
            "\n## {name}\n\n\
             | method | bands | form | M pairs/s | time ÷ vpl | operations a pair | G operations/s |\n\
             |---|---|---|---|---|---|---|\n"
        )
        .expect("writing to a string");
        for (column, rate) in columns.iter().zip(&medians) {
            let (id, ratio) = (column.method.id(), medians[0] / rate);
            write!(table, "| {id} |").expect("writing to a string");
            match column.expansion {
                None => write!(table, " | | {:.1} | {ratio:.2} | | |", rate / 1e6),
                Some(expansion @ (bands, zonal)) => {
                    let form = if zonal { "zonal" } else { "full" };
                    let operations = operations(glossy, expansion);
                    let all = operations as f64 * rate / 1e9;
                    let rate = rate / 1e6;
                    write!(
                        table,
                        " {bands} | {form} | {rate:.1} | {ratio:.2} | {operations} | {all:.1} |"
                    )
                }
            }
            .expect("writing to a string");
            table.push('\n');
        }
    }
    let folder = "results/hvl-throughput";
    std::fs::create_dir_all(folder).expect("the results folder can be made");
    std::fs::write(format!("{folder}/table.md"), &table).expect("the table can be written");
    print!("{table}");
}
