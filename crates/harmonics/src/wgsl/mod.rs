//! WGSL generated for a number of bands: straight-line, normalisation folded into the constants,
//! shared subexpressions named once (in the manner of Sloan 2013's generator).
//!
//! Directions are unit vectors in the frame of the expansion; [`crate::index`] orders `array<f32,
//! bands²>`. Functions named `…_even` work on the m ≥ 0 half in the order of
//! [`crate::even_index`]: all that is left of a function even in y, such as the cosine-weighted
//! lobe of an isotropic BRDF seen from the xz-plane.
//!
//! The text depends on nothing but the bands and the set of functions, so it can key a cache.

mod basis;
mod cap;
mod gradient;
mod lines;
pub mod order;
mod order_scope;
pub mod polygon;
mod product;
mod rotation;

pub use lines::Operations;

use crate::{count, even_count};

/// A function that [`module`] can hold. `N` = bands², `H` = bands (bands + 1)/2, `n` = bands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Function {
    /// `sh_evaluate(direction: vec3f) -> array<f32, N>`: Y_lm.
    Evaluate,
    /// `sh_evaluate_even(direction: vec3f) -> array<f32, H>`: Y_lm of m ≥ 0.
    EvaluateEven,
    /// `sh_evaluate_with_gradient(direction: vec3f) -> array<vec4f, N>`: in w the value, in xyz the
    /// tangential gradient ∇R − l Y ω on the unit sphere. Finite on the poles. The gradient with
    /// respect to a point at distance d is 1/d of it.
    EvaluateWithGradient,
    /// `cap_scales(sine: f32) -> array<f32, n>`: c_l of a sphere of radius r at distance d,
    /// `sine` = r/d; its coefficients about the direction ω are c_l Y_lm(ω). Inside the sphere
    /// (`sine` > 1) the cap is the hemisphere.
    CapScales,
    /// `cap_scales_of(sine: f32, cosine: f32) -> array<f32, n>`: the same of both, for caps near the
    /// hemisphere, whose cosine a rounded sine does not tell.
    CapScalesOf,
    /// `cap_scales_with_rate(sine: f32, cosine: f32) -> array<vec2f, n>`: c_l and ∂c_l/∂cos a = −2π
    /// P_l(cos a), which times a gradient of the cosine is that of c_l, whatever tells the cap.
    CapScalesWithRate,
    /// `sh_dot(a: array<f32, N>, b: array<f32, N>) -> f32`: the double product (thesis 2.46).
    Dot,
    /// `sh_dot_even(a: array<f32, H>, b: array<f32, H>) -> f32`.
    DotEven,
    /// `sh_zonal_dot(direction: vec3f, scales: array<f32, n>, b: array<f32, N>) -> f32`: the double
    /// product of c_l Y_lm(direction) and b, without the array of c_l Y_lm.
    ZonalDot,
    /// `sh_zonal_dot_even(direction: vec3f, scales: array<f32, n>, b: array<f32, H>) -> f32`.
    ZonalDotEven,
    /// `sh_bands(direction: vec3f, b: array<vec3f, N>) -> array<vec3f, n>`: Σ_m Y_lm(direction) b_lm,
    /// band by band: the double product with any zonal function about that direction is the sum of
    /// these times its scales.
    Bands,
    /// `sh_bands_even(direction: vec3f, b: array<vec3f, H>) -> array<vec3f, n>`.
    BandsEven,
    /// `sh_product(a: array<vec3f, N>, b: array<f32, N>) -> array<vec3f, N>`: the SH product of any two
    /// functions (thesis 2.48).
    Product,
    /// `sh_cosine_product(a: array<vec3f, N>, normal: array<f32, N>) -> array<vec3f, N>`: the SH product
    /// of a and the expansion of the clamped cosine about a normal, whose Y_lm are given (thesis 4.5).
    CosineProduct,
    /// `sh_cosine_product_cut(a: array<vec3f, N>, normal: array<f32, M>) -> array<vec3f, N>`: the same
    /// with [`CUT`] bands of the cosine at most; M is the number of their coefficients.
    CosineProductCut,
    /// `sh_clamped_cosine(a: array<vec3f, N>) -> array<vec3f, N>`: the SH product of a and max(0, z)
    /// (thesis 4.6).
    ClampedCosine,
    /// `sh_clamped_cosine_even(a: array<vec3f, H>) -> array<vec3f, H>`.
    ClampedCosineEven,
    /// `sh_turn_even(tangent: vec3f, bitangent: vec3f, normal: vec3f, a: array<vec3f, N>) ->
    /// array<vec3f, H>`: what a function is in the frame of these axes (x, y, z), its half even in y, by
    /// [`crate::rotation::Zxzxz`].
    TurnEven,
    /// `sh_spread_even(tangent: vec3f, bitangent: vec3f, normal: vec3f, a: array<f32, H>) -> array<f32, N>`:
    /// what a function that is even in y in the frame of these axes is outside of it: the adjoint of `TurnEven`.
    SpreadEven,
}

/// Bands of the clamped cosine that hold most of it (thesis 4.1.3, l₂ < 3).
pub const CUT: usize = 3;

/// One WGSL function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Generated {
    /// Its declaration.
    pub wgsl: String,
    /// What one call costs at most: before the compiler joins products and sums. With coefficients
    /// of `vec3f`, what one channel alone would cost.
    pub operations: Operations,
}

