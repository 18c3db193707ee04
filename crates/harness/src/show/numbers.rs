//! Numbers as tables show them.

/// Three significant digits, without an exponent where that is short.
pub(crate) fn short(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    if !(1e-4..1e6).contains(&magnitude) {
        return format!("{value:.2e}");
    }
    // Rounded first: 0.09999 is 0.100.
    let rounded: f64 = format!("{value:.2e}").parse().expect("a number as just written");
    let digits = 2 - rounded.abs().log10().floor() as i32;
    format!("{rounded:.*}", digits.max(0) as usize)
}

/// How many times `base` a value is, as [`short`]; a dash where the base is nothing.
pub(crate) fn ratio(value: f64, base: f64) -> String {
    if base == 0.0 { "—".to_owned() } else { short(value / base) }
}

/// Milliseconds of a time in seconds.
pub(crate) fn milliseconds(seconds: f64) -> String {
    short(1e3 * seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits() {
        let texts = [0.0, 0.012345, 1.0, 98.76, 1234.5, 1.5e7, 2e-6, -0.5].map(short);
        assert_eq!(texts, ["0", "0.0123", "1.00", "98.8", "1230", "1.50e7", "2.00e-6", "-0.500"]);
        assert_eq!([0.099_999, 0.1, 999.9].map(short), ["0.100", "0.100", "1000"]);
        assert_eq!(short(f64::INFINITY), "inf");
        assert_eq!([ratio(3.0, 2.0), ratio(0.0, 0.0), ratio(1.0, 0.0)], ["1.50", "—", "—"]);
        assert_eq!(milliseconds(0.0125), "12.5");
    }
}
