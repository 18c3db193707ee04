//! The generated WGSL, run on the CPU in f32, against f64. The adapter's own run is in the
//! workspace's tests.

use std::f64::consts::{PI, TAU};

use crate::straight_line::{Numbers, run};
use crate::unit::{normalised, unit};
use manylights_harmonics::clamped_cosine::{Folded, Local};
use manylights_harmonics::product::Product;
use manylights_harmonics::projection::fibonacci;
use manylights_harmonics::quadrature::gauss_legendre;
use manylights_harmonics::rotation::Zxzxz;
use manylights_harmonics::wgsl::order::{self, Evaluation};
use manylights_harmonics::wgsl::{CUT, Function, module};
use manylights_harmonics::zonal::{Cap, cap_rate_stable, cap_stable};
use manylights_harmonics::{Basis, MAX_BANDS, count, even_count, even_index, index};
use proptest::prelude::*;

/// The poles, the axes, both with one small component, and some directions between.
fn directions() -> Vec<[f32; 3]> {
    let mut list = Vec::new();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            for small in [0.0, 1e-20, 1e-7, 1e-3, 0.1] {
                let mut d = [0.0; 3];
                d[axis] = sign;
                d[(axis + 1) % 3] = small;
                list.push(unit(d));
            }
        }
    }
    list.extend(fibonacci(40, [-1.0, 1.0]).map(|(d, _): ([f64; 3], f64)| unit(d)));
    list
}

fn vector([x, y, z]: [f32; 3]) -> Vec<(&'static str, Numbers)> {
    vec![("direction.x", vec![x]), ("direction.y", vec![y]), ("direction.z", vec![z])]
}

fn truth(bands: usize, direction: [f32; 3]) -> Vec<f64> {
    let mut values = vec![0.0; count(bands)];
    Basis::new(bands).evaluate(normalised(direction.map(f64::from)), &mut values);
    values
}

/// Worst |value − truth| over the largest |truth| of its band.
fn worst_in_bands(values: &[f64], truth: &[f64]) -> f64 {
    let bands = truth.len().isqrt();
    let error = |l: usize| {
        let band = l * l..(l + 1) * (l + 1);
        let largest = truth[band.clone()].iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let worst = band.map(|i| (values[i] - truth[i]).abs()).fold(0.0, f64::max);
        worst / largest
    };
    (0..bands).map(error).fold(0.0, f64::max)
}

#[test]
fn values_keep_five_digits_in_f32() {
    for bands in [1, 2, 3, 4, 5, 6, 7, 9, 20, MAX_BANDS] {
        let wgsl = Function::Evaluate.generate(bands).wgsl;
        let even = Function::EvaluateEven.generate(bands).wgsl;
        let mut worst = 0.0_f64;
        for direction in directions() {
            let values = run(&wgsl, &vector(direction));
            let truth = truth(bands, direction);
            let wide: Vec<_> = values.iter().map(|&v| f64::from(v)).collect();
            worst = worst.max(worst_in_bands(&wide, &truth));
            let half = run(&even, &vector(direction));
            for l in 0..bands {
                for m in 0..=l {
                    let same = values[index(l, m as isize)] == half[even_index(l, m)];
                    assert!(same, "the halves differ at {l}, {m}");
                }
            }
        }
        println!("{bands} bands: {worst:.1e}");
        assert!(worst <= 1e-5, "{bands} bands: {worst:e}");
    }
}

/// ∂x, ∂y, ∂z of each coefficient at the unit vector along the given one.
fn gradient_truth(bands: usize, direction: [f32; 3]) -> Vec<[f64; 3]> {
    let mut values = vec![0.0; count(bands)];
    let mut axes = [0; 3].map(|_| values.clone());
    let slices = axes.each_mut().map(|axis| &mut axis[..]);
    let unit = normalised(direction.map(f64::from));
    Basis::new(bands).evaluate_with_gradient(unit, &mut values, slices);
    (0..count(bands)).map(|i| [axes[0][i], axes[1][i], axes[2][i]]).collect()
}

