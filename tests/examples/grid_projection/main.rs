//! Thesis tables 3.2 and 4.3 and figures 3.15, 4.9b and 4.9c here: what projecting lights at the vertices of a grid
//! takes, and how far that is from the adapter's arithmetic; written to `results/throughput/projection.md`. Run with
//! `cargo run -p manylights-tests --example grid_projection`, and the commit as its argument.

mod counted;
mod projected;
mod tables;

use std::fmt::Write as _;

use manylights_gpu::AdapterReport;
use manylights_harmonics::wgsl::order::Evaluation;
use manylights_interpolation::Loops;
use manylights_tests::{GPU, page};

use counted::operations_a_vertex;
use projected::{Case, Kind, Time, far_share, times};

/// Multiplications and additions a second and core that wait for nothing, of the machine at hand
/// (`results/throughput/area-light-products.md`).
const PEAK: f64 = 80e9;

/// Thesis tables 3.2 and 4.3, ms: polynomials forward and reverse, recurrence forward and reverse, triangles by
/// spheres, polygons.
const THESIS: [(usize, [f64; 6]); 5] = [
    (5, [4.48, 4.32, 4.08, 2.22, 2.53, 7.21]),
    (6, [7.25, 6.37, 5.98, 2.96, 3.39, 13.08]),
    (7, [13.11, 8.54, 7.24, 3.77, 4.42, 16.21]),
    (8, [19.30, 10.41, 12.73, 4.76, 5.35, 29.07]),
    (9, [33.23, 12.91, 22.26, 5.18, 5.74, 164.01]),
];

/// Of a row: the same lights with gradients and without.
struct Line {
    case: Case,
    with: Time,
    without: Time,
}

fn lines(bands: usize) -> Vec<Line> {
    let (forward, reverse) = (Loops::Forward, Loops::Reverse);
    let (steps, polynomials) = (Evaluation::Recurrence, Evaluation::Polynomial);
    let rows = [
        (Kind::Spheres, polynomials, forward),
        (Kind::Spheres, polynomials, reverse),
        (Kind::Spheres, steps, forward),
        (Kind::Spheres, steps, reverse),
        (Kind::Main, steps, forward),
        (Kind::Main, steps, reverse),
        (Kind::SolidAngle, steps, forward),
        (Kind::SolidAngle, steps, reverse),
        (Kind::Exact, steps, forward),
    ];
    let case = |(kind, evaluation, loops), gradients| Case {
        kind,
        bands,
        evaluation,
        loops,
        gradients,
        vertices: 8,
        lights: 648,
    };
    let cases: Vec<_> =
        rows.iter().flat_map(|&row| [true, false].map(|gradients| case(row, gradients))).collect();
    let times = times(&cases);
    let pairs = cases.chunks(2).zip(times.chunks(2));
    pairs.map(|(cases, times)| Line { case: cases[0], with: times[0], without: times[1] }).collect()
}

/// The rows of one number of bands; `published` as [`THESIS`] has them.
fn rows(lines: &[Line], published: [f64; 6]) -> String {
    let mut text = String::new();
    let reverse_spheres = (lines[3].with.median, published[3]);
    for (index, Line { case, with, without }) in lines.iter().enumerate() {
        let published = match case.kind {
            Kind::Spheres => Some(published[index]),
            Kind::Main if case.loops == Loops::Reverse => Some(published[4]),
            Kind::Exact => Some(published[5]),
            _ => None,
        };
        let published = published.map_or(" – | –".to_owned(), |time| {
            format!(" {time} | {:.2}", time / reverse_spheres.1)
        });
        let vertices = (case.vertices as f64).powi(3);
        let operations = operations_a_vertex(case);
        writeln!(
            text,
            "| {} | {} | {} | {} | {with} | {without} | {:.2} | {:.2} | {:.2} |{published} | {:.1} | {:.0} % |",
            case.bands,
            case.kind.name(),
            case.evaluation_name(),
            case.loops_name(),
            with.median / without.median,
            with.median / reverse_spheres.0,
            1e9 * with.median / vertices / f64::from(case.lights),
            operations / f64::from(case.lights) / 1e3,
            100.0 * operations * vertices / with.median / PEAK,
        )
        .expect("writing to a string");
    }
    text
}

fn main() {
    let AdapterReport { name, driver, driver_info, .. } = GPU.report();
    let commit = std::env::args().nth(1).unwrap_or_else(|| "unknown".to_owned());
    let mut text = format!(
        "# Projecting lights at the vertices of a grid\n\n\
         `cargo run -p manylights-tests --example grid_projection` on {name} ({driver} {driver_info}), commit {commit}.\n\n\
         The projection's own passes, warm; median [quartiles] of {} interleaved rounds, in milliseconds of all \
         processors together, since others ran besides: on two idle ones a pass takes half of it. A square \
         of triangles over a grid of 2 × 1 × 2 m, or the spheres that stand for them. `ns`: of a vertex and light \
         with gradients; `operations`: thousands on floats of a vertex and light in the kernel's text, all lanes of \
         the vertex together; the peak, of multiplications and additions that wait for nothing, is {:.0} G \
         operations/s a core. The thesis' times are of an RTX 2080.\n\n\
         ## 8³ vertices, 648 lights (thesis tables 3.2 and 4.3)\n\n\
         Of the pairs of exact triangle and vertex {:.0} % are far (seven points instead of edges).\n\n\
         | bands | lights | harmonics | loops | with gradients | without | gradients cost | ÷ spheres, reverse | ns \
         | thesis ms | ÷ spheres, reverse | operations | of the peak |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        projected::ROUNDS,
        PEAK / 1e9,
        100.0 * far_share(8, 648),
    );
    for (bands, published) in THESIS {
        text += &rows(&lines(bands), published);
    }
    text += &tables::section();
    page::write("results/throughput/projection.md", &text);
}
