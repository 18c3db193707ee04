//! The same estimator in f64 on the CPU, and the integral that it approximates.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};

use glam::DVec3;
use manylights_gpu::{SphericalLight, SurfaceRecord};
use manylights_harmonics::quadrature::sphere_nodes;
use manylights_harmonics::zonal::{Cap, cap_stable, evaluate, rotate};
use manylights_harmonics::{Basis, count, even_index, index};
use manylights_scene::DBrdf;

use crate::diffuse;
use crate::lobes::LobeTable;
use crate::{Horizon, Settings};

/// As in the shader: stands for the sine of a sphere without extent.
const SMALLEST_SINE: f64 = 1e-9;

/// Radiance from `surface` towards `camera`, summed over `lights`: the formula of the crate's head,
/// in f64, from the same f32 inputs. Negative where the expansion is.
pub fn radiance(
    surface: &SurfaceRecord,
    camera: DVec3,
    lights: &[SphericalLight],
    settings: &Settings,
) -> DVec3 {
    if surface.triangle == SurfaceRecord::NO_TRIANGLE {
        return DVec3::ZERO;
    }
    let receiver = Receiver::new(surface, camera, settings.bands);
    let sum = |sphere: &SphericalLight| {
        let Some(seen) = Seen::new(surface, sphere, settings.horizon) else { return DVec3::ZERO };
        seen.irradiance * receiver.reflected(seen.direction, seen.cap) / seen.cap.sine.powi(2)
    };
    lights.iter().map(sum).sum()
}

/// The same with ∫ f cos⁺ over the cap by quadrature: infinitely many bands, no tabulation. `nodes`
/// as in [`sphere_nodes`].
pub fn by_quadrature(
    surface: &SurfaceRecord,
    camera: DVec3,
    sphere: &SphericalLight,
    horizon: Horizon,
    nodes: usize,
) -> DVec3 {
    let Some(seen) = Seen::new(surface, sphere, horizon) else { return DVec3::ZERO };
    let normal = surface.normal.as_dvec3().normalize();
    let view = (camera - surface.position.as_dvec3()).normalize();
    let brdf = DBrdf::from(surface.brdf());
    let (a, b) = seen.direction.any_orthonormal_pair();
    let reflected: DVec3 = sphere_nodes(nodes, [seen.cap.cosine, 1.0])
        .into_iter()
        .map(|([x, y, z], weight)| {
            let w = x * a + y * b + z * seen.direction;
            weight * normal.dot(w).max(0.0) * brdf.eval(normal, view, w)
        })
        .sum();
    seen.irradiance * reflected / seen.cap.sine.powi(2)
}

/// A sphere as the shaded point sees it.
struct Seen {
    direction: DVec3,
    cap: Cap<f64>,
    /// s² Φ f(ω_p, −ω) ⟨n_j·−ω⟩ H/(π r²), W·m⁻²·sr⁻¹: the sphere's radiance times the square of its
    /// sine, which does not grow as the radius shrinks.
    irradiance: DVec3,
}

impl Seen {
    /// `None` where nothing arrives.
    fn new(surface: &SurfaceRecord, sphere: &SphericalLight, horizon: Horizon) -> Option<Self> {
        let light = &sphere.light;
        let offset = light.position.as_dvec3() - surface.position.as_dvec3();
        // A light at the shaded point itself has no direction.
        let direction = offset.try_normalize()?;
        let (distance, radius) = (offset.length(), f64::from(sphere.radius));
        let sine = (radius / distance).clamp(SMALLEST_SINE, 1.0);
        let cap = Cap { sine, cosine: ((1.0 - sine) * (1.0 + sine)).sqrt() };
        let normal = surface.normal.as_dvec3().normalize();
        let emitted = light.geometric_normal.as_dvec3().normalize().dot(-direction).max(0.0);
        let above = above_horizon(horizon, normal.dot(direction), cap);
        let emission = DBrdf::from(light.brdf).eval(
            light.normal.as_dvec3().normalize(),
            -direction,
            light.incoming.as_dvec3().normalize(),
        );
        let density = FRAC_1_PI / distance.max(radius).powi(2);
        let irradiance = light.flux.as_dvec3() * emission * (emitted * above * density);
        (irradiance != DVec3::ZERO).then_some(Self { direction, cap, irradiance })
    }
}

