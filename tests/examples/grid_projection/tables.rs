//! How the time grows with lights and with vertices.

use std::fmt::Write as _;

use manylights_harmonics::wgsl::order::Evaluation;
use manylights_interpolation::Loops;

use crate::projected::{Case, Kind, times};

/// Of triangles in a square.
const LIGHTS: [u32; 7] = [72, 128, 242, 512, 800, 1250, 2450];
const VERTICES: [usize; 6] = [4, 8, 12, 16, 20, 24];
const ROWS: [(Kind, Loops); 4] = [
    (Kind::Spheres, Loops::Forward),
    (Kind::Spheres, Loops::Reverse),
    (Kind::Main, Loops::Reverse),
    (Kind::Exact, Loops::Forward),
];

pub(crate) fn section() -> String {
    let lights = LIGHTS.map(|lights| (8, lights));
    let vertices = VERTICES.map(|vertices| (vertices, 722));
    let title = "## Lights (figures 3.15a and 4.9b), 8³ vertices, 5 bands, with gradients";
    let mut text = table(title, "lights", &lights, |(_, lights)| lights.to_string());
    let title = "## Vertices (figures 3.15b and 4.9c), 722 lights, 5 bands, with gradients";
    text += &table(title, "vertices", &vertices, |(vertices, _)| format!("{vertices}³"));
    text
}

fn table(
    title: &str,
    what: &str,
    sizes: &[(usize, u32)],
    name: impl Fn(&(usize, u32)) -> String,
) -> String {
    let names: String = sizes.iter().map(|size| format!(" {} |", name(size))).collect();
    let lines = "---|".repeat(2 * sizes.len());
    let mut text = format!(
        "\n{title}\n\nMilliseconds, then nanoseconds of a vertex and light.\n\n\
         | {what} |  |{names}{names}\n|---|---|{lines}\n"
    );
    let cases: Vec<_> = ROWS
        .iter()
        .flat_map(|&(kind, loops)| {
            sizes.iter().map(move |&(vertices, lights)| Case {
                kind,
                bands: 5,
                evaluation: Evaluation::Recurrence,
                loops,
                gradients: true,
                vertices,
                lights,
            })
        })
        .collect();
    let times = times(&cases);
    for (cases, times) in cases.chunks(sizes.len()).zip(times.chunks(sizes.len())) {
        let milliseconds: String =
            times.iter().map(|time| format!(" {:.1} |", 1e3 * time.median)).collect();
        let pair = |(case, time): (&Case, &crate::projected::Time)| {
            let pairs = (case.vertices as f64).powi(3) * f64::from(case.lights);
            format!(" {:.1} |", 1e9 * time.median / pairs)
        };
        let pairs: String = cases.iter().zip(times).map(pair).collect();
        writeln!(
            text,
            "| {} | {} |{milliseconds}{pairs}",
            cases[0].kind.name(),
            cases[0].loops_name()
        )
        .expect("writing to a string");
    }
    text
}
