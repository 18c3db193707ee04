//! What one light or one direction brings to a point, and with which density.

use glam::Vec3;
use manylights_scene::light::Illumination;
use manylights_scene::{SurfacePoint, Visibility};

use crate::beams::Beams;

/// Direct illumination by one point-like light.
pub(crate) struct Lit {
    /// Index into the lights of the scene.
    pub(crate) light: usize,
    /// Of the point, by this light.
    pub(crate) at: Illumination,
    /// Towards the viewer.
    pub(crate) radiance: Vec3,
}

/// Whether the plane of a point's triangle lets light from `direction` arrive: it hides what is behind
/// it, as any surface does.
pub(crate) fn may_arrive(point: &SurfacePoint, direction: Vec3, visibility: Visibility) -> bool {
    visibility == Visibility::Ignored || point.geometric_normal.dot(direction) > 0.0
}

/// Radiance towards `to_viewer` of a point that a light illuminates; zero where the light is behind
/// the shading normal.
pub(crate) fn reflected(point: &SurfacePoint, to_viewer: Vec3, at: &Illumination) -> Vec3 {
    let cos = point.normal.dot(at.to_light);
    if cos <= 0.0 || at.irradiance == Vec3::ZERO {
        return Vec3::ZERO;
    }
    point.brdf.eval(point.normal, to_viewer, at.to_light) * at.irradiance * cos
}

/// A density over solid angle at `from` as one over area at `to`, m⁻².
pub(crate) fn area_density(density: f32, from: &SurfacePoint, to: &SurfacePoint) -> f32 {
    let offset = to.position - from.position;
    let distance2 = offset.length_squared();
    density * to.geometric_normal.dot(offset).abs() / (distance2 * distance2.sqrt())
}

/// Weight of a camera path of area density `density` against the path from the light.
pub(crate) fn beam_weight(
    beams: Option<&Beams<'_>>,
    density: f32,
    point: &SurfacePoint,
    lit: &Lit,
) -> f32 {
    match beams {
        Some(beams) => density / (density + beams.density(lit.light, point, &lit.at)),
        None => 1.0,
    }
}
