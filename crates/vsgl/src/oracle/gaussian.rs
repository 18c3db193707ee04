//! Spherical Gaussians and their integrals.
//!
//! Errors against quadrature (`tests/truth.rs`). The integral with the clamped cosine, in units of its
//! largest value: 5e-6 for λ = 0.1, 6e-4 for 2.3, 1.5e-3 for 5, 3e-5 for 100; by the thesis' product of
//! two Gaussians 0.06 for 0.1, 0.13 for 2, 0.15 for 20. The mean cosine is up to 0.16 too large (λ 2.3),
//! and (1 − c)⁵ of it, which couples the lobes, is off the mean of (1 − c)⁵ by up to 0.16 (λ 5). The share
//! above the horizon is off by 0.003.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use libm::{erf, erfc};

/// a·exp(λ(p·w − 1)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaussian {
    /// p, unit.
    pub axis: DVec3,
    /// λ ≥ 0.
    pub sharpness: f64,
    /// ln a.
    pub log_amplitude: f64,
}

impl Gaussian {
    /// Its value: λ(p·w − 1) = −λ|w − p|²/2 keeps the digits near the axis.
    pub fn eval(&self, w: DVec3) -> f64 {
        (self.log_amplitude - 0.5 * self.sharpness * (w - self.axis).length_squared()).exp()
    }

    /// The product of two, exact. Opposite lobes of one sharpness have a product without an axis: any
    /// will do.
    pub fn product(&self, other: &Self) -> Self {
        let along = self.sharpness * self.axis + other.sharpness * other.axis;
        let sharpness = along.length();
        let apart = (self.axis - other.axis).length_squared();
        let sum = sharpness + self.sharpness + other.sharpness;
        // λ − λ₁ − λ₂ without cancellation.
        let lost = if sum > 0.0 { self.sharpness * other.sharpness * apart / sum } else { 0.0 };
        Self {
            axis: along.try_normalize().unwrap_or(self.axis),
            sharpness,
            log_amplitude: self.log_amplitude + other.log_amplitude - lost,
        }
    }
}

/// ∫ over the sphere of a Gaussian of amplitude 1.
pub fn integral(sharpness: f64) -> f64 {
    TAU * decay(2.0 * sharpness) * 2.0
}

/// (1 − e⁻ˣ)/x.
fn decay(x: f64) -> f64 {
    if x < 1e-8 { 1.0 - 0.5 * x } else { -(-x).exp_m1() / x }
}

/// coth λ − 1/λ: mean cosine to the axis.
pub fn mean_length(sharpness: f64) -> f64 {
    if sharpness < 1e-2 {
        return sharpness / 3.0 - sharpness.powi(3) / 45.0;
    }
    1.0 / sharpness.tanh() - 1.0 / sharpness
}

/// What is known of a lobe against the clamped cosine of a normal.
#[derive(Clone, Copy, Debug)]
pub struct Cosine {
    /// ∫ G ⟨n·w⟩ dw for amplitude 1.
    pub integral: f64,
    /// Mean of n·w over G ⟨n·w⟩.
    pub mean: f64,
}

/// Tokuyoshi et al. 2024 for the integral; `cosine` is n·p.
///
/// The mean is that of a normal distribution of n·w about its mean c·A(λ) with the variance A(λ)/λ of
/// a lobe across its axis, cut at the horizon.
pub fn clamped_cosine(cosine: f64, sharpness: f64) -> Cosine {
    let (a, b) = (2.7360831611272558, 17.02129778187417);
    let (c, d, e) = (4.010082672851042, 15.219156263147211, 76.08789627236074);
    let l = sharpness;
    let ratio = 0.5 * ((l + a) * l + b) / (((l + c) * l + d) * l + e);
    let t = l * ratio.sqrt();
    let tz = t * cosine;
    // The difference of two exponentials over t, in the limit of t → 0 as well.
    let spread = if t > 0.0 {
        -(-tz * tz).exp() * (t * t * (cosine * cosine - 1.0)).exp_m1() / t
    } else {
        0.0
    };
    let f = 0.5 * (cosine * erfc(-tz) + erfc(t)) + spread / (2.0 * PI.sqrt());
    let f = f.clamp(0.0, 1.0);
    let integral = TAU * (below(l) + (above(l) - below(l)) * f);
    let mean = mean_length(l);
    let variance = if l > 0.0 { mean / l } else { 1.0 / 3.0 };
    let visible = 0.5 * erfc(-tz);
    let reached = integral / self::integral(l);
    let mean = (cosine * mean + variance * visible / reached).clamp(0.0, 1.0);
    Cosine { integral, mean }
}

