//! The Lambertian lobe as a zonal function about the normal, and its WGSL.
//!
//! Under a specular layer it is diffuse/π T(n·v) T(n·l) with T(c) = a − b (1 − c)⁵: on harmonics
//! a K − b G with K(c) = c, G(c) = c (1 − c)⁵ for c > 0. Without that layer it is K.

use std::f64::consts::PI;

use manylights_harmonics::clamped_cosine;
use manylights_harmonics::quadrature::gauss_legendre;
use manylights_harmonics::zonal::evaluate;
use manylights_scene::DBrdf;

use crate::expansion::Damping;

/// [a, b] of the transmission T.
pub fn transmission(brdf: &DBrdf) -> [f64; 2] {
    let facing = brdf.transmission(1.0);
    [facing, facing - brdf.transmission(0.0)]
}

/// (2l + 1)/4π times the scales of K and of G, under a window found for K: what a double product with
/// a cap's scales and P_l wants.
pub fn lobes(bands: usize, damping: Damping) -> Vec<[f64; 2]> {
    let mut cosine = vec![0.0; bands];
    clamped_cosine::scales(&mut cosine);
    let grazing = zonal_scales(bands, |c| c * (1.0 - c).powi(5));
    let weights = damping.of_zonal(&cosine);
    let pairs = cosine.into_iter().zip(grazing).zip(weights).enumerate();
    let normalised = |(l, ((k, g), weight))| [k, g].map(|scale: f64| scale * weight * addition(l));
    pairs.map(normalised).collect()
}

/// Coefficients of Y_l0 of (1 − |c|)⁵; those of odd l vanish.
pub fn mirrored_grazing(bands: usize) -> Vec<f64> {
    let scales = zonal_scales(bands, |c| (1.0 - c).powi(5));
    let coefficient = |(l, scale): (usize, f64)| {
        if l % 2 == 0 { 2.0 * scale * addition(l).sqrt() } else { 0.0 }
    };
    scales.into_iter().enumerate().map(coefficient).collect()
}

/// Scales of a polynomial in the cosine over the upper hemisphere, of degree up to 11.
fn zonal_scales(bands: usize, value: impl Fn(f64) -> f64) -> Vec<f64> {
    let nodes = gauss_legendre(bands + 6);
    let scale = |l: usize| {
        // evaluate() of a unit vector is (2l + 1)/4π P_l.
        let mut unit = vec![0.0; l + 1];
        unit[l] = 1.0 / addition(l);
        let term = |&(node, weight): &(f64, f64)| {
            let c: f64 = 0.5 + 0.5 * node;
            weight * PI * value(c) * evaluate(&unit, c)
        };
        nodes.iter().map(term).sum()
    };
    (0..bands).map(scale).collect()
}

/// (2l + 1)/4π, of the addition theorem.
pub fn addition(l: usize) -> f64 {
    (2 * l + 1) as f64 / (4.0 * PI)
}

/// A module with, for `bands` bands:
/// - `diffuse_lobe(a: f32, b: f32) -> array<f32, bands>`: a K − b G;
/// - `diffuse_dot(cosine: f32, scales: array<f32, bands>, lobe: array<f32, bands>) -> f32`: its
///   double product with a cap about a direction at this cosine from the normal;
/// - `lambert_dot(cosine: f32, scales: array<f32, bands>) -> f32`: the same for K alone, whose odd
///   bands but l = 1 vanish;
/// - `legendre(cosine: f32) -> array<f32, bands>`: P_l.
pub fn module(bands: usize, damping: Damping) -> String {
    let lobes = lobes(bands, damping);
    let array = format!("array<f32, {bands}>");
    let mix = lobes.iter().map(|[k, g]| format!("a * {:?} - b * {:?}", *k as f32, *g as f32));
    let lobe = mix.collect::<Vec<_>>().join(",\n        ");
    let any: Vec<_> = (0..bands).map(|l| Some(format!("lobe[{l}]"))).collect();
    let own: Vec<_> =
        lobes.iter().map(|&[k, _]| (k != 0.0).then(|| format!("{:?}", k as f32))).collect();
    let (any, own) = (legendre_sum(&any), legendre_sum(&own));
    let names: Vec<_> = (0..bands).map(|l| format!("p{l}")).collect();
    format!(
        "fn diffuse_lobe(a: f32, b: f32) -> {array} {{\n    return {array}(\n        {lobe},\n    );\n}}\n\n\
         fn diffuse_dot(cosine: f32, scales: {array}, lobe: {array}) -> f32 {{\n{any}}}\n\n\
         fn lambert_dot(cosine: f32, scales: {array}) -> f32 {{\n{own}}}\n\n\
         fn legendre(cosine: f32) -> {array} {{\n{}    return {array}({});\n}}\n",
        legendre_values(bands - 1),
        names.join(", "),
    )
}

/// The lines that name P_0 … P_last.
fn legendre_values(last: usize) -> String {
    let mut text = "    let p0 = 1.0;\n    let p1 = cosine;\n".to_owned();
    for l in 1..last {
        let (next, before, n) = (l + 1, l - 1, (l + 1) as f32);
        let (a, b) = ((2 * l + 1) as f32 / n, l as f32 / n);
        text += &format!("    let p{next} = {a:?} * cosine * p{l} - {b:?} * p{before};\n");
    }
    text
}

/// The lines of Σ_l factor_l c_l P_l(cosine).
fn legendre_sum(factors: &[Option<String>]) -> String {
    let last = factors.iter().rposition(Option::is_some).unwrap_or(0);
    let term = |(l, factor): (usize, &Option<String>)| {
        factor.as_ref().map(|factor| format!("{factor} * scales[{l}] * p{l}"))
    };
    let terms: Vec<_> = factors.iter().enumerate().filter_map(term).collect();
    legendre_values(last) + &format!("    return {};\n", terms.join("\n        + "))
}
