//! The loops over lights and coefficients, straight-line for a number of bands.

use manylights_harmonics::count;
use manylights_harmonics::wgsl::order::{self, Evaluation};
use manylights_harmonics::wgsl::{Function, module};

/// How the loops over lights and coefficients nest (thesis 3.3.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loops {
    /// A lane a vertex: all coefficients of a light, light after light.
    Forward,
    /// A lane a vertex and order ±m, with few sums to hold.
    Reverse,
}

/// What is projected, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProjectionSettings {
    /// With the coefficients.
    pub gradients: bool,
    /// Over lights and coefficients.
    pub loops: Loops,
    /// Of the harmonics.
    pub evaluation: Evaluation,
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
pub(super) fn modules(bands: usize, how: ProjectionSettings) -> [(&'static str, String); 2] {
    let [basis, own] = match how.loops {
        Loops::Forward => forward(bands, how),
        Loops::Reverse => reverse(bands, how),
    };
    [("basis", basis), ("loops", format!("{HEAD}{own}"))]
}

const HEAD: &str = "import package::sighting::contribution;
import package::source::sight;
import package::store::store;
import package::vertices::batch;
";

/// A call that returns the harmonics of these places in an expansion, in their order.
struct Evaluated {
    name: String,
    indices: Vec<usize>,
}

fn forward(bands: usize, how: ProjectionSettings) -> [String; 2] {
    let (mut basis, mut evaluated) = (module(bands, &[]), Vec::new());
    match how.evaluation {
        Evaluation::Recurrence => {
            let (function, name) = match how.gradients {
                true => (Function::EvaluateWithGradient, "sh_evaluate_with_gradient"),
                false => (Function::Evaluate, "sh_evaluate"),
            };
            basis = module(bands, &[function]);
            evaluated.push(Evaluated { name: name.into(), indices: (0..count(bands)).collect() });
        }
        Evaluation::Polynomial => {
            for order in 0..bands {
                evaluated.push(of_order(&mut basis, bands, order, how));
            }
        }
    }
    let own = summation("project", "order: u32, ", &evaluated, how.gradients);
    [basis, format!("{}\n{own}", imports(&evaluated))]
}

fn reverse(bands: usize, how: ProjectionSettings) -> [String; 2] {
    let (mut basis, mut evaluated) = (module(bands, &[]), Vec::new());
    let (mut cases, mut own) = (String::new(), String::new());
    for m in 0..bands {
        let project = format!("project_{m}");
        let order = of_order(&mut basis, bands, m, how);
        own += &summation(&project, "", std::slice::from_ref(&order), how.gradients);
        evaluated.push(order);
        let arguments = "vertex, position, count";
        cases += &match m + 1 == bands {
            true => format!("        default: {{ {project}({arguments}); }}\n"),
            false => format!("        case {m}u: {{ {project}({arguments}); }}\n"),
        };
    }
    let signature = "project(order: u32, vertex: u32, position: vec3f, count: u32)";
    own += &format!("fn {signature} {{\n    switch order {{\n{cases}    }}\n}}\n");
    [basis, format!("{}\n{own}", imports(&evaluated))]
}

/// The harmonics of one order, added to the basis.
fn of_order(basis: &mut String, bands: usize, order: usize, how: ProjectionSettings) -> Evaluated {
    let (function, suffix) = match how.gradients {
        true => (order::with_gradient(bands, order, how.evaluation), "_with_gradient"),
        false => (order::values(bands, order, how.evaluation), ""),
    };
    *basis += &format!("\n{}", function.wgsl);
    let name = format!("sh_order_{order}{suffix}");
    Evaluated { name, indices: order::indices(bands, order) }
}

fn imports(evaluated: &[Evaluated]) -> String {
    let import = |call: &Evaluated| format!("import package::basis::{};\n", call.name);
    evaluated.iter().map(import).collect()
}

/// A function that sums the coefficients of these calls over a batch.
fn summation(name: &str, parameter: &str, evaluated: &[Evaluated], gradients: bool) -> String {
    let element = if gradients { "mat3x4f" } else { "vec3f" };
    let [mut sums, mut adds, mut stores] = [(); 3].map(|()| String::new());
    for (call, Evaluated { name, indices }) in evaluated.iter().enumerate() {
        adds += &format!("        let y_{call} = {name}(s.direction);\n");
        for (k, i) in indices.iter().enumerate() {
            let l = band(*i);
            sums += &format!("    var sum_{i}: {element};\n");
            adds += &format!("        sum_{i} += contribution(s, s.scales[{l}], y_{call}[{k}]);\n");
            stores += &format!("    store(vertex, {i}u, sum_{i});\n");
        }
    }
    format!(
        "fn {name}({parameter}vertex: u32, position: vec3f, count: u32) {{
{sums}    for (var i = 0u; i < count; i++) {{
        let s = sight(batch.lights[i], position);
{adds}    }}
{stores}}}\n\n"
    )
}

/// That a place in an expansion belongs to.
fn band(i: usize) -> usize {
    i.isqrt()
}