impl Function {
    /// All of them.
    pub const ALL: [Self; 19] = [
        Self::Evaluate,
        Self::EvaluateEven,
        Self::EvaluateWithGradient,
        Self::CapScales,
        Self::CapScalesOf,
        Self::CapScalesWithRate,
        Self::Dot,
        Self::DotEven,
        Self::ZonalDot,
        Self::ZonalDotEven,
        Self::Bands,
        Self::BandsEven,
        Self::Product,
        Self::CosineProduct,
        Self::CosineProductCut,
        Self::ClampedCosine,
        Self::ClampedCosineEven,
        Self::TurnEven,
        Self::SpreadEven,
    ];

    /// The declaration for `bands` ≥ 1 bands.
    pub fn generate(self, bands: usize) -> Generated {
        let (n, all, half) = (bands, count(bands), even_count(bands));
        let (signature, body) = match self {
            Self::Evaluate => (
                format!("sh_evaluate(direction: vec3f) -> array<f32, {all}>"),
                basis::evaluate(n, false),
            ),
            Self::EvaluateEven => (
                format!("sh_evaluate_even(direction: vec3f) -> array<f32, {half}>"),
                basis::evaluate(n, true),
            ),
            Self::EvaluateWithGradient => (
                format!("sh_evaluate_with_gradient(direction: vec3f) -> array<vec4f, {all}>"),
                gradient::evaluate_with_gradient(n),
            ),
            Self::CapScales => {
                (format!("cap_scales(sine: f32) -> array<f32, {n}>"), cap::scales(n))
            }
            Self::CapScalesOf => (
                format!("cap_scales_of(sine: f32, cosine: f32) -> array<f32, {n}>"),
                cap::scales_of_both(n),
            ),
            Self::CapScalesWithRate => (
                format!("cap_scales_with_rate(sine: f32, cosine: f32) -> array<vec2f, {n}>"),
                cap::scales_with_rate(n),
            ),
            Self::Dot => (
                format!("sh_dot(a: array<f32, {all}>, b: array<f32, {all}>) -> f32"),
                product::dot(n, false),
            ),
            Self::DotEven => (
                format!("sh_dot_even(a: array<f32, {half}>, b: array<f32, {half}>) -> f32"),
                product::dot(n, true),
            ),
            Self::ZonalDot => (
                format!(
                    "sh_zonal_dot(direction: vec3f, scales: array<f32, {n}>, \
                     b: array<f32, {all}>) -> f32"
                ),
                basis::zonal_dot(n, false),
            ),
            Self::ZonalDotEven => (
                format!(
                    "sh_zonal_dot_even(direction: vec3f, scales: array<f32, {n}>, \
                     b: array<f32, {half}>) -> f32"
                ),
                basis::zonal_dot(n, true),
            ),
            Self::Bands => (
                format!("sh_bands(direction: vec3f, b: array<vec3f, {all}>) -> array<vec3f, {n}>"),
                basis::bands(n, false),
            ),
            Self::BandsEven => (
                format!(
                    "sh_bands_even(direction: vec3f, b: array<vec3f, {half}>) -> \
                     array<vec3f, {n}>"
                ),
                basis::bands(n, true),
            ),
            Self::Product => (
                format!(
                    "sh_product(a: array<vec3f, {all}>, b: array<f32, {all}>) -> \
                     array<vec3f, {all}>"
                ),
                product::general(n),
            ),
            Self::CosineProduct => (
                format!(
                    "sh_cosine_product(a: array<vec3f, {all}>, normal: array<f32, {all}>) -> \
                     array<vec3f, {all}>"
                ),
                product::folded(n, n),
            ),
            Self::CosineProductCut => (
                format!(
                    "sh_cosine_product_cut(a: array<vec3f, {all}>, normal: array<f32, {}>) -> \
                     array<vec3f, {all}>",
                    count(n.min(CUT))
                ),
                product::folded(n, n.min(CUT)),
            ),
            Self::ClampedCosine => (
                format!("sh_clamped_cosine(a: array<vec3f, {all}>) -> array<vec3f, {all}>"),
                product::clamped_cosine(n, false),
            ),
            Self::ClampedCosineEven => (
                format!("sh_clamped_cosine_even(a: array<vec3f, {half}>) -> array<vec3f, {half}>"),
                product::clamped_cosine(n, true),
            ),
            Self::TurnEven => (
                format!(
                    "sh_turn_even(tangent: vec3f, bitangent: vec3f, normal: vec3f, \
                     a: array<vec3f, {all}>) -> array<vec3f, {half}>"
                ),
                rotation::turn_even(n),
            ),
            Self::SpreadEven => (
                format!(
                    "sh_spread_even(tangent: vec3f, bitangent: vec3f, normal: vec3f, \
                     a: array<f32, {half}>) -> array<f32, {all}>"
                ),
                rotation::spread_even(n),
            ),
        };
        body.function(&signature)
    }
}

/// A WGSL module with `BANDS`, `COUNT` (bands²), `EVEN_COUNT` (bands (bands + 1)/2) and the given
/// functions, whatever their order. It imports nothing, and can be mounted for a linker under any
/// name.
pub fn module(bands: usize, functions: &[Function]) -> String {
    let mut text = format!(
        "const BANDS = {bands}u;\nconst COUNT = {}u;\nconst EVEN_COUNT = {}u;\n",
        count(bands),
        even_count(bands)
    );
    for function in Function::ALL.iter().filter(|function| functions.contains(function)) {
        text.push('\n');
        text.push_str(&function.generate(bands).wgsl);
    }
    text
}
