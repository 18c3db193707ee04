//! What must hold of the metrics for any pictures.

use crate::common::{combine, map, noise, picture};
use manylights_metrics::{Error, Errors, METRICS, RadianceImage, compare, compare_display};
use manylights_metrics::{compare_linear, display_rmse, false_color};
use proptest::prelude::*;

/// A picture of 12×13 pixels in `[0, 1)`.
fn random(seed: u64) -> RadianceImage {
    map(&noise(12, 13, seed), |c| c / 256.0)
}

fn errors(image: &RadianceImage, reference: &RadianceImage, range: f64) -> Errors {
    compare(image, reference, range).expect("comparable")
}

proptest! {
    #[test]
    fn most_metrics_are_symmetric(a: u64, b: u64) {
        let (a, b) = (random(a), random(b));
        let (forth, back) = (errors(&a, &b, 1.0), errors(&b, &a, 1.0));
        prop_assert_eq!((forth.rmse, forth.mse, forth.mae), (back.rmse, back.mse, back.mae));
        prop_assert_eq!((forth.psnr, forth.smape), (back.psnr, back.smape));
        // The index is symmetric; its two products are rounded in another order.
        prop_assert!((forth.ssim - back.ssim).abs() < 1e-12);
    }

    #[test]
    fn a_picture_equals_itself(seed: u64, exposure in 0.01_f32..100.0) {
        let a = random(seed);
        for found in [errors(&a, &a, 1.0), compare_display(&a, &a, exposure).expect("comparable")] {
            prop_assert_eq!((found.rmse, found.mse, found.mae), (0.0, 0.0, 0.0));
            prop_assert_eq!((found.rel_mse, found.smape, found.psnr), (0.0, 0.0, f64::INFINITY));
            prop_assert_eq!((found.rel_p999, found.rel_mse_trimmed), (0.0, Some(0.0)));
            prop_assert!(found.flip.is_none_or(|flip| flip == 0.0), "FLIP {:?}", found.flip);
            prop_assert!((found.ssim - 1.0).abs() < 1e-12, "ssim {}", found.ssim);
        }
    }

    /// A power of two scales every intermediate value without rounding; the logarithm rounds.
    #[test]
    fn errors_scale_with_the_values(a: u64, b: u64, exponent in -20..20) {
        let scale = f64::exp2(f64::from(exponent));
        let (a, b) = (random(a), random(b));
        let one = errors(&a, &b, 1.0);
        let scaled = errors(&map(&a, |c| scale * c), &map(&b, |c| scale * c), scale);
        prop_assert_eq!(scaled.mse, scale * scale * one.mse);
        prop_assert_eq!((scaled.rmse, scaled.mae), (scale * one.rmse, scale * one.mae));
        prop_assert_eq!((scaled.ssim, scaled.smape), (one.ssim, one.smape));
        prop_assert!((scaled.psnr - one.psnr).abs() < 1e-10);
    }

    #[test]
    fn more_noise_is_a_larger_error(seed: u64, small in 0.01_f64..0.4, factor in 1.2_f64..3.0) {
        let (reference, noise) = (random(seed), random(seed.wrapping_add(1)));
        let noisy = |amount: f64| combine(&reference, &noise, |r, n| r + amount * (n - 0.5));
        let less = errors(&noisy(small), &reference, 1.0);
        let more = errors(&noisy(small * factor), &reference, 1.0);
        for metric in METRICS {
            let (less, more) = ((metric.value)(&less), (metric.value)(&more));
            if metric.display_alone {
                prop_assert_eq!((less, more), (None, None));
                continue;
            }
            let grows = if metric.smaller_is_better { less < more } else { less > more };
            prop_assert!(grows, "{}: {:?} then {:?}", metric.id, less, more);
        }
    }

    #[test]
    fn metrics_stay_in_their_ranges(a: u64, b: u64, exponent in -30..30) {
        let scale = f64::exp2(f64::from(exponent));
        let found = errors(&map(&random(a), |c| scale * c), &random(b), 1.0);
        prop_assert!(found.rmse >= found.mae && found.mae >= 0.0);
        prop_assert!((0.0..=1.0).contains(&found.smape));
        prop_assert!((-1.0..=1.0).contains(&found.ssim));
        prop_assert!(found.rel_mse >= 0.0 && found.rel_mse.is_finite());
        // Nothing is cut off so few components: these are two ways of rounding.
        let trimmed = found.rel_mse_trimmed.expect("known");
        prop_assert!((trimmed - found.rel_mse).abs() <= 1e-12 * found.rel_mse);
    }

    /// Also of pictures that a display clips.
    #[test]
    fn flip_is_symmetric_and_at_most_one(a: u64, b: u64, exposure in 0.01_f32..100.0) {
        let (a, b) = (random(a), random(b));
        let flip = |a, b| compare_display(a, b, exposure).expect("comparable").flip.expect("of displays");
        let (forth, back) = (flip(&a, &b), flip(&b, &a));
        prop_assert_eq!(forth, back);
        prop_assert!((0.0..=1.0).contains(&forth), "{}", forth);
    }
}

#[test]
fn the_range_of_linear_pictures_is_the_largest_component_of_the_reference() {
    let (image, reference) = (random(1), map(&random(2), |c| 8.0 * c));
    let largest = reference.pixels.iter().flatten().copied().fold(0.0, f32::max);
    let linear = compare_linear(&image, &reference).expect("comparable");
    assert_eq!(linear, errors(&image, &reference, f64::from(largest)));
}

