//! The same estimator in f64 on the CPU.

mod vertices;

use glam::DVec3;
use manylights_area_lights::transformed_cap;
use manylights_gpu::SurfaceRecord;
use manylights_harmonics::zonal::{Cap, cap_stable};
use manylights_reflectance::product_oracle::ProductReceiver;
use manylights_reflectance::transformed_cosine::of_surface;
use manylights_reflectance::{Damping, Form, Receiver, is_narrow};

pub use vertices::coefficients;

use crate::cap_table::CapTable;
use crate::{Coefficients, Extent, Narrow, Product, Settings, SphereLight};

/// As in the shader: distance, m, below which the point is at the centre, along the normal.
const COINCIDENT: f64 = 1e-15;

/// Radiance from `surface` towards `camera`, summed over `lights`: the formula of the crate's head, in f64,
/// from the same f32 inputs. Negative where the expansion is.
pub fn radiance(
    surface: &SurfaceRecord,
    camera: DVec3,
    lights: &[SphereLight],
    settings: &Settings,
) -> DVec3 {
    if surface.triangle == SurfaceRecord::NO_TRIANGLE {
        return DVec3::ZERO;
    }
    let position = surface.position.as_dvec3();
    let normal = surface.normal.as_dvec3().normalize();
    let view = (camera - position).normalize();
    let bands = settings.bands;
    let table = (settings.coefficients == Coefficients::Tabulated).then(|| CapTable::new(bands));
    let seen = |light: &SphereLight| {
        let (direction, cap) = cap(light, [position, normal], settings.extent);
        let scales = match &table {
            Some(table) => table.scales(cap),
            None => {
                let mut scales = vec![0.0; bands];
                cap_stable(cap, &mut scales);
                scales
            }
        };
        (direction, cap.sine, scales, light.radiance.as_dvec3())
    };
    let seen = lights.iter().map(seen);
    let (brdf, directions) = (surface.brdf(), [normal, view]);
    match settings.product {
        Product::Full => {
            let receiver = Receiver::new(brdf, directions, bands, Form::Full, Damping::None);
            let transformed = (settings.narrow == Narrow::Transformed && is_narrow(brdf.alpha))
                .then(|| of_surface(&brdf.into(), normal.dot(view)));
            let reflected = |(direction, sine, scales, radiance): (DVec3, f64, Vec<f64>, DVec3)| {
                let diffuse = receiver.diffuse_product(normal.dot(direction), &scales);
                let specular = match &transformed {
                    Some((cosine, magnitude)) => {
                        let local = receiver.frame.map(|axis| axis.dot(direction));
                        *magnitude * transformed_cap(cosine, local.into(), sine)
                    }
                    None => receiver.specular_product(direction, &scales),
                };
                radiance * (receiver.lambert * diffuse + specular)
            };
            seen.map(reflected).sum()
        }
        Product::Cosine(product) => {
            let diffuse = settings.diffuse;
            let mut receiver = ProductReceiver::new(brdf, directions, bands, product, diffuse);
            for (direction, _, scales, radiance) in seen {
                receiver.add(direction, &scales, radiance);
            }
            receiver.radiance()
        }
    }
}

/// What a point of this normal sees of a light, and where.
fn cap(light: &SphereLight, [position, normal]: [DVec3; 2], extent: Extent) -> (DVec3, Cap<f64>) {
    let offset = light.center.as_dvec3() - position;
    let (distance, radius) = (offset.length(), f64::from(light.radius));
    let (distance, direction) =
        if distance < COINCIDENT { (0.0, normal) } else { (distance, offset / distance) };
    let cap = match extent {
        Extent::Sphere => Cap::of_sphere(radius, distance),
        Extent::Disc => Cap::of_disk(radius, distance),
    };
    (direction, cap)
}
