//! The same estimator in f64 on the CPU.

mod polygon;
mod vertices;

use glam::DVec3;
use manylights_area_lights::transformed_triangle;
use manylights_gpu::SurfaceRecord;
use manylights_harmonics::zonal::{TriangleForm, TriangleSighting};
use manylights_reflectance::transformed_cosine::{TransformedCosine, of_surface};
use manylights_reflectance::{Damping, Form, Receiver, is_narrow};
use manylights_scene::AreaLight;

pub use vertices::coefficients;

use crate::{Approximation, Narrow, Settings};

/// Radiance from `surface` towards `camera`, summed over `lights`: the formula of the crate's head, in f64,
/// from the same f32 inputs. Negative where the expansion is.
pub fn radiance(
    surface: &SurfaceRecord,
    camera: DVec3,
    lights: &[AreaLight],
    settings: &Settings,
) -> DVec3 {
    if surface.triangle == SurfaceRecord::NO_TRIANGLE {
        return DVec3::ZERO;
    }
    let position = surface.position.as_dvec3();
    let normal = surface.normal.as_dvec3().normalize();
    let view = (camera - position).normalize();
    let brdf = surface.brdf();
    let receiver = Receiver::new(brdf, [normal, view], settings.bands, Form::Full, Damping::None);
    if settings.narrow == Narrow::Transformed && brdf.has_specular() && is_narrow(brdf.alpha) {
        let specular = of_surface(&brdf.into(), normal.dot(view));
        let reflected = |light: &AreaLight| {
            narrow(&receiver, position, specular, (light, settings.approximation))
        };
        let specular: DVec3 = lights.iter().map(reflected).sum();
        return specular + of_bands(&receiver.lambertian(), [position, normal], lights, settings);
    }
    of_bands(&receiver, [position, normal], lights, settings)
}

/// A lobe's transform and magnitude under a triangle.
fn narrow(
    receiver: &Receiver,
    position: DVec3,
    (cosine, magnitude): (TransformedCosine, DVec3),
    (light, approximation): (&AreaLight, Approximation),
) -> DVec3 {
    let AreaLight::Triangle { corners, radiance, two_sided } = *light else { return DVec3::ZERO };
    let seen = corners.map(|corner| corner.as_dvec3() - position);
    let corners = match approximation {
        Approximation::Exact(_) => polygon::off_plane(seen),
        Approximation::Sphere(_) => seen,
    };
    let local = |corner: DVec3| DVec3::from(receiver.frame.map(|axis| axis.dot(corner)));
    let irradiance = transformed_triangle(&cosine, corners.map(local), two_sided);
    radiance.as_dvec3() * magnitude * irradiance
}

/// What a receiver's lobes in harmonics reflect.
fn of_bands(
    receiver: &Receiver,
    [position, normal]: [DVec3; 2],
    lights: &[AreaLight],
    settings: &Settings,
) -> DVec3 {
    let Approximation::Sphere(form) = settings.approximation else {
        return polygon::reflected(receiver, position, lights, settings.bands);
    };
    let reflected = |light: &AreaLight| {
        let Some((direction, scales)) = scales(light, [position, normal], form, settings.bands)
        else {
            return DVec3::ZERO;
        };
        let diffuse = receiver.diffuse_product(normal.dot(direction), &scales);
        let specular = receiver.specular_product(direction, &scales);
        light.radiance().as_dvec3() * (receiver.lambert * diffuse + specular)
    };
    lights.iter().map(reflected).sum()
}

/// The direction to a triangle's centre of mass and c_l; `None` without area.
fn scales(
    light: &AreaLight,
    [position, normal]: [DVec3; 2],
    form: TriangleForm,
    bands: usize,
) -> Option<(DVec3, Vec<f64>)> {
    let AreaLight::Triangle { corners, two_sided, .. } = *light else { return None };
    let corners = corners.map(|corner| (corner.as_dvec3() - position).to_array());
    let seen = TriangleSighting::new(corners, two_sided, normal.to_array())?;
    let mut scales = vec![0.0; bands];
    seen.scales(form, &mut scales);
    Some((DVec3::from(seen.direction), scales))
}
