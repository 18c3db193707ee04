//! The WGSL that harmonics generates, on the adapter at hand, against f64.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use manylights_gpu::{Binding, Dispatch, Gpu, Resource, link};
use manylights_harmonics::wgsl::{Function, module};
use manylights_harmonics::{Basis, MAX_BANDS, count, even_count, index};

static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

/// The largest number of bands of which all functions are compiled here.
const LARGEST: usize = 20;

/// Runs `body`, which sets `result: array<f32, size>` from `input: vec4f` and `coefficients`, for each
/// of the inputs.
fn run(
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
    GPU.run(&[Dispatch { pass: "test", kernel: &kernel, resources: &resources, workgroups }])
        .expect("it runs");
    let values: Vec<f32> = GPU.read(&results).expect("it reads back");
    assert!(values.iter().all(|value| value.is_finite()), "{bands} bands: not finite");
    values[..inputs.len() * size].iter().map(|&value| f64::from(value)).collect()
}

/// Poles, axes, both with one small component, and directions between, each with a cap's sine: from 1
/// down to 1e-6. Their f32 components have unit length to 1e-9, because one off by δ moves band l by
/// up to l(l + 1)/2 δ.
fn inputs() -> Vec<[f32; 4]> {
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

/// The f32 direction nearest to unit length among some beside the given one.
fn unit(direction: [f64; 3]) -> [f32; 3] {
    let error = |d: &[f32; 3]| (d.iter().map(|&c| f64::from(c).powi(2)).sum::<f64>() - 1.0).abs();
    (0..400)
        .map(|i| {
            let stretch = 1.0 + 1e-5 * f64::from(i);
            let largest = direction.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            let moved = direction.map(|c| if c.abs() < largest { c * stretch } else { c });
            let length = moved.iter().map(|c| c * c).sum::<f64>().sqrt();
            moved.map(|c| (c / length) as f32)
        })
        .min_by(|a, b| error(a).total_cmp(&error(b)))
        .expect("some candidates")
}

fn values(basis: &Basis<f64>, direction: [f64; 3]) -> Vec<f64> {
    let length = direction.iter().map(|c| c * c).sum::<f64>().sqrt();
    let mut y = vec![0.0; count(basis.bands())];
    basis.evaluate(direction.map(|c| c / length), &mut y);
    y
}

fn direction([x, y, z, _]: [f32; 4]) -> [f64; 3] {
    [x, y, z].map(f64::from)
}

/// Gradient of Y(p/|p|) at |p| = 1 by differences of order 8, good to 1e-9.
fn gradient(basis: &Basis<f64>, center: [f64; 3], axis: usize) -> Vec<f64> {
    let step = 2e-3;
    let mut slope = vec![0.0; count(basis.bands())];
    for (steps, weight) in [(1.0, 0.8), (2.0, -0.2), (3.0, 4.0 / 105.0), (4.0, -1.0 / 280.0)] {
        for sign in [1.0, -1.0] {
            let mut p = center;
            p[axis] += sign * steps * step;
            for (slope, value) in slope.iter_mut().zip(values(basis, p)) {
                *slope += sign * weight * value / step;
            }
        }
    }
    slope
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

#[test]
fn values_keep_five_digits() {
    let inputs = inputs();
    for bands in (1..=LARGEST).chain([MAX_BANDS]) {
        let size = count(bands);
        let functions = [(Function::Evaluate, "sh_evaluate")];
        let result = run(bands, &functions, "result = sh_evaluate(input.xyz);", size, &inputs, &[]);
        let basis = Basis::new(bands);
        let errors = inputs
            .iter()
            .zip(result.chunks(size))
            .map(|(&input, y)| worst_in_bands(y, &values(&basis, direction(input)), 1));
        let worst = errors.fold(0.0, f64::max);
        println!("{bands} bands: {worst:.1e}");
        assert!(worst <= 1e-5, "{bands} bands: {worst:e}");
    }
}

#[test]
fn gradients_keep_five_digits() {
    let inputs = inputs();
    for bands in 2..=LARGEST {
        let size = 3 * count(bands);
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
            let truth = [0, 1, 2].map(|axis| gradient(&basis, direction(input), axis));
            let truth: Vec<_> =
                (0..count(bands)).flat_map(|i| [truth[0][i], truth[1][i], truth[2][i]]).collect();
            // Band 0 has no gradient to be relative to.
            assert_eq!(slopes[..3], [0.0; 3]);
            worst_in_bands(
                &[&[0.0; 3], &slopes[3..]].concat(),
                &[&[0.0; 3], &truth[3..]].concat(),
                3,
            )
        });
        let worst = errors.fold(0.0, f64::max);
        println!("{bands} bands: {worst:.1e}");
        assert!(worst <= 1e-5, "{bands} bands: {worst:e}");
    }
}

