//! The Lambertian lobe as a zonal function about the normal, and its WGSL.
//!
//! Under a specular layer it is diffuse/π (1 − F(n·v)) (a K − b G) with K(c) = c, G(c) = c (1 − c)⁵
//! for c > 0, a = 1 − max f0, b = f90 − max f0: the coupling 1 − F(n·l) of the reflectance is linear
//! in (1 − c)⁵. Without that layer it is K.

use std::f64::consts::PI;

use manylights_harmonics::clamped_cosine;
use manylights_harmonics::quadrature::gauss_legendre;
use manylights_harmonics::zonal::evaluate;

/// (2l + 1)/4π times the scales of K: what a double product with a cap's scales and P_l wants.
pub fn cosine(bands: usize) -> Vec<f64> {
    let mut scales = vec![0.0; bands];
    clamped_cosine::scales(&mut scales);
    normalised(scales)
}

/// The same for G.
pub fn grazing(bands: usize) -> Vec<f64> {
    let nodes = gauss_legendre(bands + 6);
    let scale = |l: usize| {
        // evaluate() of a unit vector is (2l + 1)/4π P_l.
        let mut unit = vec![0.0; l + 1];
        unit[l] = 4.0 * PI / (2 * l + 1) as f64;
        let term = |&(node, weight): &(f64, f64)| {
            let c: f64 = 0.5 + 0.5 * node;
            weight * PI * c * (1.0 - c).powi(5) * evaluate(&unit, c)
        };
        nodes.iter().map(term).sum()
    };
    normalised((0..bands).map(scale).collect())
}

fn normalised(scales: Vec<f64>) -> Vec<f64> {
    let weight = |(l, scale): (usize, f64)| (2 * l + 1) as f64 / (4.0 * PI) * scale;
    scales.into_iter().enumerate().map(weight).collect()
}

/// A module with, for `bands` bands:
/// - `diffuse_lobe(a: f32, b: f32) -> array<f32, bands>`: a K − b G;
/// - `diffuse_dot(cosine: f32, scales: array<f32, bands>, lobe: array<f32, bands>) -> f32`: its
///   double product with a cap about a direction at this cosine from the normal;
/// - `lambert_dot(cosine: f32, scales: array<f32, bands>) -> f32`: the same for K alone, whose odd
///   bands but l = 1 vanish.
pub fn module(bands: usize) -> String {
    let (k, g) = (cosine(bands), grazing(bands));
    let array = format!("array<f32, {bands}>");
    let mix = k.iter().zip(&g).map(|(k, g)| format!("a * {:?} - b * {:?}", *k as f32, *g as f32));
    let lobe = mix.collect::<Vec<_>>().join(",\n        ");
    let any: Vec<_> = (0..bands).map(|l| Some(format!("lobe[{l}]"))).collect();
    let own: Vec<_> = k.iter().map(|&k| (k != 0.0).then(|| format!("{:?}", k as f32))).collect();
    let (any, own) = (legendre_sum(&any), legendre_sum(&own));
    format!(
        "fn diffuse_lobe(a: f32, b: f32) -> {array} {{\n    return {array}(\n        {lobe},\n    );\n}}\n\n\
         fn diffuse_dot(cosine: f32, scales: {array}, lobe: {array}) -> f32 {{\n{any}}}\n\n\
         fn lambert_dot(cosine: f32, scales: {array}) -> f32 {{\n{own}}}\n"
    )
}

/// The lines of Σ_l factor_l c_l P_l(cosine).
fn legendre_sum(factors: &[Option<String>]) -> String {
    let last = factors.iter().rposition(Option::is_some).unwrap_or(0);
    let mut text = "    let p0 = 1.0;\n    let p1 = cosine;\n".to_owned();
    for l in 1..last {
        let (next, before, n) = (l + 1, l - 1, (l + 1) as f32);
        let (a, b) = ((2 * l + 1) as f32 / n, l as f32 / n);
        text += &format!("    let p{next} = {a:?} * cosine * p{l} - {b:?} * p{before};\n");
    }
    let term = |(l, factor): (usize, &Option<String>)| {
        factor.as_ref().map(|factor| format!("{factor} * scales[{l}] * p{l}"))
    };
    let terms: Vec<_> = factors.iter().enumerate().filter_map(term).collect();
    text + &format!("    return {};\n", terms.join("\n        + "))
}
