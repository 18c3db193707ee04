//! A Lambertian and a GGX lobe after the look of a measurement: for samplers, not for values.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec3, Vec3};

use super::values::Values;

/// Sampling follows either lobe at least this often.
const MIN_SHARE: f64 = 0.1;
/// The view whose albedo is shared out: 30° from the normal.
const VIEW: [f64; 3] = [0.5, 0.0, 0.866_025_403_784_438_6];
/// Steps in the angle from the normal; half as many around it.
const STEPS: usize = 64;

/// The lobes.
#[derive(Clone, Copy)]
pub(crate) struct Estimate {
    pub(crate) diffuse: Vec3,
    pub(crate) f0: Vec3,
    pub(crate) alpha: f32,
}

impl Estimate {
    /// `distribution` of micro-normals, at any scale.
    pub(super) fn new(values: &Values, distribution: impl Fn(f64) -> f64) -> Self {
        let alpha = width(distribution);
        let diffuse = PI * base(values);
        let specular = albedo_above(values, diffuse / PI, alpha);
        let albedo = specular + diffuse;
        let largest = |color: DVec3| color.max_element().max(f64::MIN_POSITIVE);
        let share = largest(specular) / (largest(specular) + largest(diffuse));
        let share = share.clamp(MIN_SHARE, 1.0 - MIN_SHARE);
        Self {
            diffuse: (albedo * (1.0 - share)).as_vec3(),
            f0: (albedo * share).as_vec3(),
            alpha: alpha as f32,
        }
    }
}

/// α = tan of the median angle of projected micro-normals: half of GGX's D cos lies below tan θ = α.
fn width(distribution: impl Fn(f64) -> f64) -> f64 {
    const FINE: usize = 1024;
    // θ = x² π/2: small angles matter.
    let angle = |i: usize| ((i as f64 + 0.5) / FINE as f64).powi(2) * FRAC_PI_2;
    let weight = |i: usize| {
        let theta = angle(i);
        distribution(theta) * theta.cos() * theta.sin() * theta.sqrt()
    };
    let total: f64 = (0..FINE).map(weight).sum();
    let mut below = 0.0;
    let median = (0..FINE).find(|&i| {
        below += weight(i);
        below >= 0.5 * total
    });
    median.map_or(1.0, |i| angle(i).tan()).clamp(1e-3, 1.0)
}

/// The distribution that light scattered back shows where nothing else does: D ∝ f(ω, ω) cos² less the
/// Lambertian part, but for the Smith term.
pub(super) fn backscatter(values: &Values, theta: f64) -> f64 {
    let at = |theta: f64| {
        let (sin, cos) = theta.sin_cos();
        let [r, g, b] = values.eval([sin, 0.0, cos], [sin, 0.0, cos]);
        r.max(g).max(b) / cos
    };
    (at(theta) - at(PI / 3.0)).max(0.0) * theta.cos().powi(2)
}

fn polar(cos: f64, angle: f64) -> [f64; 3] {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    [sin * angle.cos(), sin * angle.sin(), cos]
}

fn around(j: usize) -> f64 {
    TAU * (j as f64 + 0.5) / (STEPS / 2) as f64
}

/// f/cos of the darkest tenth of directions within 75° of the normal.
fn base(values: &Values) -> DVec3 {
    let places = (0..STEPS).flat_map(|i| (0..STEPS / 2).map(move |j| (i, j)));
    let mut found: Vec<DVec3> = places
        .map(|(i, j)| {
            let cos = 1.0 - 0.74 * (i as f64 + 0.5) / STEPS as f64;
            DVec3::from(values.eval(VIEW, polar(cos, around(j)))) / cos
        })
        .collect();
    found.sort_by(|a, b| a.element_sum().total_cmp(&b.element_sum()));
    found[found.len() / 10]
}

/// Albedo of what exceeds a Lambertian `base`, over micro-normals of GGX.
fn albedo_above(values: &Values, base: DVec3, alpha: f64) -> DVec3 {
    let v = DVec3::from(VIEW);
    let mut sum = DVec3::ZERO;
    for (i, j) in (0..STEPS).flat_map(|i| (0..STEPS / 2).map(move |j| (i, j))) {
        let u = (i as f64 + 0.5) / STEPS as f64;
        // Density D(h) n·h: tan²θ = α² u/(1 − u).
        let a2 = alpha * alpha;
        let cos2 = (1.0 - u) / (1.0 - u + a2 * u);
        let h = DVec3::from(polar(cos2.sqrt(), around(j)));
        let l = 2.0 * v.dot(h) * h - v;
        if l.z <= 0.0 || v.dot(h) <= 0.0 {
            continue;
        }
        let root = cos2 * (a2 - 1.0) + 1.0;
        let density = a2 / (PI * root * root) * h.z / (4.0 * v.dot(h));
        let above = DVec3::from(values.eval(VIEW, l.into())) - base * l.z;
        sum += above.max(DVec3::ZERO) / density;
    }
    sum / (STEPS * STEPS / 2) as f64
}
