//! Runs generated WGSL on the adapter at hand and compares it with f64.

#[path = "../../../crates/harmonics/tests/unit/mod.rs"]
mod unit;

use std::sync::LazyLock;

use manylights_gpu::{Binding, Gpu, Resource, link};
use manylights_harmonics::wgsl::{Function, module};
use manylights_harmonics::zonal::{Cap, cap_stable};
use manylights_harmonics::{Basis, count};
use unit::{normalised, unit};

pub(crate) static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

/// Runs `body`, which sets `result: array<f32, size>` from `input: vec4f` and `coefficients`, for each
/// of the inputs.
pub(crate) fn run(
    bands: usize,
    functions: &[(Function, &str)],
    body: &str,
    size: usize,
    inputs: &[[f32; 4]],
    coefficients: &[f32],
) -> Vec<f64> {
    let names: Vec<_> = functions.iter().map(|&(_, name)| name).collect();
    let source = format!(
        "import package::harmonics::{{{}}};
         @group(0) @binding(0) var<storage, read> inputs: array<vec4f>;
         @group(0) @binding(1) var<storage, read> coefficients: array<f32>;
         @group(0) @binding(2) var<storage, read_write> results: array<f32>;
         @compute @workgroup_size(32)
         fn main(@builtin(global_invocation_id) id: vec3u) {{
             if (id.x >= arrayLength(&inputs)) {{ return; }}
             let input = inputs[id.x];
             var result: array<f32, {size}>;
             {body}
             for (var i = 0u; i < {size}u; i++) {{ results[{size}u * id.x + i] = result[i]; }}
         }}",
        names.join(", ")
    );
    let functions: Vec<_> = functions.iter().map(|&(function, _)| function).collect();
    let generated = module(bands, &functions);
    let wgsl = link("test", &source, &[("harmonics", &generated)], &[]).expect("it links");
    let bindings = [Binding::Storage, Binding::Storage, Binding::StorageMut];
    let kernel = GPU.kernel("test", &wgsl, &bindings).expect("it compiles");
    let inputs_on_gpu = GPU.storage("inputs", inputs).expect("it fits");
    let coefficients = GPU.storage("coefficients", coefficients).expect("it fits");
    let results = GPU.zeroed("results", 4 * (inputs.len() * size) as u64).expect("it fits");
    let resources = [&inputs_on_gpu, &coefficients, &results].map(Resource::Buffer);
    let workgroups = [inputs.len().div_ceil(32) as u32, 1, 1];
    let pass = GPU.pass("test", &kernel, &resources).expect("it fits");
    GPU.run(&[pass.over(workgroups)]).expect("it runs");
    let values: Vec<f32> = GPU.read(&results).expect("it reads back");
    assert!(values.iter().all(|value| value.is_finite()), "{bands} bands: not finite");
    values[..inputs.len() * size].iter().map(|&value| f64::from(value)).collect()
}

/// Poles, axes, both with one small component, and directions between, each with a cap's sine: from 1
/// down to 1e-6. Their f32 components have unit length to 1e-9, because one off by δ moves band l by
/// up to l(l + 1)/2 δ.
pub(crate) fn inputs() -> Vec<[f32; 4]> {
    let mut list = Vec::new();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            for small in [0.0, 1e-20, 1e-7, 1e-3, 0.1] {
                let mut direction = [0.0; 3];
                direction[axis] = sign;
                direction[(axis + 1) % 3] = small;
                list.push(unit(direction));
            }
        }
    }
    for i in 0..98 {
        let z = 1.0 - (f64::from(i) + 0.5) / 49.0;
        let (s, c) = (2.4 * f64::from(i)).sin_cos();
        let r = (1.0 - z * z).sqrt();
        list.push(unit([r * c, r * s, z]));
    }
    let last = list.len() as f32 - 1.0;
    let sine = |i: usize| 10_f32.powf(-6.0 * i as f32 / last);
    list.into_iter().enumerate().map(|(i, [x, y, z])| [x, y, z, sine(i)]).collect()
}

