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
    let product = |i: usize| format!("y[{i}] * lobe[{i}]");
    let band = |l: usize| match form {
        Form::Full => {
            let orders = (0..=l).map(|m| product(even_index(l, m)));
            format!("scales[{l}] * ({})", orders.collect::<Vec<_>>().join(" + "))
        }
        Form::Zonal => format!("scales[{l}] * ({})", product(l)),
    };
    let bands_sum: Vec<_> = (0..bands).map(band).collect();
    fetch(size, header)
        + &format!(
            "fn lobe_dot(\n    y: array<f32, {size}>,\n    scales: array<f32, {bands}>,\n    \
             lobe: array<f32, {size}>,\n) -> f32 {{\n    return {};\n}}\n",
            bands_sum.join("\n        + "),
        )
}

/// The same of lobes about the mirror direction (n coefficients), with `lobe_sum(sums: array<vec3f, n>, lobe:
/// array<f32, n>) -> vec3f` for `lobe_dot`: the double product with any function that `sh_bands`
/// ([`Function::Bands`](manylights_harmonics::wgsl::Function::Bands)) has summed about that direction.
pub fn mirror_module(bands: usize) -> String {
    let terms: Vec<_> = (0..bands).map(|l| format!("sums[{l}] * lobe[{l}]")).collect();
    fetch(bands, 0)
        + &format!(
            "fn lobe_sum(sums: array<vec3f, {bands}>, lobe: array<f32, {bands}>) -> vec3f {{\n    \
             return {};\n}}\n",
            terms.join(" + "),
        )
}

/// What fetches lobes of so many coefficients behind a header.
fn fetch(size: usize, header: usize) -> String {
    let value = |i: usize| format!("dot(share, lobe_pair(first + {}u, fraction))", i + header);
    let values: Vec<_> = (0..size).map(value).collect();
    format!(
        "import package::bindings::{LOBES};\n\n\
         const LOBE_SIZE = {size}u;\nconst LOBE_ROW = {}u;\nconst LOBE_TABLE = {}u;\n\n\
         fn lobe_pair(index: u32, fraction: f32) -> vec2f {{\n    \
         return mix({LOBES}[index], {LOBES}[index + LOBE_ROW], fraction);\n}}\n\n\
         fn lobe_mixed(first: u32, fraction: f32, share: vec2f) -> array<f32, {size}> {{\n    \
         return array<f32, {size}>(\n        {},\n    );\n}}\n\n",
        size + header,
        ANGLES * (size + header),
        values.join(",\n        "),
    )
}
