//! The WGSL of what pixels' lobes make of a corner of their cell: straight lines, as those of the lobes.

use manylights_harmonics::count;
use manylights_reflectance::{Damping, diffuse};

use crate::{Settings, Storage};

const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// As unpack4x8snorm() but for the division by 127 and for −128, which was not packed: a third of its operations.
const SIGNED_BYTES: &str = "
fn signed_bytes(word: u32) -> vec4f {
    return vec4f(bitcast<vec4i>(vec4u(word << 24u, word << 16u, word << 8u, word)) >> vec4u(24u));
}
";

/// A module with, for P pixels, `corner_radiance(lobe0: array<E, N>, …, place: u32, weights0, …) -> array<vec3f,
/// P>`: what their lobes make of a corner, where `source[place].values` are its coefficients. The weights meet sums
/// over all coefficients, not each of them, and channels follow each other, so that few sums are held at a time.
pub(crate) fn corner(settings: &Settings, (source, pixels): (&str, usize)) -> String {
    let (size, kinds) = (count(settings.bands), settings.kinds);
    let gradients = settings.scheme.reads_gradients();
    let element = if kinds.specular { "vec3f" } else { "f32" };
    let lobes = diffuse::lobes(settings.bands, Damping::None);
    // Of a Lambertian lobe most odd bands vanish.
    let used: Vec<_> = (0..size).filter(|i| kinds.specular || lobes[i.isqrt()][0] != 0.0).collect();
    let variable = source.split('.').next().unwrap_or(source);
    let stored = Stored { settings, source };
    let each = |text: &dyn Fn(usize) -> String| (0..pixels).map(text).collect::<String>();
    let mut body = stored.scales();
    if gradients {
        for (channel, name) in CHANNELS.into_iter().enumerate() {
            body += &each(&|p| format!("    var {name}{p} = vec4f();\n"));
            for &i in &used {
                let lobe = |p: usize| match kinds.specular {
                    true => format!("lobe{p}[{i}][{channel}]"),
                    false => format!("lobe{p}[{i}]"),
                };
                body += &format!("    let {name}_{i} = {};\n", stored.with_gradient(i, channel));
                body += &each(&|p| format!("    {name}{p} += {} * {name}_{i};\n", lobe(p)));
            }
        }
    } else {
        body += &each(&|p| format!("    var sum{p} = vec3f();\n"));
        for &i in &used {
            body += &format!("    let value_{i} = {};\n", stored.value(i));
            body += &each(&|p| format!("    sum{p} += lobe{p}[{i}] * value_{i};\n"));
        }
    }
    let kind = if gradients { "vec4f" } else { "f32" };
    let bytes = if gradients && stored.is_packed() { SIGNED_BYTES } else { "" };
    format!(
        "import package::bindings::{variable};\n{bytes}\n\
         fn corner_radiance(\n{}    place: u32,\n{}) -> array<vec3f, {pixels}> {{\n\
         {body}    return array<vec3f, {pixels}>(\n{}    );\n}}\n",
        each(&|p| format!("    lobe{p}: array<{element}, {size}>,\n")),
        each(&|p| format!("    weights{p}: {kind},\n")),
        each(&|p| format!("        {},\n", stored.weighted(p))),
    )
}

/// How the numbers at a corner are written.
struct Stored<'a> {
    settings: &'a Settings,
    source: &'a str,
}

impl Stored<'_> {
    fn at(&self, vector: usize) -> String {
        format!("{}[place].values[{vector}]", self.source)
    }

    fn is_packed(&self) -> bool {
        self.settings.storage == Storage::Packed
    }

    /// The lines before all others: the scales of values and, band by band, of gradients.
    fn scales(&self) -> String {
        if !self.is_packed() {
            return String::new();
        }
        let bands = if self.settings.scheme.reads_gradients() { self.settings.bands } else { 0 };
        let band = |l: usize| {
            let scale = format!("bitcast<f32>({}[{}])", self.at(1 + l / 4), l % 4);
            format!("    let band{l} = {scale} * (1.0 / 127.0);\n")
        };
        let values = format!("    let scale = bitcast<vec3f>({}.xyz);\n", self.at(0));
        values + &(0..bands).map(band).collect::<String>()
    }

    /// Of coefficient `i`, value and derivatives; packed values lack their scale.
    fn with_gradient(&self, i: usize, channel: usize) -> String {
        if !self.is_packed() {
            return self.at(3 * i + channel);
        }
        let vector = self.at(self.settings.packed().header + i);
        let (value, gradient) = match channel {
            0 => ("unpack2x16float(V.x).x", "signed_bytes(V.z).xyz"),
            1 => ("unpack2x16float(V.x).y", "signed_bytes(V.w).xyz"),
            _ => ("unpack2x16float(V.y).x", "vec3f(signed_bytes(V.y).zw, signed_bytes(V.z).w)"),
        };
        format!("vec4f({value}, band{} * {gradient})", i.isqrt()).replace('V', &vector)
    }

    /// The values alone of coefficient `i`, of all channels; packed ones lack their scale.
    fn value(&self, i: usize) -> String {
        if !self.is_packed() {
            return format!("{}.xyz", self.at(i));
        }
        let vector = self.at(self.settings.packed().header + i / 2);
        let (first, second) = if i.is_multiple_of(2) { ("x", "y") } else { ("z", "w") };
        format!("vec3f(unpack2x16float({vector}.{first}), unpack2x16float({vector}.{second}).x)")
    }

    /// The radiance of pixel `p`.
    fn weighted(&self, p: usize) -> String {
        let is_packed = self.is_packed();
        if !self.settings.scheme.reads_gradients() {
            return format!("weights{p} * sum{p}{}", if is_packed { " * scale" } else { "" });
        }
        let channel = |(channel, name): (usize, &str)| match is_packed {
            true => format!("dot(weights{p}, {name}{p} * vec4f(scale[{channel}], vec3f(1.0)))"),
            false => format!("dot(weights{p}, {name}{p})"),
        };
        let channels: Vec<_> = CHANNELS.into_iter().enumerate().map(channel).collect();
        format!("vec3f({})", channels.join(", "))
    }
}