/// Sharpness of the Gaussian of amplitude 1 that stood for the clamped cosine.
pub const COSINE_SHARPNESS: f64 = 2.0;

/// The thesis' source: the cosine is a Gaussian, whose integral with another is approximated (Iwasaki et
/// al. 2012). The mean is that of the product's axis.
pub fn gaussian_cosine(cosine: f64, sharpness: f64) -> Cosine {
    let sum = COSINE_SHARPNESS + sharpness;
    let product = COSINE_SHARPNESS * sharpness;
    let integral = TAU / sum * (product / sum * (cosine - 1.0)).exp();
    // |2n + λp|² = (2 + λ)² − 4λ(1 − c).
    let length = (sum * sum - 2.0 * product * (1.0 - cosine)).max(0.0).sqrt();
    let mean = (COSINE_SHARPNESS + sharpness * cosine) / length.max(1e-12);
    Cosine { integral, mean: mean.clamp(0.0, 1.0) }
}

/// ∫₀¹ x e^{λ(x−1)} dx.
fn above(l: f64) -> f64 {
    if l < 1e-3 { 0.5 - l / 6.0 + l * l / 24.0 } else { (1.0 - decay(l)) / l }
}

/// The same below the horizon: e^{−λ} ∫₀¹ x e^{−λx} dx.
fn below(l: f64) -> f64 {
    if l < 1e-3 {
        return (-l).exp() * (0.5 - l / 3.0 + l * l / 8.0);
    }
    (-l).exp() * (decay(l) - (-l).exp()) / l
}

/// Share of a Gaussian that is above the horizon (Tokuyoshi 2022); `cosine` is n·p.
pub fn visible_share(cosine: f64, sharpness: f64) -> f64 {
    let (a, b, g) = (0.6517328826907057, 1.3418280033141287, 7.22166877989567);
    let l = sharpness;
    if l == 0.0 {
        return 0.5;
    }
    let s = l * ((0.5 * l + a) / ((l + b) * l + g)).sqrt();
    let f = (0.5 + 0.5 * erf(s * cosine) / erf(s)).clamp(0.0, 1.0);
    let low = (-l).exp();
    (low + (1.0 - low) * f) / (1.0 + low)
}

/// Sharpest lobe that is told from a point, as in the authors' code.
pub const SHARPEST: f64 = (1_u64 << 41) as f64;

/// Banerjee et al. 2005: sharpness of a lobe whose directions have this mean length.
pub fn sharpness(mean_length: f64) -> f64 {
    let r = mean_length.clamp(0.0, 1.0);
    (r * (3.0 - r * r) / (1.0 - r * r)).min(SHARPEST)
}

/// The inverse of [`sharpness`], as 1 − r, which keeps the digits of sharp lobes: the root of
/// λε(2 − ε) = 2 − 3ε² + ε³ in (0, 1].
pub fn blur(sharpness: f64) -> f64 {
    let mut blur = 1.0 / (1.0 + sharpness);
    for _ in 0..60 {
        let value = 2.0 + blur * (-2.0 * sharpness + blur * (sharpness - 3.0 + blur));
        let slope = -2.0 * sharpness + blur * (2.0 * (sharpness - 3.0) + 3.0 * blur);
        let next = (blur - value / slope).clamp(0.0, 1.0);
        if (next - blur).abs() <= f64::EPSILON * blur {
            break;
        }
        blur = next;
    }
    blur
}
