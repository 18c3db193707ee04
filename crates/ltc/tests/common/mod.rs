//! Single surfaces and lights; pictures on the adapter.

use std::sync::LazyLock;

use glam::{DVec3, Quat, Vec3};
use manylights_gpu::{Gpu, SurfaceRecord};
use manylights_ltc::LightRecord;
use manylights_scene::{AreaLight, Brdf, Lobe};

pub(crate) static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

pub(crate) fn glossy(roughness: f32) -> Brdf {
    Brdf {
        diffuse: Vec3::new(0.5, 0.3, 0.2),
        f0: Vec3::splat(0.04),
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    }
}

pub(crate) fn metal(roughness: f32) -> Brdf {
    Brdf { diffuse: Vec3::ZERO, f0: Vec3::new(0.9, 0.7, 0.4), ..glossy(roughness) }
}

/// A specular lobe without its Fresnel term.
pub(crate) fn mirror_like(roughness: f32) -> Brdf {
    Brdf { diffuse: Vec3::ZERO, f0: Vec3::ONE, ..glossy(roughness) }
}

/// An oblique frame, so that no coordinate is exact.
pub(crate) fn oblique(v: Vec3) -> Vec3 {
    Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7) * v
}

/// A direction of a spiral over the part of the sphere from z = `lowest` up.
pub(crate) fn spiral(i: u32, count: u32, lowest: f64) -> DVec3 {
    let z = 1.0 - (1.0 - lowest) * (f64::from(i) + 0.5) / f64::from(count);
    let (sin, cos) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
    let r = ((1.0 - z) * (1.0 + z)).sqrt();
    DVec3::new(r * cos, r * sin, z)
}

/// Receivers around the origin that face the camera.
pub(crate) fn receivers(brdf: Brdf, camera: Vec3) -> Vec<SurfaceRecord> {
    (0..512)
        .map(|i| {
            let place = spiral(i, 512, -1.0).as_vec3() * (0.2 + 0.01 * i as f32);
            let normal = spiral((i * 197) % 512, 512, -1.0).as_vec3();
            SurfaceRecord::new(oblique(place), oblique(normal), brdf)
        })
        .filter(|surface| surface.normal.dot(camera - surface.position) > 0.0)
        .collect()
}

pub(crate) const RADIANCE: Vec3 = Vec3::new(1.0, 0.7, 0.3);

pub(crate) fn triangle(corners: [Vec3; 3], two_sided: bool) -> LightRecord {
    LightRecord::new(&AreaLight::Triangle { corners, radiance: RADIANCE, two_sided })
}

pub(crate) fn sphere(center: Vec3, radius: f32) -> LightRecord {
    LightRecord::new(&AreaLight::Sphere { center, radius, radiance: RADIANCE })
}