/// A shaded point's reflectance in harmonics.
struct Receiver {
    /// Tangent, bitangent, normal.
    frame: [DVec3; 3],
    basis: Basis<f64>,
    lambert: DVec3,
    diffuse: Vec<f64>,
    /// One a coefficient of m ≥ 0; empty without a specular lobe.
    specular: Vec<DVec3>,
}

impl Receiver {
    fn new(surface: &SurfaceRecord, camera: DVec3, bands: usize) -> Self {
        let brdf = DBrdf::from(surface.brdf());
        let normal = surface.normal.as_dvec3().normalize();
        let view = (camera - surface.position.as_dvec3()).normalize();
        let view_n = normal.dot(view);
        let across = view - view_n * normal;
        let tangent = across.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        let largest = brdf.f0.max_element();
        let pairs = diffuse::cosine(bands).into_iter().zip(diffuse::grazing(bands));
        let specular = if brdf.has_specular() {
            let angle = view.dot(tangent).atan2(view_n);
            let rows = LobeTable::of(surface.alpha, bands).at(angle);
            rows.into_iter().map(|[a, b]| brdf.f0 * a + DVec3::splat(brdf.f90 * b)).collect()
        } else {
            Vec::new()
        };
        Self {
            frame: [tangent, normal.cross(tangent), normal],
            basis: Basis::new(bands),
            lambert: brdf.diffuse * (FRAC_1_PI * brdf.transmission(view_n)),
            diffuse: pairs.map(|(k, g)| (1.0 - largest) * k - (brdf.f90 - largest) * g).collect(),
            specular,
        }
    }

    /// The double product of the cosine-weighted reflectance and the cap.
    fn reflected(&self, direction: DVec3, cap: Cap<f64>) -> DVec3 {
        let bands = self.basis.bands();
        let mut scales = vec![0.0; bands];
        cap_stable(cap, &mut scales);
        let local = self.frame.map(|axis| axis.dot(direction));
        // evaluate() brings (2l + 1)/4π, which `diffuse` holds as well.
        let weighted = |(l, (c, d)): (usize, (&f64, &f64))| c * d * 4.0 * PI / (2 * l + 1) as f64;
        let zonal: Vec<_> = scales.iter().zip(&self.diffuse).enumerate().map(weighted).collect();
        let mut sum = self.lambert * evaluate(&zonal, local[2]);
        if !self.specular.is_empty() {
            let mut light = vec![0.0; count(bands)];
            rotate(&self.basis, &scales, local, &mut light);
            for l in 0..bands {
                for m in 0..=l {
                    sum += light[index(l, m as isize)] * self.specular[even_index(l, m)];
                }
            }
        }
        sum
    }
}

/// H, the share of a cap above the horizon; `cosine` between the cap's axis and the normal.
pub fn above_horizon(horizon: Horizon, cosine: f64, cap: Cap<f64>) -> f64 {
    let cosine = cosine.clamp(-1.0, 1.0);
    let a = cap.sine.asin();
    match horizon {
        Horizon::Smooth => {
            let upper = a + FRAC_PI_2;
            let angle = cosine.acos().clamp(FRAC_PI_2 - a, upper);
            let x = (upper - angle) / (2.0 * a);
            x * x * (3.0 - 2.0 * x)
        }
        Horizon::Exact => {
            let x = (cosine / cap.sine).clamp(-1.0, 1.0);
            let level = ((1.0 - cosine) * (1.0 + cosine)).sqrt().max(1e-12);
            let y = (x * cap.cosine / level).clamp(-1.0, 1.0);
            let chord = x * (1.0 - x * x).sqrt() / level;
            let versine = cap.versine();
            // asin(versine chord) is its argument to 1e-16 where versine is so small.
            let lens =
                if versine < 1e-10 { chord } else { (versine * chord).min(1.0).asin() / versine };
            (0.5 + (lens + y.asin()) / PI).clamp(0.0, 1.0)
        }
    }
}
