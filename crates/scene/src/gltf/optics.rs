//! Lights (`KHR_lights_punctual`) and cameras.

use std::f32::consts::{FRAC_PI_2, PI};

use ::gltf as gltf_crate;
use glam::{Mat4, Vec3};
use gltf_crate::camera::Projection;
use gltf_crate::khr_lights_punctual::Kind;

use super::fault::broken;
use super::import::Import;
use crate::{Camera, Light, LoadError};

/// Widest half-angle of a spot light: at a right angle its map of texels would be infinite.
const MAX_CONE: f32 = 89.0 * PI / 180.0;

/// The extension's units are the candela and the lux, and it leaves open how many of them make a watt.
const PHOTOMETRIC: &str = "lights in candela or lux, taken as W/sr or W/m² (683 times too bright if exported at 683 lm/W)";

/// Adds the light of a node.
///
/// # Errors
/// Intensities or angles out of range, transforms that are not finite.
pub(super) fn add_light(
    import: &mut Import,
    light: &gltf_crate::khr_lights_punctual::Light,
    to_world: Mat4,
) -> Result<(), LoadError> {
    let intensity = Vec3::from(light.color()) * light.intensity();
    if !intensity.is_finite() || intensity.min_element() < 0.0 {
        return Err(broken("light", "its colour times its intensity is negative or infinite"));
    }
    import.notes.count(PHOTOMETRIC, 1);
    import.notes.count("lights whose range is ignored", light.range().is_some().into());
    import.scene.lights.push(match light.kind() {
        Kind::Point => Light::Point { position: origin(to_world)?, intensity },
        Kind::Directional => {
            Light::Directional { direction: axis(to_world, Vec3::NEG_Z)?, irradiance: intensity }
        }
        Kind::Spot { inner_cone_angle: inner, outer_cone_angle: outer } => {
            // Exporters round π/2 up.
            if !(0.0 <= inner && inner < outer && outer <= FRAC_PI_2 + 1e-4) {
                let problem =
                    format!("the angles {inner}, {outer} are not 0 ≤ inner < outer ≤ π/2");
                return Err(broken("light.spot", problem));
            }
            import.notes.count("spot lights narrowed to 89°", (outer > MAX_CONE).into());
            let [inner, outer] = [inner.min(MAX_CONE), outer.min(MAX_CONE)];
            let direction = axis(to_world, Vec3::NEG_Z)?;
            Light::Spot { position: origin(to_world)?, direction, intensity, inner, outer }
        }
    });
    Ok(())
}

/// Adds the camera of a node, under the name of the node if it has one.
///
/// # Errors
/// Angles out of range, transforms that are not finite.
pub(super) fn add_camera(
    import: &mut Import,
    camera: &gltf_crate::Camera,
    node_name: Option<&str>,
    to_world: Mat4,
) -> Result<(), LoadError> {
    let Projection::Perspective(lens) = camera.projection() else {
        import.notes.count("orthographic cameras left out", 1);
        return Ok(());
    };
    let fov = lens.yfov();
    if !(fov > 0.0 && fov < PI) {
        return Err(broken("camera.perspective.yfov", format!("{fov} is not between 0 and π")));
    }
    let cameras = &mut import.scene.cameras;
    let fallback = format!("camera-{}", cameras.len());
    let mut name = node_name.or(camera.name()).map_or(fallback, str::to_owned);
    while cameras.iter().any(|camera| camera.name == name) {
        name.push('+');
    }
    let forward = axis(to_world, Vec3::NEG_Z)?;
    let up = axis(to_world, Vec3::Y)?;
    // Aimed from the origin: far from it `position + forward` would be rounded.
    let aimed = Camera::look_at(&name, Vec3::ZERO, forward, up, fov);
    cameras.push(Camera { position: origin(to_world)?, ..aimed });
    import.far_planes.push(lens.zfar().unwrap_or(f32::INFINITY));
    Ok(())
}

/// A unit direction of a node's frame in world space.
fn axis(to_world: Mat4, local: Vec3) -> Result<Vec3, LoadError> {
    let axis = to_world.transform_vector3(local).try_normalize();
    axis.ok_or_else(|| broken("transform", "has no finite, non-zero scale"))
}

fn origin(to_world: Mat4) -> Result<Vec3, LoadError> {
    let origin = to_world.w_axis.truncate();
    if origin.is_finite() { Ok(origin) } else { Err(broken("transform", "is not finite")) }
}
