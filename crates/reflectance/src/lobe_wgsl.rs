//! The WGSL that fetches a pixel's specular lobe and multiplies it with a sphere's light: straight
//! lines, since an index that is not known while compiling would keep the lobe out of registers.

use manylights_harmonics::{even_count, even_index};

use crate::expansion::Form;
use crate::lobes::ANGLES;

/// The table that [`module`] reads, of `vec2f`, as it imports it from `package::bindings`.
pub const LOBES: &str = "lobes";

/// A module with, for `N` = n (n + 1)/2 coefficients a lobe of n bands, or n of the zonal form,
/// - `LOBE_SIZE`: N; `LOBE_ROW` and `LOBE_TABLE`: elements a row and a table of [`LOBES`];
/// - `lobe_mixed(first: u32, fraction: f32, share: vec2f) -> array<f32, N>`: of the row at `first` and
///   the next, the first of each pair times share.x plus the second times share.y;
/// - `lobe_dot(y: array<f32, N>, scales: array<f32, n>, lobe: array<f32, N>) -> f32`: the double
///   product with a cap, whose basis functions at its axis are `y`.
pub fn module(bands: usize, form: Form) -> String {
    let (size, header) = match form {
        Form::Full => (even_count(bands), 0),
        // The axis.
        Form::Zonal => (bands, 1),
    };
    let value = |i: usize| format!("dot(share, lobe_pair(first + {}u, fraction))", i + header);
    let values: Vec<_> = (0..size).map(value).collect();
    let product = |i: usize| format!("y[{i}] * lobe[{i}]");
    let band = |l: usize| match form {
        Form::Full => {
            let orders = (0..=l).map(|m| product(even_index(l, m)));
            format!("scales[{l}] * ({})", orders.collect::<Vec<_>>().join(" + "))
        }
        Form::Zonal => format!("scales[{l}] * ({})", product(l)),
    };
    let bands_sum: Vec<_> = (0..bands).map(band).collect();
    format!(
        "import package::bindings::{LOBES};\n\n\
         const LOBE_SIZE = {size}u;\nconst LOBE_ROW = {}u;\nconst LOBE_TABLE = {}u;\n\n\
         fn lobe_pair(index: u32, fraction: f32) -> vec2f {{\n    \
         return mix({LOBES}[index], {LOBES}[index + LOBE_ROW], fraction);\n}}\n\n\
         fn lobe_mixed(first: u32, fraction: f32, share: vec2f) -> array<f32, {size}> {{\n    \
         return array<f32, {size}>(\n        {},\n    );\n}}\n\n\
         fn lobe_dot(\n    y: array<f32, {size}>,\n    scales: array<f32, {bands}>,\n    \
         lobe: array<f32, {size}>,\n) -> f32 {{\n    return {};\n}}\n",
        size + header,
        ANGLES * (size + header),
        values.join(",\n        "),
        bands_sum.join("\n        + "),
    )
}
