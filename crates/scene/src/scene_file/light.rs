//! Single lights of a scene file.

use serde::Deserialize;

use super::checks::{LENGTHS, direction, number, position, radiance, vector};
use super::polygon;
use crate::{AreaLight, Light, LoadError, Scene};

/// A light; intensities in W·sr⁻¹, irradiance in W·m⁻², radiance in W·m⁻²·sr⁻¹, lengths in metres,
/// half-angles of cones in degrees.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "lowercase", tag = "kind")]
pub(super) enum LightSpec {
    Point {
        position: [f32; 3],
        intensity: [f32; 3],
    },
    Spot {
        position: [f32; 3],
        target: [f32; 3],
        intensity: [f32; 3],
        inner: f32,
        outer: f32,
    },
    Directional {
        direction: [f32; 3],
        irradiance: [f32; 3],
    },
    Sphere {
        center: [f32; 3],
        radius: f32,
        radiance: [f32; 3],
    },
    /// Planar and simple; the corners are counter-clockwise seen from the front.
    Polygon {
        corners: Vec<[f32; 3]>,
        radiance: [f32; 3],
        /// Whether the back shines, too.
        #[serde(default)]
        two_sided: bool,
    },
}

impl LightSpec {
    /// Appends the light to the scene.
    pub(super) fn add(&self, scene: &mut Scene, place: &str) -> Result<(), LoadError> {
        let light = match *self {
            Self::Point { position, intensity } => Light::Point {
                position: vector(place, "position", position)?,
                intensity: radiance(place, "intensity", intensity)?,
            },
            Self::Spot { position, target, intensity, inner, outer } => {
                let position = vector(place, "position", position)?;
                let axis = vector(place, "target", target)? - position;
                let outer = number(place, "outer", outer, 0.1..=89.0)?;
                Light::Spot {
                    position,
                    direction: direction(place, "target − position", axis)?,
                    intensity: radiance(place, "intensity", intensity)?,
                    inner: number(place, "inner", inner, 0.0..=outer)?.to_radians(),
                    outer: outer.to_radians(),
                }
            }
            Self::Directional { direction: axis, irradiance } => Light::Directional {
                direction: direction(place, "direction", vector(place, "direction", axis)?)?,
                irradiance: radiance(place, "irradiance", irradiance)?,
            },
            Self::Sphere { center, radius, radiance: sent } => {
                let sphere = AreaLight::Sphere {
                    center: position(place, "center", center)?,
                    radius: number(place, "radius", radius, LENGTHS)?,
                    radiance: radiance(place, "radiance", sent)?,
                };
                return add_area_lights(scene, place, [sphere]);
            }
            Self::Polygon { ref corners, radiance: sent, two_sided } => {
                let radiance = radiance(place, "radiance", sent)?;
                let triangles = polygon::triangles(corners, place)?.into_iter();
                let light = |corners| AreaLight::Triangle { corners, radiance, two_sided };
                return add_area_lights(scene, place, triangles.map(light));
            }
        };
        scene.lights.push(light);
        Ok(())
    }
}

/// Appends lights with a surface, unless one has no area or sends more than single precision holds.
pub(super) fn add_area_lights(
    scene: &mut Scene,
    place: &str,
    lights: impl IntoIterator<Item = AreaLight>,
) -> Result<(), LoadError> {
    for light in lights {
        if light.area() == 0.0 {
            let problem = "a triangle is too small to have an area where it lies";
            return Err(LoadError::new(place, problem, "make it larger or move it to the origin"));
        }
        if !light.power().is_finite() {
            let problem = "a light is too bright for single precision";
            return Err(LoadError::new(place, problem, "lower its power or radiance"));
        }
        scene.area_lights.push(light);
    }
    Ok(())
}
