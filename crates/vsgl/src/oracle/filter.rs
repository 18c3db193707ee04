//! From the texels of a group to its two lobes.

use glam::{DVec2, DVec3};
use manylights_gpu::SurfaceRecord;
use manylights_scene::{DBrdf, Lobe};
use manylights_virtual_lights::LitTexel;

use super::gaussian::{COSINE_SHARPNESS, blur, sharpness};
use super::reflection::dominant_normal;
use crate::Approximation;
use crate::albedo::{exact_interpolated, interpolated};

/// One spherical Gaussian that emits from a cloud of places.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DGaussianLobe {
    /// Mean place, metres.
    pub position: DVec3,
    /// Variance of the places along one axis, m².
    pub variance: f64,
    /// Unit direction of emission.
    pub axis: DVec3,
    /// Sharpness of the emission.
    pub sharpness: f64,
    /// Emitted power, W.
    pub power: DVec3,
}

/// What a texel sends out by one of its lobes.
struct Emission {
    power: DVec3,
    axis: DVec3,
    blur: f64,
}

/// Sharpness of the lobe that is fitted to cos/π.
pub const DIFFUSE_SHARPNESS: f64 = 2.292504;

/// The lobe that stands for cos/π.
fn cosine_sharpness(by: Approximation) -> f64 {
    match by {
        Approximation::Thesis => COSINE_SHARPNESS,
        Approximation::Filtered => DIFFUSE_SHARPNESS,
    }
}

/// The diffuse and the specular lobe of a group; power 0 where there is none.
pub fn filter(texels: &[(SurfaceRecord, LitTexel)], by: Approximation) -> [DGaussianLobe; 2] {
    let lit = texels.iter().filter(|(_, texel)| texel.flux.max_element() > 0.0);
    [diffuse, specular].map(|emission| {
        mean(lit.clone().map(|(surface, texel)| (surface, texel, emission(surface, texel, by))))
    })
}

fn mean<'a>(
    emissions: impl Iterator<Item = (&'a SurfaceRecord, &'a LitTexel, Emission)> + Clone,
) -> DGaussianLobe {
    let weight = |emission: &Emission| emission.power.element_sum();
    let total: f64 = emissions.clone().map(|(_, _, emission)| weight(&emission)).sum();
    if total <= 0.0 {
        return DGaussianLobe::default();
    }
    let position = emissions
        .clone()
        .map(|(surface, _, emission)| weight(&emission) * surface.position.as_dvec3())
        .sum::<DVec3>()
        / total;
    let (mut square, mut axis, mut power) = (0.0, DVec3::ZERO, DVec3::ZERO);
    for (surface, texel, emission) in emissions {
        let weight = weight(&emission);
        let apart = (surface.position.as_dvec3() - position).length_squared();
        square += weight * (apart + 2.0 * f64::from(texel.variance));
        axis += weight * (1.0 - emission.blur) * emission.axis;
        power += emission.power;
    }
    let axis = axis / total;
    DGaussianLobe {
        position,
        variance: 0.5 * square / total,
        axis: axis.try_normalize().unwrap_or(DVec3::Z),
        sharpness: sharpness(axis.length()),
        power,
    }
}

fn diffuse(surface: &SurfaceRecord, texel: &LitTexel, by: Approximation) -> Emission {
    let brdf = DBrdf::from(surface.brdf());
    let entering = brdf.transmission(cosine(surface, texel));
    let leaving = match brdf.lobe {
        // ∫ 2c (1 − c)⁵ dc = 1/21.
        Lobe::Schlick { f90 } => {
            1.0 - (brdf.f0 * (20.0 / 21.0) + f64::from(f90) / 21.0).max_element()
        }
        Lobe::Dielectric { .. } | Lobe::Measured(_) => 1.0,
    };
    Emission {
        power: texel.flux.as_dvec3() * brdf.diffuse * (entering * leaving),
        axis: texel.geometric_normal.as_dvec3().normalize(),
        blur: blur(cosine_sharpness(by)),
    }
}

fn cosine(surface: &SurfaceRecord, texel: &LitTexel) -> f64 {
    surface.normal.as_dvec3().normalize().dot(texel.incoming.as_dvec3().normalize())
}

fn specular(surface: &SurfaceRecord, texel: &LitTexel, by: Approximation) -> Emission {
    let brdf = DBrdf::from(surface.brdf());
    let normal = surface.normal.as_dvec3().normalize();
    let incoming = texel.incoming.as_dvec3().normalize();
    let view_n = normal.dot(incoming);
    let tangential = incoming - view_n * normal;
    let alpha2 = brdf.alpha * brdf.alpha;
    let view = DVec3::new(tangential.length(), 0.0, view_n);
    let local = match by {
        Approximation::Thesis => DVec3::Z,
        Approximation::Filtered => dominant_normal(alpha2, view),
    };
    let tangent = tangential.try_normalize().unwrap_or(DVec3::ZERO);
    let micro = (local.x * tangent + local.z * normal).normalize();
    let view_m = incoming.dot(micro);
    let axis = (2.0 * view_m * micro - incoming).normalize();
    let lobe = (2.0 / alpha2 - 2.0) * local.z / (4.0 * view_m);
    let reflected = match brdf.lobe {
        Lobe::Schlick { f90 } => {
            let albedo = interpolated(brdf.alpha.sqrt(), view_n);
            brdf.f0 * albedo.x + DVec3::splat(f64::from(f90) * albedo.y)
        }
        Lobe::Dielectric { index } => {
            brdf.f0 * exact_interpolated(brdf.alpha, index.into(), view_n)
        }
        // The method declines them.
        Lobe::Measured(_) => DVec3::ZERO,
    };
    let geometric = texel.geometric_normal.as_dvec3().normalize().dot(axis) / normal.dot(axis);
    Emission {
        power: texel.flux.as_dvec3() * reflected * geometric.clamp(0.0, 2.0),
        axis,
        blur: blur(lobe.max(cosine_sharpness(by))),
    }
}

/// Directional albedo of a white lobe's two parts, as the filter reads it from its table.
pub fn albedo(alpha: f64, cosine: f64) -> DVec2 {
    interpolated(alpha.sqrt(), cosine)
}

/// The same of a lobe with exact Fresnel reflectance, over f0.
pub fn exact_albedo(alpha: f64, index: f64, cosine: f64) -> f64 {
    exact_interpolated(alpha, index, cosine)
}
