//! The loops over lights and coefficients, straight-line for a number of bands.

use manylights_harmonics::count;
use manylights_harmonics::wgsl::{Function, module, order};

/// How the loops over lights and coefficients nest (thesis 3.3.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loops {
    /// A lane a vertex: all coefficients of a light, light after light.
    Forward,
    /// A lane a vertex and order ±m, with few sums to hold.
    Reverse,
}

impl Loops {
    /// Lanes a vertex.
    pub(super) fn lanes(self, bands: usize) -> u32 {
        match self {
            Self::Forward => 1,
            Self::Reverse => bands as u32,
        }
    }
}

/// The modules `basis`, the harmonics, and `loops`, which has `project(order, vertex, position, count)`.
pub(super) fn modules(bands: usize, gradients: bool, loops: Loops) -> [(&'static str, String); 2] {
    let texts = match loops {
        Loops::Forward => forward(bands, gradients),
        Loops::Reverse => reverse(bands, gradients),
    };
    let [basis, own] = texts;
    [("basis", basis), ("loops", format!("{HEAD}{own}"))]
}

const HEAD: &str = "import package::sighting::contribution;
import package::source::sight;
import package::store::store;
import package::vertices::batch;
";

fn forward(bands: usize, gradients: bool) -> [String; 2] {
    let (function, name) = match gradients {
        true => (Function::EvaluateWithGradient, "sh_evaluate_with_gradient"),
        false => (Function::Evaluate, "sh_evaluate"),
    };
    let all: Vec<_> = (0..count(bands)).collect();
    let own = summation("project", "order: u32, ", name, &all, gradients);
    [module(bands, &[function]), format!("import package::basis::{name};\n\n{own}")]
}

fn reverse(bands: usize, gradients: bool) -> [String; 2] {
    let mut basis = module(bands, &[]);
    let (mut imports, mut cases, mut own) = (String::new(), String::new(), String::new());
    for m in 0..bands {
        let (function, suffix) = match gradients {
            true => (order::with_gradient(bands, m), "_with_gradient"),
            false => (order::values(bands, m), ""),
        };
        basis += &format!("\n{}", function.wgsl);
        let (project, evaluate) = (format!("project_{m}"), format!("sh_order_{m}{suffix}"));
        imports += &format!("import package::basis::{evaluate};\n");
        own += &summation(&project, "", &evaluate, &order::indices(bands, m), gradients);
        let arguments = "vertex, position, count";
        cases += &match m + 1 == bands {
            true => format!("        default: {{ {project}({arguments}); }}\n"),
            false => format!("        case {m}u: {{ {project}({arguments}); }}\n"),
        };
    }
    let signature = "project(order: u32, vertex: u32, position: vec3f, count: u32)";
    own += &format!("fn {signature} {{\n    switch order {{\n{cases}    }}\n}}\n");
    [basis, format!("{imports}\n{own}")]
}

/// A function that sums the coefficients of these places over a batch. `evaluate` returns their harmonics in
/// that order.
fn summation(
    name: &str,
    parameter: &str,
    evaluate: &str,
    indices: &[usize],
    gradients: bool,
) -> String {
    let element = if gradients { "mat3x4f" } else { "vec3f" };
    let sums: String =
        (0..indices.len()).map(|k| format!("    var sum_{k}: {element};\n")).collect();
    let add = |(k, i): (usize, &usize)| {
        let l = band(*i);
        format!("        sum_{k} += contribution(s, s.scales[{l}], y[{k}]);\n")
    };
    let keep = |(k, i): (usize, &usize)| format!("    store(vertex, {i}u, sum_{k});\n");
    let adds: String = indices.iter().enumerate().map(add).collect();
    let stores: String = indices.iter().enumerate().map(keep).collect();
    format!(
        "fn {name}({parameter}vertex: u32, position: vec3f, count: u32) {{
{sums}    for (var i = 0u; i < count; i++) {{
        let s = sight(batch.lights[i], position);
        let y = {evaluate}(s.direction);
{adds}    }}
{stores}}}\n\n"
    )
}

/// That a place in an expansion belongs to.
fn band(i: usize) -> usize {
    i.isqrt()
}
