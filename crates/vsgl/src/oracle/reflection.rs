//! A GGX lobe under a spherical Gaussian: two approximations of ∫ G D V ⟨n·w⟩ dw, without Fresnel.
//!
//! All directions are local: x the tangent on the view's side, z the normal.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::gaussian::{integral, visible_share};

/// A reflected integral and where it mostly comes from.
#[derive(Clone, Copy, Debug)]
pub struct Reflection {
    /// ∫ G D V ⟨n·w⟩ dw for a Gaussian of amplitude 1.
    pub integral: f64,
    /// Unit direction to the light that contributes most: where Fresnel is taken.
    pub dominant: DVec3,
}

/// Smallest cosine of the view that enters the lobes' shapes.
const GRAZING: f64 = 1e-3;

/// √(α² + (1 − α²) c²).
fn smith(alpha2: f64, cosine: f64) -> f64 {
    (alpha2 + (1.0 - alpha2) * cosine * cosine).sqrt()
}

/// The micro-normal about which a visible GGX lobe lies, for a view of which `tangential` is the part
/// along the surface (the authors' code): (α² v_t, z).
pub fn dominant_normal(alpha2: f64, view: DVec3) -> DVec3 {
    let tangential = DVec3::new(view.x, view.y, 0.0);
    let root = (alpha2 * tangential.length_squared() + view.z * view.z).sqrt();
    (alpha2 * tangential + (root + view.z) * DVec3::Z).normalize()
}

/// Xu et al. 2013: the lobe as an anisotropic Gaussian about the mirrored view.
pub fn anisotropic(alpha: f64, view: DVec3, axis: DVec3, sharpness: f64) -> Reflection {
    let alpha2 = alpha * alpha;
    let view_n = view.z.max(GRAZING);
    let z = DVec3::new(-view.x, 0.0, view.z);
    let y = DVec3::new(view.z, 0.0, view.x);
    let narrow = 1.0 / alpha2 - 1.0;
    let (lx, ly) = (narrow / (4.0 * view_n * view_n), 0.25 * narrow);
    let mu = 0.5 * sharpness;
    let (sx, sy) = ((lx + mu).max(1e-12), (ly + mu).max(1e-12));
    let (px, py) = (axis.y, axis.dot(y));
    let exponent = -lx * mu / sx * px * px - ly * mu / sy * py * py;
    let value = PI / (sx * sy).sqrt() * axis.dot(z).max(0.0) * exponent.exp();
    let dominant = (z * (2.0 * (lx * ly).sqrt()) + axis * sharpness).try_normalize().unwrap_or(z);
    let masking = smith(alpha2, view.z) * dominant.z.abs() + smith(alpha2, dominant.z) * view.z;
    let coefficient = dominant.z.max(0.0) / (TAU * alpha2 * masking);
    Reflection { integral: coefficient * value, dominant }
}

/// Tokuyoshi et al. 2024: the distribution of normals widened by the light, seen along the half
/// vector.
pub fn filtered(alpha: f64, view: DVec3, axis: DVec3, sharpness: f64) -> Reflection {
    let alpha2 = alpha * alpha;
    let view_n = view.z.max(GRAZING);
    let l = 2.0 * sharpness.max(1e-12);
    let rest = 1.0 - alpha2;
    // M = M₀/(M₀ + 1) of both axes, with M₀ = α²/(1 − α²) + (2/λ)(1/4, 1/(4 v_n²)).
    let [mx, my] = [1.0, view_n * view_n].map(|s| (l * s * alpha2 + rest) / (l * s + rest));
    let h = view + axis;
    let length2 = h.length_squared();
    let sum = h.x * h.x / mx + h.y * h.y / my + h.z * h.z;
    let d = if length2 > 1e-12 { sum / length2 } else { 1.0 };
    let distribution = 1.0 / (PI * (mx * my).sqrt() * d * d);
    let lobe = distribution / (4.0 * (view.x * view.x * mx + view.z * view.z).sqrt());
    let micro = dominant_normal(alpha2, view);
    let mirrored = 2.0 * view.dot(micro) * micro - view;
    let along = mirrored * (rest / (2.0 * alpha2)) + axis * sharpness;
    let (length, dominant) = (along.length(), along.try_normalize().unwrap_or(mirrored));
    let share = visible_share(dominant.z, length);
    // G₂/G₁ there: the authors' code leaves it out and reflects up to 1.6 times too much (α = 1).
    let cosine = dominant.z.max(0.0);
    let own = smith(alpha2, view_n);
    let masking = cosine * (view_n + own) / (cosine * own + view_n * smith(alpha2, cosine));
    Reflection { integral: share * lobe * masking * integral(sharpness), dominant }
}
