//! Turns between frames, as [`crate::rotation::Zxzxz`] makes them.

use super::lines::{Factor, Lines, product, sum};
use crate::rotation::Zxzxz;
use crate::{count, even_count, even_index, index};

/// Below this sine, ε² of f32, nothing is turned about the second axis.
const SMALLEST_SINE: f32 = f32::EPSILON * f32::EPSILON;

/// The last turn leaves out m < 0.
pub(super) fn turn_even(bands: usize) -> Lines {
    let mut lines = Lines::default();
    name_turns(&mut lines, bands, false);
    let given: Vec<_> = (0..count(bands)).map(|i| Factor::element("a", i)).collect();
    let quarter = Zxzxz::<f64>::new(bands);
    let once = about_z(&mut lines, "c", bands, &given);
    let tilted = about_x(&mut lines, "t", quarter.non_zeros(), &once);
    let twice = about_z(&mut lines, "b", bands, &tilted);
    let back = about_x(&mut lines, "u", transposed(&quarter), &twice);
    let mut halves = vec![String::new(); even_count(bands)];
    for l in 0..bands {
        for m in 0..=l {
            halves[even_index(l, m)] = turned(&back, "a", l, m)[0].clone();
        }
    }
    lines.give_array("vec3f", &halves)
}

/// The adjoint: the same turns backwards, in the opposite order.
pub(super) fn spread_even(bands: usize) -> Lines {
    let mut lines = Lines::default();
    name_turns(&mut lines, bands, true);
    let mut given = vec![Factor::Constant(0.0); count(bands)];
    for l in 0..bands {
        for m in 0..=l {
            let half = Factor::element("a", even_index(l, m));
            if m == 0 {
                given[index(l, 0)] = half;
                continue;
            }
            let [up, down] = [index(l, m as isize), index(l, -(m as isize))];
            given[up] = lines.bind(&format!("a{up}"), format_args!("ca{m} * {half}"));
            given[down] = lines.bind(&format!("a{down}"), format_args!("sa{m} * {half}"));
        }
    }
    let quarter = Zxzxz::<f64>::new(bands);
    let tilted = about_x(&mut lines, "t", quarter.non_zeros(), &given);
    let turned = about_z(&mut lines, "b", bands, &tilted);
    let back = about_x(&mut lines, "u", transposed(&quarter), &turned);
    let spread = about_z(&mut lines, "c", bands, &back);
    lines.give_array("f32", &spread.iter().map(Factor::to_string).collect::<Vec<_>>())
}

/// Of the angles of [`Zxzxz`], or of their opposites.
fn name_turns(lines: &mut Lines, bands: usize, is_back: bool) {
    if bands == 1 {
        return;
    }
    let sign = if is_back { "-" } else { "" };
    lines.bind("tilt", "sqrt(tangent.z * tangent.z + bitangent.z * bitangent.z)");
    let of_tilt = |zero: &str, component: &str| {
        format!("select({zero}, {component} / tilt, {SMALLEST_SINE:?} < tilt)")
    };
    lines.bind("sine", of_tilt("0.0", "bitangent.z"));
    lines.bind("ca1", of_tilt("1.0", "tangent.z"));
    lines.bind("sa1", format_args!("{sign}sine"));
    lines.bind("sb1", format_args!("{sign}tilt"));
    lines.bind("cb1", "normal.z");
    lines.bind("sc1", format_args!("{sign}(ca1 * bitangent.x - sine * tangent.x)"));
    lines.bind("cc1", "ca1 * bitangent.y - sine * tangent.y");
    for angle in ["a", "b", "c"] {
        name_multiples(lines, angle, bands);
    }
}

/// The inverse of an orthogonal matrix.
fn transposed(quarter: &Zxzxz<f64>) -> impl Iterator<Item = (usize, usize, f64)> {
    quarter.non_zeros().map(|(row, column, value)| (column, row, value))
}

/// Sines and cosines of m times an angle, from those of the angle.
fn name_multiples(lines: &mut Lines, angle: &str, bands: usize) {
    for m in 1..bands.saturating_sub(1) {
        let next = m + 1;
        let [s, c] = [format!("s{angle}{m}"), format!("c{angle}{m}")];
        let [s1, c1] = [format!("s{angle}1"), format!("c{angle}1")];
        lines.bind(&format!("s{angle}{next}"), format_args!("{s} * {c1} + {c} * {s1}"));
        lines.bind(&format!("c{angle}{next}"), format_args!("{c} * {c1} - {s} * {s1}"));
    }
}

/// Coefficients (l, m) and (l, −m) of a function turned about z.
fn turned(before: &[Factor], angle: &str, l: usize, m: usize) -> [String; 2] {
    let even = &before[index(l, m as isize)];
    if m == 0 {
        return [even.to_string(), even.to_string()];
    }
    let odd = &before[index(l, -(m as isize))];
    let (s, c) = (format!("s{angle}{m}"), format!("c{angle}{m}"));
    [format!("{c} * {even} - {s} * {odd}"), format!("{s} * {even} + {c} * {odd}")]
}

fn about_z(lines: &mut Lines, angle: &str, bands: usize, before: &[Factor]) -> Vec<Factor> {
    let mut after = before.to_vec();
    for l in 1..bands {
        for m in 1..=l {
            let [even, odd] = turned(before, angle, l, m);
            let [up, down] = [index(l, m as isize), index(l, -(m as isize))];
            after[up] = lines.bind(&format!("{angle}{up}"), even);
            after[down] = lines.bind(&format!("{angle}{down}"), odd);
        }
    }
    after
}

/// By a sparse matrix (row, column, value).
fn about_x(
    lines: &mut Lines,
    name: &str,
    non_zeros: impl Iterator<Item = (usize, usize, f64)>,
    before: &[Factor],
) -> Vec<Factor> {
    let mut rows = vec![Vec::new(); before.len()];
    for (row, column, value) in non_zeros {
        let factors = [&Factor::Constant(value.abs()), &before[column]];
        rows[row].push((value > 0.0, product(&factors)));
    }
    let bind = |(row, terms): (usize, Vec<_>)| lines.bind(&format!("{name}{row}"), sum(terms));
    rows.into_iter().enumerate().map(bind).collect()
}