#[test]
fn pixels_that_are_not_finite_are_named() {
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let (good, mut bad) = (random(1), random(1));
        bad.pixels[12 * 3 + 5][2] = value;
        bad.pixels[12 * 12 + 11][0] = value;
        let first = |error| match error {
            Error::NonFinite { which, count, column, row } => (which, count, column, row),
            other => panic!("{other}"),
        };
        let display = compare_display(&bad, &good, 1.0).expect_err("not comparable");
        assert_eq!(first(display), ("image", 2, 5, 3));
        let linear = compare_linear(&good, &bad).expect_err("not comparable");
        assert_eq!(first(linear), ("reference", 2, 5, 3));
    }
}

#[test]
fn pictures_that_cannot_be_compared_say_why() {
    let message = |result: Result<Errors, Error>| result.expect_err("not comparable").to_string();
    let (good, black) = (random(1), RadianceImage::black(12, 13));
    let other = RadianceImage::black(13, 12);
    let small = RadianceImage::black(64, 10);
    let torn = RadianceImage { width: 13, ..random(1) };
    assert!(message(compare(&good, &other, 1.0)).contains("12×13 pixels, the reference 13×12"));
    assert!(message(compare(&small, &small, 1.0)).contains("SSIM needs 11×11"));
    assert!(message(compare(&torn, &good, 1.0)).contains("13×13 pixels holds 156"));
    assert!(message(compare_linear(&good, &black)).contains("black"));
    for nothing in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(message(compare(&good, &good, nothing)).contains("range"));
        assert!(message(compare_display(&good, &good, nothing as f32)).contains("exposure"));
    }
}

/// Bit for bit, since checkpoints lie on curves with whole comparisons.
#[test]
fn the_rmse_alone_is_that_of_all_metrics() {
    let (image, reference) = (random(1), random(2));
    let all = compare_display(&image, &reference, 0.7).expect("comparable");
    assert_eq!(display_rmse(&image, &reference, 0.7).expect("comparable"), all.rmse);
    let message =
        |exposure| display_rmse(&image, &reference, exposure).expect_err("none").to_string();
    assert!(message(0.0).contains("exposure"));
    assert!(display_rmse(&image, &RadianceImage::black(13, 12), 1.0).is_err());
}

/// Nothing lies further apart than green and blue, and nothing distracts from them where no edge is.
#[test]
fn green_and_blue_differ_by_one() {
    let plain =
        |shown| picture(24, 20, move |_, _, component| f64::from(u8::from(component == shown)));
    let flip = compare_display(&plain(1), &plain(2), 1.0).expect("comparable").flip;
    assert!(flip.is_some_and(|flip| (flip - 1.0).abs() < 1e-12), "{flip:?}");
}

/// One pixel has 3 of 4800 components, and 4 are cut off.
#[test]
fn trimming_removes_fireflies_and_nothing_else() {
    let (reference, noise) = (picture(40, 40, |_, _, _| 1.0), picture(40, 40, |_, _, _| 1.5));
    let mut spiked = noise.clone();
    spiked.pixels[77] = [1000.0, 2000.0, 500.0];
    let [plain, spiked] = [noise, spiked].map(|image| errors(&image, &reference, 1.0));
    assert!(spiked.rel_mse > 100.0 * plain.rel_mse);
    let [plain, spiked] = [plain, spiked].map(|errors| errors.rel_mse_trimmed.expect("known"));
    assert!((plain - 0.25 / 1.01).abs() < 1e-12 && (spiked - plain).abs() < 1e-12, "{spiked}");
}

/// What was written before there were these metrics.
#[test]
fn errors_without_the_new_metrics_are_read() {
    let found = errors(&random(1), &random(2), 1.0);
    let mut json = serde_json::to_value(found).expect("serialisable");
    let fields = json.as_object_mut().expect("an object");
    assert!(fields.remove("rel_mse_trimmed").is_some_and(|value| value.is_f64()));
    assert!(!fields.contains_key("flip"), "of linear values");
    let old: Errors = serde_json::from_value(json).expect("valid");
    assert_eq!(old, Errors { rel_mse_trimmed: None, flip: None, ..found });
}

#[test]
fn an_infinite_psnr_survives_json() {
    let identical = errors(&random(1), &random(1), 1.0);
    let json = serde_json::to_string(&identical).expect("serialisable");
    assert!(json.contains("\"psnr\":null"), "{json}");
    assert_eq!(serde_json::from_str::<Errors>(&json).expect("valid"), identical);
}

#[test]
fn false_color_is_black_for_none_and_rises_in_lightness() {
    let reference = picture(64, 1, |_, _, _| 1.0);
    let image = picture(64, 1, |column, _, _| 1.0 + f64::from(column) / 32.0);
    let shown = false_color(&image, &reference, 1.0);
    let luminance = |[r, g, b]: [f32; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
    assert_eq!(shown.pixels[0], [0.0; 3]);
    for pair in shown.pixels[..=32].windows(2) {
        assert!(luminance(pair[0]) < luminance(pair[1]), "{pair:?}");
    }
    assert!(shown.pixels[33..].iter().all(|&pixel| pixel == shown.pixels[32]));
    assert!(luminance(shown.pixels[32]) > 0.8);
    let mut bad = image;
    bad.pixels[7][1] = f32::NAN;
    assert_eq!(false_color(&bad, &reference, 1.0).non_finite(), 1);
}
