//! Products with the clamped cosine (thesis table 4.1) and the turn between frames.

use manylights_harmonics::clamped_cosine::{Folded, Local, scales};
use manylights_harmonics::product::{Product, diffuse_from_specular, double};
use manylights_harmonics::rotation::Zxzxz;
use manylights_harmonics::wgsl::{CUT, Function};
use manylights_harmonics::{Basis, count, even_count, even_index, index};

use super::adapter::{direction, inputs, run, values};

/// The bands of the experiments, and the fewest.
const BANDS: [usize; 5] = [1, 2, 3, 5, 9];

/// A light of three channels that no symmetry simplifies.
fn light(bands: usize) -> Vec<f32> {
    (0..3 * count(bands)).map(|i| (1.7 * i as f32 + 0.3).sin()).collect()
}

fn channel(light: &[f32], channel: usize) -> Vec<f64> {
    light.iter().skip(channel).step_by(3).map(|&value| f64::from(value)).collect()
}

/// Unit vectors that complete a normal, as the kernel's text below has them.
const FRAME: &str =
    "let helper = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(input.x) > 0.7);
     let tangent = normalize(cross(helper, input.xyz));
     let bitangent = cross(input.xyz, tangent);";

fn frame(normal: [f64; 3]) -> [[f64; 3]; 3] {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let unit = |a: [f64; 3]| a.map(|x| x / a.iter().map(|x| x * x).sum::<f64>().sqrt());
    let helper = if normal[0].abs() > 0.7 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
    let normal = unit(normal);
    let tangent = unit(cross(helper, normal));
    [tangent, cross(normal, tangent), normal]
}

/// Worst error of what `call` makes of the light `a` and of `truth`, over the largest coefficient.
fn worst(
    bands: usize,
    function: (Function, &str),
    call: &str,
    size: usize,
    truth: impl Fn([f64; 3], &[f64]) -> Vec<f64>,
) -> f64 {
    let (inputs, light) = (inputs(), light(bands));
    let element = |i: usize| {
        let part = |c| format!("coefficients[{}]", 3 * i + c);
        format!("vec3f({}, {}, {})", part(0), part(1), part(2))
    };
    let elements: Vec<_> = (0..count(bands)).map(element).collect();
    let mut cosine = vec![0.0; bands];
    scales(&mut cosine);
    let about = |i: usize| format!("{:?} * y[{i}]", cosine[i.isqrt()] as f32);
    let about: Vec<_> = (0..count(bands)).map(about).collect();
    let cut: Vec<_> = (0..count(bands.min(CUT))).map(|i| format!("y[{i}]")).collect();
    let copy: String = (0..size)
        .map(|i| {
            format!(
                "result[{}] = p[{i}].x; result[{}] = p[{i}].y; result[{}] = p[{i}].z;\n",
                3 * i,
                3 * i + 1,
                3 * i + 2
            )
        })
        .collect();
    let body = format!(
        "let a = array<vec3f, {n}>({});
         let y = sh_evaluate(input.xyz);
         let cosine = array<f32, {n}>({});
         let cut = array<f32, {}>({});
         {FRAME}
         let p = {call};
         {copy}",
        elements.join(", "),
        about.join(", "),
        cut.len(),
        cut.join(", "),
        n = count(bands),
    );
    let functions = [(Function::Evaluate, "sh_evaluate"), function];
    let result = run(bands, &functions, &body, 3 * size, &inputs, &light);
    let mut worst = 0.0_f64;
    for (&input, found) in inputs.iter().zip(result.chunks(3 * size)) {
        for c in 0..3 {
            let truth = truth(direction(input), &channel(&light, c));
            let largest = truth.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            for (i, exact) in truth.iter().enumerate() {
                worst = worst.max((found[3 * i + c] - exact).abs() / largest);
            }
        }
    }
    worst
}

/// The expansion of the clamped cosine about a normal.
fn cosine(basis: &Basis<f64>, normal: [f64; 3]) -> Vec<f64> {
    let mut cosine = vec![0.0; basis.bands()];
    scales(&mut cosine);
    let y = values(basis, normal);
    y.iter().enumerate().map(|(i, y)| cosine[i.isqrt()] * y).collect()
}

#[test]
fn the_general_product_keeps_five_digits() {
    for bands in BANDS {
        let (basis, table) = (Basis::new(bands), Product::<f64>::new(bands));
        let truth = |normal, light: &[f64]| {
            let (about, mut product) = (cosine(&basis, normal), vec![0.0; light.len()]);
            table.apply(light, &about, &mut product);
            // Thesis 4.4.
            let irradiance = double(light, &about);
            assert!((diffuse_from_specular(&product) - irradiance).abs() <= 1e-12);
            product
        };
        let function = (Function::Product, "sh_product");
        let worst = worst(bands, function, "sh_product(a, cosine)", count(bands), truth);
        assert!(worst <= 1e-5, "{bands} bands: {worst:e}");
    }
}

#[test]
fn products_with_the_folded_cosine_keep_five_digits() {
    let whole = (Function::CosineProduct, "sh_cosine_product", "sh_cosine_product(a, y)");
    let cut =
        (Function::CosineProductCut, "sh_cosine_product_cut", "sh_cosine_product_cut(a, cut)");
    for bands in BANDS {
        for ((function, name, call), of) in [(whole, bands), (cut, bands.min(CUT))] {
            let (basis, table) = (Basis::new(of), Folded::<f64>::new(bands, of));
            let truth = |normal, light: &[f64]| {
                let mut product = vec![0.0; light.len()];
                table.apply(light, &values(&basis, normal), &mut product);
                product
            };
            let worst = worst(bands, (function, name), call, count(bands), truth);
            assert!(worst <= 1e-5, "{bands} bands, {of} of the cosine: {worst:e}");
        }
    }
}

#[test]
fn the_local_product_keeps_five_digits() {
    for bands in BANDS {
        let table = Local::<f64>::new(bands);
        let truth = |_, light: &[f64]| {
            let mut product = vec![0.0; light.len()];
            table.apply(light, &mut product);
            product
        };
        let function = (Function::ClampedCosine, "sh_clamped_cosine");
        let worst = worst(bands, function, "sh_clamped_cosine(a)", count(bands), truth);
        assert!(worst <= 1e-5, "{bands} bands: {worst:e}");
    }
}

#[test]
fn turns_keep_five_digits() {
    for bands in BANDS {
        let turn = Zxzxz::<f64>::new(bands);
        let truth = |normal, light: &[f64]| {
            let mut turned = light.to_vec();
            turn.apply(frame(normal), &mut turned, &mut vec![0.0; light.len()]);
            let mut half = vec![0.0; even_count(bands)];
            for l in 0..bands {
                for m in 0..=l {
                    half[even_index(l, m)] = turned[index(l, m as isize)];
                }
            }
            half
        };
        let function = (Function::TurnEven, "sh_turn_even");
        let call = "sh_turn_even(tangent, bitangent, input.xyz, a)";
        let worst = worst(bands, function, call, even_count(bands), truth);
        assert!(worst <= 1e-5, "{bands} bands: {worst:e}");
    }
}
