//! Cap scales in a form that keeps its digits for small caps and for many bands.
//!
//! c_0 = 2π s²/(1 + α), c_l = 2π s² P'_l(α)/(l(l + 1)), ∂c_l/∂α = −2π P_l(α), from thesis
//! 3.10 and 3.32 by (1 − x²)P'_l = l(l + 1)(P_{l−1} − P_{l+1})/(2l + 1).
//!
//! Deviation: where α → 1 the three-term recurrences of P_l and P'_l lose a digit every few bands.
//! So they run on differences, with 1 − α = s²/(1 + α) (Reinsch's modification, as for
//! trigonometric sums): c_{l+1} = c_l + δ_l, δ_l = ((l − 1) δ_{l−1} − (2l + 1)(1 − α) c_l)/(l + 2).

use super::lines::{Factor, Lines};

pub(super) fn scales(bands: usize) -> Lines {
    let (lines, values) = name_scales(bands, false);
    lines.give_array("f32", &values)
}

/// Of sine and cosine.
pub(super) fn scales_of_both(bands: usize) -> Lines {
    let (lines, values) = name_scales(bands, true);
    lines.give_array("f32", &values)
}

/// Of sine and cosine, with the derivatives by the cosine, which step alike.
pub(super) fn scales_with_rate(bands: usize) -> Lines {
    let (mut lines, values) = name_scales(bands, true);
    lines.bind("r0", Factor::Constant(-std::f64::consts::TAU));
    name_differences(&mut lines, "r", "f", 0, bands, |l| (l, 2.0 * l + 1.0, l + 1.0));
    let pairs = values.iter().enumerate().map(|(l, value)| format!("vec2f({value}, r{l})"));
    lines.give_array("vec2f", &pairs.collect::<Vec<_>>())
}

fn name_scales(bands: usize, cosine_is_given: bool) -> (Lines, Vec<String>) {
    let mut lines = Lines::default();
    if cosine_is_given {
        lines.bind("s2", "sine * sine");
    } else {
        lines.bind("s", "min(sine, 1.0)");
        lines.bind("s2", "s * s");
        lines.bind("cosine", "sqrt((1.0 - s) * (1.0 + s))");
    }
    lines.bind("versine", "s2 / (1.0 + cosine)");
    lines.bind("k", format_args!("{} * s2", Factor::Constant(std::f64::consts::TAU)));
    let tau = Factor::Constant(std::f64::consts::TAU);
    lines.bind("c0", format_args!("{tau} * versine"));
    if bands > 1 {
        lines.bind("c1", "0.5 * k");
    }
    name_differences(&mut lines, "c", "d", 1, bands, |l| (l - 1.0, 2.0 * l + 1.0, l + 2.0));
    (lines, (0..bands).map(|l| format!("c{l}")).collect())
}

/// `value`_{l+1} = `value`_l + `step`_l, `step`_l = (p `step`_{l−1} − q versine `value`_l)/r, from
/// l = `first` on, where p = 0.
fn name_differences(
    lines: &mut Lines,
    value: &str,
    step: &str,
    first: usize,
    bands: usize,
    factors: impl Fn(f64) -> (f64, f64, f64),
) {
    for l in first..bands.saturating_sub(1) {
        let (p, q, r) = factors(l as f64);
        let name = format!("{step}{l}");
        let pull = Factor::Constant(q / r);
        if l == first {
            lines.bind(&name, format_args!("{} * versine * {value}{l}", Factor::Constant(-q / r)));
        } else {
            let push = Factor::Constant(p / r);
            let before = l - 1;
            lines.bind(
                &name,
                format_args!("{push} * {step}{before} - {pull} * versine * {value}{l}"),
            );
        }
        lines.bind(&format!("{value}{}", l + 1), format_args!("{value}{l} + {name}"));
    }
}
