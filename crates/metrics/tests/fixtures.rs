//! Every metric against numpy and scikit-image; `scripts/metrics-fixtures` made the expected values.

use std::collections::BTreeMap;

use crate::common::{combine, gradient, map, noise, picture};
use manylights_metrics::{METRICS, RadianceImage, compare_display, compare_linear};
use serde_json::Value;

/// Image, reference, exposure.
fn fixture(name: &str) -> (RadianceImage, RadianceImage, f32) {
    let ramp = map(&gradient(48, 32), |c| c / 256.0);
    let level = |value| picture(16, 16, move |_, _, _| value);
    let bytes = |width, height, seed| map(&noise(width, height, seed), |c| c / 256.0);
    match name {
        "gradient" => (map(&gradient(48, 32), |c| c / 512.0 + 0.125), ramp, 1.0),
        "noise" => (combine(&ramp, &noise(48, 32, 1), |r, n| r + (n - 128.0) / 1024.0), ramp, 1.0),
        "unrelated" => (bytes(37, 23, 2), bytes(37, 23, 3), 1.0),
        "constant" => (level(0.25), level(0.5), 1.0),
        "identical" => (bytes(20, 20, 4), bytes(20, 20, 4), 1.0),
        "hdr" => {
            let scale = |mantissa: f64, exponent: f64| {
                (mantissa + 1.0) * f64::exp2((exponent / 8.0).floor() - 20.0)
            };
            let hdr = combine(&noise(40, 30, 5), &noise(40, 30, 6), scale);
            let noisy = combine(&hdr, &noise(40, 30, 7), |r, n| r * (1.0 + (n - 128.0) / 512.0));
            (noisy, hdr, f32::exp2(-6.0))
        }
        "fireflies" => {
            let add = |r: f64, n: f64| r + if n > 250.0 { 4096.0 } else { 0.0 };
            (combine(&ramp, &noise(48, 32, 8), add), ramp, 1.0)
        }
        "dark" => {
            let dark = |offset: f64| move |n: f64| (n + offset) / f64::exp2(20.0);
            let values = noise(24, 24, 9);
            (map(&values, dark(16.0)), map(&values, dark(24.0)), 2048.0)
        }
        "smallest" => (bytes(11, 11, 10), map(&gradient(11, 11), |c| c / 128.0), 1.0),
        _ => panic!("fixture `{name}` is not made here"),
    }
}

/// The means agree to the rounding of sums in another order, SSIM to the 1e-6 that is asked of it.
fn assert_agrees(label: &str, id: &str, found: f64, expected: Option<f64>) {
    let Some(expected) = expected else {
        assert_eq!((id, found), ("psnr", f64::INFINITY), "{label}");
        return;
    };
    let tolerance = if id == "ssim" { 1e-6 } else { 1e-9 * expected.abs() };
    assert!(
        (found - expected).abs() <= tolerance,
        "{label}: {id} is {found}, expected {expected} within {tolerance}"
    );
}

#[test]
fn metrics_agree_with_numpy_and_scikit_image() {
    let expected: BTreeMap<String, BTreeMap<String, Value>> =
        serde_json::from_str(include_str!("fixtures.json")).expect("valid JSON");
    assert_eq!(expected.len(), 9);
    for (name, values) in &expected {
        let (image, reference, exposure) = fixture(name);
        let linear = compare_linear(&image, &reference).expect("comparable");
        let display = compare_display(&image, &reference, exposure).expect("comparable");
        for (referred, errors) in [("linear", linear), ("display", display)] {
            for metric in METRICS {
                let label = format!("{name}, {referred}");
                let expected = values[referred][metric.id].as_f64();
                assert_agrees(&label, metric.id, (metric.value)(&errors), expected);
            }
        }
    }
}
