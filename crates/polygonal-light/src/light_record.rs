//! Triangles as the shader reads them.

use std::f64::consts::PI;

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};
use manylights_scene::AreaLight;

/// For what needs its centre of mass and its plane alone: 48 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct CenterRecord {
    center: Vec3,
    radius: f32,
    normal: Vec3,
    back: f32,
    radiance: Vec3,
    padding: f32,
}

/// For what needs its solid angle: 64 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct CornerRecord {
    corner: Vec3,
    radius: f32,
    first_edge: Vec3,
    back: f32,
    second_edge: Vec3,
    padding: f32,
    radiance: Vec3,
    more_padding: f32,
}

/// The first of them, for receivers that need the corners as well: 96 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct OutlinedRecord {
    center: CenterRecord,
    corner: Vec3,
    padding: f32,
    first_edge: Vec3,
    more_padding: f32,
    second_edge: Vec3,
    last_padding: f32,
}

/// A triangle with an area, in f64.
struct Triangle {
    corners: [DVec3; 3],
    /// Of its front.
    normal: DVec3,
    /// Of the disk of its area, m.
    radius: f64,
    radiance: Vec3,
    back: f32,
}

impl Triangle {
    fn new(light: &AreaLight) -> Option<Self> {
        let AreaLight::Triangle { corners, radiance, two_sided } = *light else { return None };
        let corners = corners.map(|corner| corner.as_dvec3());
        let [a, b, c] = corners;
        let across = (b - a).cross(c - a);
        let radius = (0.5 * across.length() / PI).sqrt();
        // In f32 as well.
        let has_area = radius as f32 > 0.0;
        let back = if two_sided { 1.0 } else { 0.0 };
        has_area.then(|| Self { corners, normal: across.normalize(), radius, radiance, back })
    }
}

impl CenterRecord {
    /// `None` of a light that is no triangle or has no area.
    pub(crate) fn new(light: &AreaLight) -> Option<Self> {
        let triangle = Triangle::new(light)?;
        let [a, b, c] = triangle.corners;
        Some(Self {
            center: ((a + b + c) / 3.0).as_vec3(),
            radius: triangle.radius as f32,
            normal: triangle.normal.as_vec3(),
            back: triangle.back,
            radiance: triangle.radiance,
            padding: 0.0,
        })
    }
}

impl CornerRecord {
    /// `None` of a light that is no triangle or has no area.
    pub(crate) fn new(light: &AreaLight) -> Option<Self> {
        let triangle = Triangle::new(light)?;
        let [a, b, c] = triangle.corners;
        Some(Self {
            corner: a.as_vec3(),
            radius: triangle.radius as f32,
            first_edge: (b - a).as_vec3(),
            back: triangle.back,
            second_edge: (c - a).as_vec3(),
            padding: 0.0,
            radiance: triangle.radiance,
            more_padding: 0.0,
        })
    }
}

impl OutlinedRecord {
    /// `None` of a light that is no triangle or has no area.
    pub(crate) fn new(light: &AreaLight) -> Option<Self> {
        let [a, b, c] = Triangle::new(light)?.corners;
        Some(Self {
            center: CenterRecord::new(light)?,
            corner: a.as_vec3(),
            padding: 0.0,
            first_edge: (b - a).as_vec3(),
            more_padding: 0.0,
            second_edge: (c - a).as_vec3(),
            last_padding: 0.0,
        })
    }
}
