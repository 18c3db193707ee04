//! The WGSL of a pixel's lobe in the world's frame, whose length depends on the bands.
//! Straight lines, since an index that is not known while compiling would keep the lobe out of registers.

use std::f64::consts::PI;

use manylights_harmonics::count;
use manylights_reflectance::{Damping, ReceiverKinds, diffuse};

/// A module with, for N = bands²,
/// - `world_lobe(r: Receiver) -> array<E, N>`: the double product's other factor. Without specular lobes a
///   number each, over the Lambertian reflectance; else one for each channel, all lobes together;
/// - `reflected(r: Receiver, sum: vec3f) -> vec3f`: the radiance of that product.
pub(crate) fn world_lobe(bands: usize, kinds: ReceiverKinds) -> String {
    // The diffuse lobe's values hold (2l + 1)/4π for P_l; here they meet Y_lm at the normal.
    let of_band = |l: usize| 4.0 * PI / (2 * l + 1) as f64;
    let start =
        "import package::receiver::Receiver;\nimport package::sh::sh_evaluate;\n".to_owned();
    let size = count(bands);
    if !kinds.specular {
        let lobes = diffuse::lobes(bands, Damping::None);
        let value = |i: usize| match lobes[i.isqrt()][0] * of_band(i.isqrt()) {
            0.0 => "0.0".to_owned(),
            scale => format!("{:?} * y[{i}]", scale as f32),
        };
        let values: Vec<_> = (0..size).map(value).collect();
        return start
            + &format!(
                "\nfn world_lobe(r: Receiver) -> array<f32, {size}> {{\n    \
                 let y = sh_evaluate(r.normal);\n    \
                 return array<f32, {size}>(\n        {},\n    );\n}}\n\n\
                 fn reflected(r: Receiver, sum: vec3f) -> vec3f {{\n    return r.lambert * sum;\n}}\n",
                values.join(",\n        "),
            );
    }
    let (lobes, specular): (&[_], _) = match (kinds.measured, kinds.colored) {
        (true, _) => (&["lobe", "green", "blue"], "vec3f(lobe[I], green[I], blue[I])"),
        (_, true) => (&["lobe", "grazing"], "r.tint * lobe[I] + grazing[I]"),
        _ => (&["lobe"], "lobe[I]"),
    };
    let declare = |name: &&str| format!("    var {name}: array<f32, {size}>;\n");
    let spread = |name: &&str| {
        format!("        {name} = sh_spread_even(r.tangent, r.bitangent, r.normal, r.{name});\n")
    };
    let scale = |l: usize| {
        let factor = of_band(l) as f32;
        format!("    let d{l} = {factor:?} * r.diffuse[{l}] * r.lambert;\n")
    };
    let value =
        |i: usize| format!("d{} * y[{i}] + {}", i.isqrt(), specular.replace('I', &i.to_string()));
    let values: Vec<_> = (0..size).map(value).collect();
    start
        + &format!(
            "import package::sh::sh_spread_even;\n\n\
             fn world_lobe(r: Receiver) -> array<vec3f, {size}> {{\n    \
             let y = sh_evaluate(r.normal);\n{}{}    if (r.has_specular) {{\n{}    }}\n    \
             return array<vec3f, {size}>(\n        {},\n    );\n}}\n\n\
             fn reflected(r: Receiver, sum: vec3f) -> vec3f {{\n    return sum;\n}}\n",
            (0..bands).map(scale).collect::<String>(),
            lobes.iter().map(declare).collect::<String>(),
            lobes.iter().map(spread).collect::<String>(),
            values.join(",\n        "),
        )
}
