//! The same estimator in f64 on the CPU, and the integral that it approximates.

use std::f64::consts::FRAC_1_PI;

use glam::DVec3;
use manylights_gpu::SurfaceRecord;
use manylights_harmonics::quadrature::sphere_nodes;
use manylights_harmonics::zonal::{Cap, cap_stable};
use manylights_reflectance::{Form, Receiver};
use manylights_scene::DBrdf;
use manylights_virtual_lights::VirtualSphere;

use crate::{Settings, emission, horizon};

/// As in the shader: stands for the sine of a sphere without extent.
const SMALLEST_SINE: f64 = 1e-9;

/// Radiance from `surface` towards `camera`, summed over `lights`: the formula of the crate's head,
/// in f64, from the same f32 inputs. Negative where the expansion is.
pub fn radiance(
    surface: &SurfaceRecord,
    camera: DVec3,
    lights: &[VirtualSphere],
    settings: &Settings,
) -> DVec3 {
    if surface.triangle == SurfaceRecord::NO_TRIANGLE {
        return DVec3::ZERO;
    }
    let normal = surface.normal.as_dvec3().normalize();
    let view = (camera - surface.position.as_dvec3()).normalize();
    let Settings { bands, form, damping, .. } = *settings;
    let receiver = Receiver::new(surface.brdf(), [normal, view], bands, form, damping);
    let brdf = DBrdf::from(surface.brdf());
    let sum = |sphere: &VirtualSphere| {
        let Some(seen) = Seen::new(surface, sphere, settings.emission_bands) else {
            return DVec3::ZERO;
        };
        seen.irradiance * reflected(&receiver, &brdf, seen.direction, seen.cap, settings)
    };
    lights.iter().map(sum).sum()
}

/// The same with ∫ f cos⁺ over the cap by quadrature, times `share`(cosine, cap): infinitely many
/// bands, no tabulation. `nodes` as in [`sphere_nodes`].
pub fn by_quadrature(
    surface: &SurfaceRecord,
    camera: DVec3,
    sphere: &VirtualSphere,
    share: impl Fn(f64, Cap<f64>) -> f64,
    nodes: usize,
) -> DVec3 {
    let Some(seen) = Seen::new(surface, sphere, 0) else { return DVec3::ZERO };
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
    let share = share(normal.dot(seen.direction), seen.cap);
    seen.irradiance * reflected * (share / seen.cap.sine.powi(2))
}

/// A sphere as the shaded point sees it.
struct Seen {
    direction: DVec3,
    cap: Cap<f64>,
    /// s² Φ f(ω_p, −ω) ⟨n_j·−ω⟩/(π r²), W·m⁻²·sr⁻¹: the sphere's radiance times the square of its
    /// sine, which does not grow as the radius shrinks.
    irradiance: DVec3,
}

impl Seen {
    /// `None` where nothing arrives.
    fn new(surface: &SurfaceRecord, sphere: &VirtualSphere, emission_bands: usize) -> Option<Self> {
        let light = &sphere.light;
        let offset = light.position.as_dvec3() - surface.position.as_dvec3();
        // A light at the shaded point itself has no direction.
        let direction = offset.try_normalize()?;
        let (distance, radius) = (offset.length(), f64::from(sphere.radius));
        let sine = (radius / distance).clamp(SMALLEST_SINE, 1.0);
        let cap = Cap { sine, cosine: ((1.0 - sine) * (1.0 + sine)).sqrt() };
        let emitted = light.geometric_normal.as_dvec3().normalize().dot(-direction);
        let density = FRAC_1_PI / distance.max(radius).powi(2);
        let emission = emission::reflectance(light, -direction, emission_bands);
        let irradiance = light.flux.as_dvec3() * emission * (emitted * density);
        (emitted > 0.0).then_some(Self { direction, cap, irradiance })
    }
}

/// ∫ f cos⁺ H over the cap, over the square of its sine.
fn reflected(
    receiver: &Receiver,
    brdf: &DBrdf,
    direction: DVec3,
    cap: Cap<f64>,
    settings: &Settings,
) -> DVec3 {
    let mut scales = vec![0.0; settings.bands];
    cap_stable(cap, &mut scales);
    let cosine = receiver.frame[2].dot(direction);
    let above = horizon::above(settings.horizon, cosine, cap) / cap.sine.powi(2);
    let diffuse = match settings.form {
        Form::Full => above * receiver.diffuse_product(cosine, &scales),
        Form::Zonal => brdf.transmission(cosine.max(0.0)) * horizon::irradiance(cosine, cap),
    };
    receiver.lambert * diffuse + receiver.specular_product(direction, &scales) * above
}
