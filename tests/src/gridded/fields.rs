//! Lights around a box of two metres about the origin, and receivers in it.

use glam::Vec3;
use manylights_gpu::SurfaceRecord;
use manylights_scene::{AreaLight, Brdf, Lobe};

/// Where receivers are seen from, metres.
pub const CAMERA: Vec3 = Vec3::new(600.0, 1000.0, -200.0);

/// A glossy surface that faces the camera.
pub fn receiver(position: Vec3, normal: Vec3) -> SurfaceRecord {
    let lobe = Lobe::Schlick { f90: 1.0 };
    let brdf = Brdf { f0: Vec3::splat(0.2), lobe, alpha: 0.16, ..Brdf::lambert(Vec3::splat(0.4)) };
    let facing = if normal.dot(CAMERA) < 0.0 { -normal } else { normal };
    SurfaceRecord::new(position, facing.normalize(), brdf)
}

/// Numbers from −1 to 1, low-discrepancy.
pub fn noise(i: usize) -> [f32; 3] {
    let steps = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_960_3_f64];
    steps.map(|step| (2.0 * ((i + 1) as f64 * step).fract() - 1.0) as f32)
}

/// Half a side of the box to a whole one outside.
fn places() -> impl Iterator<Item = Vec3> {
    (0..12).map(|i| {
        let (z, turn) = ((2 * i + 1) as f32 / 12.0 - 1.0, i as f32 * 2.399_963_3);
        let ring = (1.0 - z * z).sqrt();
        let towards = Vec3::new(ring * turn.cos(), ring * turn.sin(), z);
        (2.0 + (i % 3) as f32 * 0.5) * towards / towards.abs().max_element()
    })
}

/// Twelve of radius 0.15, half a side of the box to a whole one outside.
pub fn spheres() -> Vec<AreaLight> {
    let sphere = |center| AreaLight::Sphere { center, radius: 0.15, radiance: Vec3::ONE };
    places().map(sphere).collect()
}

/// Twelve of size 0.2 at the same places: they face the box, or nearly turn their edge to it. Planes through its middle
/// would all meet in one vertex.
pub fn triangles(facing: bool, two_sided: bool) -> Vec<AreaLight> {
    let triangle = |center: Vec3| {
        let towards = center.normalize();
        let (a, b) = towards.any_orthonormal_pair();
        let (right, up) = if facing { (a, b) } else { ((towards + 0.2 * a).normalize(), b) };
        let corners = [right - up, -right - up, up].map(|corner| center + 0.2 * corner);
        AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided }
    };
    places().map(triangle).collect()
}
