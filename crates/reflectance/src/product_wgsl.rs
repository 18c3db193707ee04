//! What `shaders/product.wesl` imports: modules whose lengths and constants depend on the bands.

use manylights_harmonics::wgsl::{self, CUT, Function};
use manylights_harmonics::{clamped_cosine, count, even_count, even_index};

use crate::diffuse::{addition, lobes, mirrored_grazing};
use crate::{CosineProduct, Damping};

impl CosineProduct {
    /// Names and texts of what `product` imports, made for a number of bands: `sh`, which has `CapScalesOf`
    /// beside, `sh_cut` for [`CUT`] bands at most, and `product_sums`.
    pub fn modules(self, bands: usize) -> [(&'static str, String); 3] {
        let mut functions = vec![Function::CapScalesOf];
        functions.extend(self.steps());
        functions.extend(match self {
            Self::Local => [Function::EvaluateEven, Function::BandsEven],
            Self::Turned => [Function::Evaluate, Function::BandsEven],
            _ => [Function::Evaluate, Function::Bands],
        });
        [
            ("sh", wgsl::module(bands, &functions)),
            ("sh_cut", wgsl::module(bands.min(CUT), &[Function::Evaluate, Function::Bands])),
            ("product_sums", sums(bands, self)),
        ]
    }
}

/// A module with, for `S` coefficients of a light, those of m ≥ 0 where it is summed in the surface's frame,
/// - `Sum`: `light: array<vec3f, S>`;
/// - `add_zonal(sum: ptr<function, Sum>, radiance: vec3f, scales: array<f32, n>, y: array<f32, S>)`: adds
///   a zonal function whose Y_lm at its axis are `y`;
/// - `cosine_about(y: array<f32, n²>) -> array<f32, n²>`: the expansion of the cosine about a normal;
/// - `grazing_sum`: of the product with the cosine the double product with (1 − cosine)⁵, from its sums
///   about the normal, or from the product in the surface's frame;
/// - `first_bands(light) -> array<vec3f, M>` and `three_bands`: of M coefficients, the double product with
///   x cos⁺ − y cos⁺ (1 − cos)⁵, from sums about the normal or from a light in the surface's frame.
fn sums(bands: usize, product: CosineProduct) -> String {
    let (all, half, cut) = (count(bands), even_count(bands), bands.min(CUT));
    let size = if product.is_local() { half } else { all };
    let orders = |l: usize| if product.is_local() { l + 1 } else { 2 * l + 1 };
    let degrees = (0..bands).flat_map(|l| std::iter::repeat_n(l, orders(l)));
    let adds: String = degrees
        .enumerate()
        .map(|(i, l)| format!("    (*sum).light[{i}] += radiance * (scales[{l}] * y[{i}]);\n"))
        .collect();
    let mut cosine = vec![0.0; bands];
    clamped_cosine::scales(&mut cosine);
    let about: Vec<_> =
        (0..all).map(|i| format!("{:?} * y[{i}]", cosine[i.isqrt()] as f32)).collect();
    let in_frame = product.is_in_frame();
    // About the normal coefficients are scales times Y_l0, which is √((2l + 1)/4π) there.
    let grazing = mirrored_grazing(bands).into_iter().enumerate().map(|(l, coefficient)| {
        if in_frame { coefficient } else { coefficient / addition(l).sqrt() }
    });
    let [of_frame, of_light] = [in_frame, product.is_local()];
    let place = |l: usize, frame| if frame { even_index(l, 0) } else { l };
    let grazing: Vec<_> = grazing
        .enumerate()
        .filter(|(_, factor)| *factor != 0.0)
        .map(|(l, factor)| format!("{:?} * sums[{}]", factor as f32, place(l, of_frame)))
        .collect();
    let three: Vec<_> = lobes(bands, Damping::None)
        .into_iter()
        .take(cut)
        .enumerate()
        .map(|(l, pair)| {
            let unit = if of_light { addition(l).sqrt() } else { addition(l) };
            let [k, g] = pair.map(|value| (value / unit) as f32);
            format!("(entering.x * {k:?} - entering.y * {g:?}) * sums[{}]", place(l, of_light))
        })
        .collect();
    let first: Vec<_> = (0..count(cut)).map(|i| format!("light[{i}]")).collect();
    let grazing_sums = if of_frame { half } else { bands };
    let three_sums = if of_light { half } else { cut };
    format!(
        "struct Sum {{\n    light: array<vec3f, {size}>,\n}}\n\n\
         fn add_zonal(\n    sum: ptr<function, Sum>,\n    radiance: vec3f,\n    \
         scales: array<f32, {bands}>,\n    y: array<f32, {size}>,\n) {{\n{adds}}}\n\n\
         fn cosine_about(y: array<f32, {all}>) -> array<f32, {all}> {{\n    \
         return array<f32, {all}>(\n        {},\n    );\n}}\n\n\
         fn grazing_sum(sums: array<vec3f, {grazing_sums}>) -> vec3f {{\n    return {};\n}}\n\n\
         fn first_bands(light: array<vec3f, {all}>) -> array<vec3f, {}> {{\n    \
         return array<vec3f, {}>({});\n}}\n\n\
         fn three_bands(sums: array<vec3f, {three_sums}>, entering: vec2f) -> vec3f {{\n    \
         return {};\n}}\n",
        about.join(",\n        "),
        grazing.join(" + "),
        first.len(),
        first.len(),
        first.join(", "),
        three.join("\n        + "),
    )
}