pub(crate) fn values(basis: &Basis<f64>, direction: [f64; 3]) -> Vec<f64> {
    let mut y = vec![0.0; count(basis.bands())];
    basis.evaluate(normalised(direction), &mut y);
    y
}

pub(crate) fn direction([x, y, z, _]: [f32; 4]) -> [f64; 3] {
    [x, y, z].map(f64::from)
}

/// Worst error of `sh_evaluate`, relative to the band's largest value in the direction.
pub(crate) fn values_error(bands: usize) -> f64 {
    let (inputs, size) = (inputs(), count(bands));
    let functions = [(Function::Evaluate, "sh_evaluate")];
    let result = run(bands, &functions, "result = sh_evaluate(input.xyz);", size, &inputs, &[]);
    let basis = Basis::new(bands);
    let errors = inputs
        .iter()
        .zip(result.chunks(size))
        .map(|(&input, y)| worst_in_bands(y, &values(&basis, direction(input)), 1));
    errors.fold(0.0, f64::max)
}

/// Worst error of `sh_evaluate_with_gradient`, relative to the band's largest component in the
/// direction; `bands` ≥ 2.
pub(crate) fn gradients_error(bands: usize) -> f64 {
    let (inputs, size) = (inputs(), 3 * count(bands));
    let functions = [(Function::EvaluateWithGradient, "sh_evaluate_with_gradient")];
    let body = format!(
        "var both = sh_evaluate_with_gradient(input.xyz);
         for (var i = 0u; i < {}u; i++) {{
             result[3u * i] = both[i].x;
             result[3u * i + 1u] = both[i].y;
             result[3u * i + 2u] = both[i].z;
         }}",
        count(bands)
    );
    let result = run(bands, &functions, &body, size, &inputs, &[]);
    let basis = Basis::new(bands);
    let errors = inputs.iter().zip(result.chunks(size)).map(|(&input, slopes)| {
        // Band 0 has no gradient to be relative to.
        assert_eq!(slopes[..3], [0.0; 3]);
        worst_in_bands(slopes, &gradients(&basis, direction(input)), 3)
    });
    errors.fold(0.0, f64::max)
}

/// ∂x, ∂y, ∂z of each coefficient in turn.
fn gradients(basis: &Basis<f64>, direction: [f64; 3]) -> Vec<f64> {
    let size = count(basis.bands());
    let mut axes = [0; 3].map(|_| vec![0.0; size]);
    let slices = axes.each_mut().map(|axis| &mut axis[..]);
    basis.evaluate_with_gradient(normalised(direction), &mut vec![0.0; size], slices);
    (0..size).flat_map(|i| [axes[0][i], axes[1][i], axes[2][i]]).collect()
}

/// Worst error of `cap_scales`, relative to c_0.
pub(crate) fn scales_error(bands: usize) -> f64 {
    let inputs = inputs();
    let functions = [(Function::CapScales, "cap_scales")];
    let result = run(bands, &functions, "result = cap_scales(input.w);", bands, &inputs, &[]);
    let errors = inputs.iter().zip(result.chunks(bands)).map(|(input, scales)| {
        let truth = cap_truth(bands, f64::from(input[3]));
        let errors = scales.iter().zip(&truth).map(|(value, exact)| (value - exact).abs());
        errors.fold(0.0, f64::max) / truth[0]
    });
    errors.fold(0.0, f64::max)
}

/// Worst |value − truth| over the largest |truth| of its band; `parts` numbers a coefficient.
fn worst_in_bands(values: &[f64], truth: &[f64], parts: usize) -> f64 {
    let bands = (truth.len() / parts).isqrt();
    let error = |l: usize| {
        let band = parts * l * l..parts * (l + 1) * (l + 1);
        let largest = truth[band.clone()].iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let worst = band.map(|i| (values[i] - truth[i]).abs()).fold(0.0, f64::max);
        if worst == 0.0 { 0.0 } else { worst / largest }
    };
    (0..bands).map(error).fold(0.0, f64::max)
}

/// c_l in f64.
pub(crate) fn cap_truth(bands: usize, sine: f64) -> Vec<f64> {
    let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
    let mut scales = vec![0.0; bands];
    cap_stable(Cap { sine, cosine }, &mut scales);
    scales
}
