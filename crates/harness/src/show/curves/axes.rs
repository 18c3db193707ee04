//! Logarithmic axes that end and are labelled at round numbers.

use std::ops::Range;

use plotters::coord::combinators::{BindKeyPoints, IntoLogRange, LogCoord, WithKeyPoints};

pub(super) type Axis = WithKeyPoints<LogCoord<f64>>;

/// The nearest 1, 2 or 5 times a power of ten around the values, with some room.
pub(super) fn bounds(values: impl IntoIterator<Item = f64>) -> Range<f64> {
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    for value in values {
        (low, high) = (low.min(value), high.max(value));
    }
    let (low, high) = (low / 1.2, high * 1.2);
    if low > high {
        return 0.1..1.0; // nothing to show
    }
    let steps: Vec<f64> = multiples(low / 10.0..high * 10.0, &[1, 2, 5]).collect();
    let start = steps.iter().copied().rfind(|&step| step <= low).unwrap_or(low);
    let end = steps.iter().copied().find(|&step| step >= high).unwrap_or(high);
    start..end
}

/// These multiples of all powers of ten within a range, in order.
fn multiples(range: Range<f64>, digits: &[u32]) -> impl Iterator<Item = f64> {
    let first = range.start.log10().floor() as i32;
    let last = range.end.log10().ceil() as i32;
    // Decimal texts, so that bounds and labels are the same numbers.
    (first..=last)
        .flat_map(move |n| digits.iter().map(move |k| format!("{k}e{n}")))
        .map(|text| text.parse().expect("a number as just written"))
        .filter(move |step| (range.start..=range.end).contains(step))
}

/// An axis with a labelled line at each decade and fine lines between; less than two decades have
/// labels at 2 and 5 as well.
pub(super) fn axis(range: Range<f64>) -> Axis {
    let narrow = range.end / range.start < 100.0;
    let labelled = multiples(range.clone(), if narrow { &[1, 2, 5] } else { &[1] }).collect();
    let fine: Vec<f64> = multiples(range.clone(), &[1, 2, 3, 4, 5, 6, 7, 8, 9]).collect();
    range.log_scale().with_key_points(labelled).with_light_points(fine)
}

/// Labels: plain where that is short.
pub(super) fn label(value: f64) -> String {
    if (1e-4..1e5).contains(&value) { format!("{value}") } else { format!("{value:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_end_at_round_numbers() {
        assert_eq!(bounds([0.0043, 0.125]), 0.002..0.2);
        assert_eq!(bounds([7.0, 5300.0]), 5.0..10_000.0);
        assert_eq!(bounds([]), 0.1..1.0);
        let steps: Vec<f64> = multiples(0.02..1.0, &[1, 5]).collect();
        assert_eq!(steps, [0.05, 0.1, 0.5, 1.0]);
    }
}