/// c_l in f64, by the recurrence of P'_l.
fn cap_truth(bands: usize, sine: f64) -> Vec<f64> {
    let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
    let area = TAU * sine * sine;
    let (mut before, mut slope) = (0.0, 1.0);
    let mut scales = vec![area / (1.0 + cosine)];
    for l in 1..bands {
        let degree = l as f64;
        scales.push(area * slope / (degree * (degree + 1.0)));
        let next = (2.0 * degree + 1.0) * cosine * slope - (degree + 1.0) * before;
        (before, slope) = (slope, next / degree);
    }
    scales
}

#[test]
fn cap_scales_keep_six_digits() {
    let inputs = inputs();
    for bands in [1, 2, 5, 9, 20, MAX_BANDS] {
        let functions = [(Function::CapScales, "cap_scales")];
        let body = "result = cap_scales(input.w);";
        let result = run(bands, &functions, body, bands, &inputs, &[]);
        for (input, scales) in inputs.iter().zip(result.chunks(bands)) {
            let truth = cap_truth(bands, f64::from(input[3]));
            for (l, (value, truth_l)) in scales.iter().zip(&truth).enumerate() {
                let error = (value - truth_l).abs() / truth[0];
                assert!(error <= 1e-6, "band {l} at {}: {error:e}", input[3]);
            }
        }
    }
}

/// The gather of a light: cap, direction and BRDF vector in one sum; the full and the even one.
#[test]
fn a_cap_meets_a_vector() {
    let inputs = inputs();
    for bands in [1, 2, 5, 9] {
        let brdf: Vec<f32> = (0..count(bands)).map(|i| (1.7 * i as f32).sin()).collect();
        let functions = [
            (Function::CapScales, "cap_scales"),
            (Function::ZonalDot, "sh_zonal_dot"),
            (Function::ZonalDotEven, "sh_zonal_dot_even"),
        ];
        let body = format!(
            "var brdf: array<f32, {}>;
             var half: array<f32, {}>;
             for (var i = 0u; i < {}u; i++) {{ brdf[i] = coefficients[i]; }}
             for (var l = 0u; l < {bands}u; l++) {{
                 for (var m = 0u; m <= l; m++) {{ half[l * (l + 1u) / 2u + m] = brdf[l * (l + 1u) + m]; }}
             }}
             let scales = cap_scales(input.w);
             result[0] = sh_zonal_dot(input.xyz, scales, brdf);
             result[1] = sh_zonal_dot_even(input.xyz, scales, half);",
            count(bands),
            even_count(bands),
            count(bands)
        );
        let result = run(bands, &functions, &body, 2, &inputs, &brdf);
        let basis = Basis::new(bands);
        for (&input, sums) in inputs.iter().zip(result.chunks(2)) {
            let scales = cap_truth(bands, f64::from(input[3]));
            let y = values(&basis, direction(input));
            let mut truth = [0.0; 2];
            for l in 0..bands {
                for m in -(l as isize)..=l as isize {
                    let term = scales[l] * y[index(l, m)] * f64::from(brdf[index(l, m)]);
                    truth[0] += term;
                    truth[1] += if m >= 0 { term } else { 0.0 };
                }
            }
            for (sum, truth) in sums.iter().zip(truth) {
                // Σ |Y b| is below 81 at 9 bands, so 1e-5 is one part in 1e7 of the terms' sum.
                let error = (sum - truth).abs() / scales[0];
                assert!(error <= 1e-5, "{bands} bands at {input:?}: {error:e}");
            }
        }
    }
}