#[test]
fn gradients_keep_five_digits_in_f32() {
    for bands in [1, 2, 3, 4, 5, 12, 20] {
        let wgsl = Function::EvaluateWithGradient.generate(bands).wgsl;
        for direction in directions() {
            let result = run(&wgsl, &vector(direction));
            let truth = gradient_truth(bands, direction);
            for l in 0..bands {
                let band = l * l..(l + 1) * (l + 1);
                let largest =
                    truth[band.clone()].iter().flatten().fold(0.0_f64, |a, b| a.max(b.abs()));
                for (i, axis) in band.flat_map(|i| (0..3).map(move |axis| (i, axis))) {
                    let error = (f64::from(result[4 * i + axis]) - truth[i][axis]).abs();
                    assert!(error <= 1e-5 * largest, "{l} of {bands} at {direction:?}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn cap_scales_keep_six_digits_in_f32() {
    let wgsl = Function::CapScales.generate(MAX_BANDS).wgsl;
    let sines = (0..=240)
        .map(|i| 10_f32.powf(-0.025 * i as f32))
        .chain((1..=40).map(|i| 1.0 - i as f32 / 40.0 * 0.9))
        .chain([1.0 - f32::EPSILON, 1.5, f32::INFINITY]);
    for sine in sines {
        let result = run(&wgsl, &[("sine", vec![sine])]);
        let sine = f64::from(sine).min(1.0);
        let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
        let mut truth = vec![0.0; MAX_BANDS];
        cap_stable(Cap { sine, cosine }, &mut truth);
        assert_close(&result, &truth, &format!("at {sine}"));
    }
}

/// Every number to 1e-6 of the largest.
fn assert_close(result: &[f32], truth: &[f64], context: &str) {
    assert_eq!(result.len(), truth.len());
    let largest = truth.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    for (l, (&value, truth)) in result.iter().zip(truth).enumerate() {
        let error = (f64::from(value) - truth).abs();
        assert!(error <= 1e-6 * largest, "band {l} {context}: {error:e}");
    }
}

/// Down to the hemisphere, of which a rounded sine is 1 long before.
#[test]
fn cap_scales_of_sine_and_cosine_and_their_rates_keep_six_digits_in_f32() {
    let wgsl = Function::CapScalesOf.generate(MAX_BANDS).wgsl;
    let with_rate = Function::CapScalesWithRate.generate(MAX_BANDS).wgsl;
    let angles = (1..=90).map(|degrees| f64::from(degrees).to_radians());
    let near_hemisphere = [1e-2, 1e-3, 1e-5, 0.0].map(|gap| std::f64::consts::FRAC_PI_2 - gap);
    for angle in angles.chain([1e-4, 1e-8]).chain(near_hemisphere) {
        let [sine, cosine] = [angle.sin(), angle.cos().max(0.0)];
        let [s, c] = [sine, cosine].map(|value| vec![value as f32]);
        let arguments = [("sine", s), ("cosine", c)];
        let result = run(&wgsl, &arguments);
        let (mut truth, mut rates) = (vec![0.0; MAX_BANDS], vec![0.0; MAX_BANDS]);
        cap_stable(Cap { sine, cosine }, &mut truth);
        cap_rate_stable(Cap { sine, cosine }, 1.0, &mut rates);
        assert_close(&result, &truth, &format!("at {angle}"));
        let both = run(&with_rate, &arguments);
        let part = |part: usize| both.iter().skip(part).step_by(2).copied().collect::<Vec<_>>();
        assert_eq!(part(0), result);
        assert_close(&part(1), &rates, &format!("at {angle}, rate"));
    }
}

/// One order at a time is the whole, to the last digits.
#[test]
fn orders_are_those_of_the_whole_in_f32() {
    for bands in [1, 2, 3, 5, 9, 15] {
        assert_orders(bands, Evaluation::Recurrence, 3e-6);
    }
    // The terms of polynomials cancel.
    for (bands, tolerance) in [(1, 1e-6), (2, 1e-6), (3, 1e-6), (5, 1e-6), (9, 1e-5), (10, 2e-5)] {
        assert_orders(bands, Evaluation::Polynomial, tolerance);
    }
}

/// Of band l no value exceeds √((2l + 1)/2π) and no gradient l + 1 times as much: errors relative to those.
fn assert_orders(bands: usize, evaluation: Evaluation, tolerance: f64) {
    let orders: Vec<_> = (0..bands)
        .map(|order| {
            let (plain, both) = (order::values, order::with_gradient);
            let texts = [plain, both].map(|form| form(bands, order, evaluation).wgsl);
            (order::indices(bands, order), texts)
        })
        .collect();
    assert_eq!(orders.iter().map(|(indices, _)| indices.len()).sum::<usize>(), count(bands));
    let mut worst = 0.0_f64;
    for direction in directions() {
        let (values, gradients) = (truth(bands, direction), gradient_truth(bands, direction));
        for (indices, texts) in &orders {
            let [plain, both] = texts.each_ref().map(|text| run(text, &vector(direction)));
            assert_eq!([plain.len(), both.len() / 4], [indices.len(); 2]);
            for (k, &i) in indices.iter().enumerate() {
                let l = i.isqrt() as f64;
                let largest = ((2.0 * l + 1.0) / TAU).sqrt();
                for value in [plain[k], both[4 * k + 3]] {
                    worst = worst.max((f64::from(value) - values[i]).abs() / largest);
                }
                for axis in 0..3 {
                    let error = (f64::from(both[4 * k + axis]) - gradients[i][axis]).abs();
                    worst = worst.max(error / ((l + 1.0) * largest));
                }
            }
        }
    }
    println!("{bands} bands, {evaluation:?}: {worst:.1e}");
    assert!(worst <= tolerance, "{bands} bands, {evaluation:?}: {worst:e}");
}

fn half(bands: usize, values: &[f32]) -> Numbers {
    (0..bands).flat_map(|l| (0..=l).map(move |m| values[index(l, m as isize)])).collect()
}

fn coefficients(bands: usize) -> impl Strategy<Value = Numbers> {
    prop::collection::vec(-1.0_f32..1.0, count(bands))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn dot_products_are_those_of_the_definition(
        (bands, a, b, scales) in (1..=10_usize).prop_flat_map(|bands| (
            Just(bands), coefficients(bands), coefficients(bands),
            prop::collection::vec(-1.0_f32..1.0, bands),
        )),
        turn in 0.0_f32..7.0,
    ) {
        let direction = [0.6 * turn.cos(), 0.6 * turn.sin(), -0.8];
        let call = |function: Function, arguments: &[(&str, Numbers)]| {
            f64::from(run(&function.generate(bands).wgsl, arguments)[0])
        };
        let scale = 1e-6 * count(bands) as f64;
        let whole = a.iter().zip(&b).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum::<f64>();
        let dot = call(Function::Dot, &[("a", a.clone()), ("b", b.clone())]);
        prop_assert!((dot - whole).abs() <= scale);
        let halves = [("a", half(bands, &a)), ("b", half(bands, &b))];
        let (one, two) = (half(bands, &a), half(bands, &b));
        let even = one.iter().zip(&two).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum::<f64>();
        prop_assert!((call(Function::DotEven, &halves) - even).abs() <= scale);

        let y = truth(bands, direction);
        let weight = |l: usize, m: isize| {
            f64::from(scales[l]) * y[index(l, m)] * f64::from(b[index(l, m)])
        };
        let orders = |l: usize| -(l as isize)..=l as isize;
        let full: f64 = (0..bands).flat_map(|l| orders(l).map(move |m| (l, m)))
            .map(|(l, m)| weight(l, m)).sum();
        let even: f64 = (0..bands).flat_map(|l| (0..=l as isize).map(move |m| (l, m)))
            .map(|(l, m)| weight(l, m)).sum();
        let mut arguments = vector(direction);
        arguments.extend([("scales", scales.clone()), ("b", b.clone())]);
        prop_assert!((call(Function::ZonalDot, &arguments) - full).abs() <= scale);
        let mut arguments = vector(direction);
        arguments.extend([("scales", scales.clone()), ("b", two.clone())]);
        prop_assert!((call(Function::ZonalDotEven, &arguments) - even).abs() <= scale);
    }

    /// ∫ f max(0, z) Y_lm over the upper half, by a quadrature that is exact for it.
    #[test]
    fn the_clamped_cosine_multiplies(
        (bands, a) in (1..=8_usize).prop_flat_map(|bands| (Just(bands), coefficients(bands))),
    ) {
        let result = run(&Function::ClampedCosine.generate(bands).wgsl, &[("a", a.clone())]);
        let even = run(&Function::ClampedCosineEven.generate(bands).wgsl, &[("a", half(bands, &a))]);
        prop_assert_eq!(half(bands, &result), even);
        let basis = Basis::new(bands);
        let mut truth = vec![0.0; count(bands)];
        let mut y = vec![0.0; count(bands)];
        let turns = 4 * bands;
        for (node, weight) in gauss_legendre(2 * bands) {
            let z = 0.5 * (1.0 + node);
            let r = (1.0 - z * z).sqrt();
            for turn in 0..turns {
                let phi = TAU * turn as f64 / turns as f64;
                basis.evaluate([r * phi.cos(), r * phi.sin(), z], &mut y);
                let f: f64 = y.iter().zip(&a).map(|(y, a)| y * f64::from(*a)).sum();
                for (sum, y) in truth.iter_mut().zip(&y) {
                    *sum += f * z * y * 0.5 * weight * 2.0 * PI / turns as f64;
                }
            }
        }
        for (value, truth) in result.iter().zip(&truth) {
            // Sums of at most 8 products below 1.
            prop_assert!((f64::from(*value) - truth).abs() <= 1e-6, "{value} {truth}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn products_are_those_of_the_tables(
        (bands, a, b) in (1..=6_usize).prop_flat_map(|bands| (
            Just(bands), coefficients(bands), coefficients(bands),
        )),
    ) {
        let [wide_a, wide_b] =
            [&a, &b].map(|list| list.iter().map(|&value| f64::from(value)).collect::<Vec<_>>());
        let mut truth = vec![0.0; count(bands)];
        Product::new(bands).apply(&wide_a, &wide_b, &mut truth);
        let general = Function::Product.generate(bands).wgsl;
        let arguments = [("a", a.clone()), ("b", b.clone())];
        prop_assert!(difference(&run(&general, &arguments), &truth) <= 1e-5);
        for (function, of) in
            [(Function::CosineProduct, bands), (Function::CosineProductCut, bands.min(CUT))]
        {
            let normal = &b[..count(of)];
            Folded::new(bands, of).apply(&wide_a, &wide_b[..count(of)], &mut truth);
            let arguments = [("a", a.clone()), ("normal", normal.to_vec())];
            prop_assert!(difference(&run(&function.generate(bands).wgsl, &arguments), &truth) <= 1e-5);
        }
    }
}

/// What is even in y in a frame, seen from outside: turned by the inverse rotation.
#[test]
fn even_functions_spread_over_all_coefficients() {
    for bands in [1, 2, 3, 5, 9, 15] {
        let wgsl = Function::SpreadEven.generate(bands).wgsl;
        for normal in directions() {
            let normal = normalised(normal.map(f64::from));
            let axis = [0, 1, 2].map(|i| f64::from(u8::from(i == least(normal))));
            let tangent = normalised(cross(axis, normal));
            let bitangent = cross(normal, tangent);
            let from_frame = [0, 1, 2].map(|i| [tangent[i], bitangent[i], normal[i]]);
            let values: Numbers =
                (0..even_count(bands)).map(|i| ((7 * i + 3) % 11) as f32 / 5.0 - 1.0).collect();
            let mut truth = vec![0.0; count(bands)];
            for l in 0..bands {
                for m in 0..=l {
                    truth[index(l, m as isize)] = f64::from(values[even_index(l, m)]);
                }
            }
            Zxzxz::new(bands).apply(from_frame, &mut truth, &mut vec![0.0; count(bands)]);
            let axes = ["tangent", "bitangent", "normal"].into_iter();
            let names: Vec<_> = axes
                .zip([tangent, bitangent, normal])
                .flat_map(|(name, axis)| {
                    let components = ["x", "y", "z"].into_iter().zip(axis);
                    components.map(move |(c, value)| (format!("{name}.{c}"), vec![value as f32]))
                })
                .collect();
            let mut arguments = vec![("a", values)];
            arguments.extend(names.iter().map(|(name, value)| (&**name, value.clone())));
            let error = difference(&run(&wgsl, &arguments), &truth);
            assert!(error <= 1e-5, "{bands} bands, {normal:?}: {error:e}");
        }
    }
}

fn least(v: [f64; 3]) -> usize {
    (0..3).fold(0, |least, i| if v[i].abs() < v[least].abs() { i } else { least })
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

/// Largest |value − truth|; both are below 10.
fn difference(values: &[f32], truth: &[f64]) -> f64 {
    let pairs = values.iter().zip(truth);
    pairs.map(|(&value, truth)| (f64::from(value) - truth).abs()).fold(0.0, f64::max)
}

#[test]
fn modules_are_the_same_text_for_the_same_set() {
    let one = module(3, &[Function::ZonalDot, Function::Evaluate]);
    let two = module(3, &[Function::Evaluate, Function::ZonalDot, Function::Evaluate]);
    assert_eq!(one, two);
    assert_eq!(one.matches("fn ").count(), 2);
}

#[test]
fn operations_of_few_bands() {
    let cost = |function: Function, bands| {
        let operations = function.generate(bands).operations;
        (operations.additions, operations.multiplications)
    };
    // Known by hand: 3x, y, z scaled.
    assert_eq!(cost(Function::Evaluate, 2), (0, 3));
    assert_eq!(cost(Function::Dot, 5), (24, 25));
    assert_eq!(cost(Function::DotEven, 5), (14, 15));
    // Of the matrix of 4.6 a multiplication a non-zero, and an addition less a row.
    for bands in [3, 5, 9] {
        let non_zeros = Local::<f64>::new(bands).non_zeros();
        let expected = (non_zeros - count(bands), non_zeros);
        assert_eq!(cost(Function::ClampedCosine, bands), expected);
    }
}
