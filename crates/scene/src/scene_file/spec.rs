//! The parts of a scene file, and the checks of their numbers.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use glam::Vec3;
use serde::Deserialize;

use crate::presets::PRESETS;
use crate::{Camera, Light, LoadError, Material, Measured};

/// A pinhole camera; lengths in metres, angles in degrees.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraSpec {
    name: String,
    position: [f32; 3],
    target: [f32; 3],
    #[serde(default = "y_axis")]
    up: [f32; 3],
    vertical_fov: f32,
}

fn y_axis() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}

/// A light; intensities in W·sr⁻¹, irradiance in W·m⁻², half-angles of cones in degrees.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "lowercase", tag = "kind")]
pub(super) enum LightSpec {
    Point { position: [f32; 3], intensity: [f32; 3] },
    Spot { position: [f32; 3], target: [f32; 3], intensity: [f32; 3], inner: f32, outer: f32 },
    Directional { direction: [f32; 3], irradiance: [f32; 3] },
}

/// What replaces parts of a material.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialSpec {
    base_color: Option<[f32; 3]>,
    metallic: Option<f32>,
    roughness: Option<f32>,
    ior: Option<f32>,
    specular: Option<f32>,
    emission: Option<[f32; 3]>,
    /// A reflectance by name, instead of all of the above but the emission.
    preset: Option<String>,
    /// Likewise, from a file: `asset:PATH` below the assets folder, or a path relative to this file.
    pub(super) measured: Option<String>,
}

impl CameraSpec {
    pub(super) fn camera(&self, place: &str) -> Result<Camera, LoadError> {
        let place = format!("{place}: camera `{}`", self.name);
        let position = vector(&place, "position", self.position)?;
        let target = vector(&place, "target", self.target)?;
        let up = vector(&place, "up", self.up)?;
        let fov = number(&place, "vertical_fov", self.vertical_fov, 0.1..=175.0)?;
        direction(&place, "target − position", target - position)?;
        direction(&place, "up", up)?;
        Ok(Camera::look_at(&self.name, position, target, up, fov.to_radians()))
    }
}

impl LightSpec {
    pub(super) fn light(&self, place: &str) -> Result<Light, LoadError> {
        let place = format!("{place}: light");
        Ok(match *self {
            Self::Point { position, intensity } => Light::Point {
                position: vector(&place, "position", position)?,
                intensity: radiance(&place, "intensity", intensity)?,
            },
            Self::Spot { position, target, intensity, inner, outer } => {
                let position = vector(&place, "position", position)?;
                let axis = vector(&place, "target", target)? - position;
                let outer = number(&place, "outer", outer, 0.1..=89.0)?;
                Light::Spot {
                    position,
                    direction: direction(&place, "target − position", axis)?,
                    intensity: radiance(&place, "intensity", intensity)?,
                    inner: number(&place, "inner", inner, 0.0..=outer)?.to_radians(),
                    outer: outer.to_radians(),
                }
            }
            Self::Directional { direction: axis, irradiance } => Light::Directional {
                direction: direction(&place, "direction", vector(&place, "direction", axis)?)?,
                irradiance: radiance(&place, "irradiance", irradiance)?,
            },
        })
    }
}

impl MaterialSpec {
    /// Changes `material`; `locate` finds the files that this one names.
    pub(super) fn apply(
        &self,
        material: &mut Material,
        place: &str,
        locate: impl Fn(&str) -> Result<PathBuf, LoadError>,
    ) -> Result<(), LoadError> {
        if let Some(emission) = self.emission {
            material.emission = radiance(place, "emission", emission)?;
        }
        if let Some(name) = &self.preset {
            self.only("preset", place)?;
            let names = PRESETS.iter().map(|preset| preset.name);
            let preset = PRESETS.iter().find(|preset| preset.name == name);
            let preset = preset.ok_or_else(|| LoadError::unknown(place, "preset", name, names))?;
            *material = material.clone().with_brdf(preset.brdf());
            return Ok(());
        }
        if let Some(file) = &self.measured {
            self.only("measured", place)?;
            let measured = Measured::load(&locate(file)?).map_err(|error| error.within(place))?;
            *material = material.clone().with_brdf(measured.brdf());
            return Ok(());
        }
        let unit = |key, value: Option<f32>, old| match value {
            Some(value) => number(place, key, value, 0.0..=1.0),
            None => Ok(old),
        };
        material.metallic = unit("metallic", self.metallic, material.metallic)?;
        material.roughness = unit("roughness", self.roughness, material.roughness)?;
        material.specular = unit("specular", self.specular, material.specular)?;
        if let Some(color) = self.base_color {
            for channel in color {
                number(place, "base_color", channel, 0.0..=1.0)?;
            }
            material.base_color = color.into();
            material.base_color_texture = None;
        }
        if let Some(ior) = self.ior {
            material.ior = number(place, "ior", ior, 1.0..=10.0)?;
        }
        Ok(())
    }

    /// Refuses factors beside a key that gives the reflectance whole.
    fn only(&self, key: &str, place: &str) -> Result<(), LoadError> {
        let factors = [
            ("base_color", self.base_color.is_some()),
            ("metallic", self.metallic.is_some()),
            ("roughness", self.roughness.is_some()),
            ("ior", self.ior.is_some()),
            ("specular", self.specular.is_some()),
            ("preset", self.preset.is_some()),
            ("measured", self.measured.is_some()),
        ];
        match factors.iter().find(|(factor, present)| *present && *factor != key) {
            Some((factor, _)) => {
                let problem = format!("{key} and {factor} exclude each other");
                Err(LoadError::new(place, problem, "keep one of them"))
            }
            None => Ok(()),
        }
    }
}

/// `value`, if it is in `range`; NaN never is.
pub(super) fn number(
    place: &str,
    key: &str,
    value: f32,
    range: RangeInclusive<f32>,
) -> Result<f32, LoadError> {
    if range.contains(&value) {
        return Ok(value);
    }
    let remedy = format!("use a number from {} to {}", range.start(), range.end());
    Err(LoadError::new(place, format!("{key} = {value} is out of range"), remedy))
}

fn vector(place: &str, key: &str, value: [f32; 3]) -> Result<Vec3, LoadError> {
    let vector = Vec3::from(value);
    if vector.is_finite() {
        return Ok(vector);
    }
    Err(LoadError::new(place, format!("{key} is not finite"), "use finite numbers"))
}

fn direction(place: &str, key: &str, value: Vec3) -> Result<Vec3, LoadError> {
    let remedy = "give it a direction";
    value
        .try_normalize()
        .ok_or_else(|| LoadError::new(place, format!("{key} has no length"), remedy))
}

/// A finite colour without negative channels.
fn radiance(place: &str, key: &str, value: [f32; 3]) -> Result<Vec3, LoadError> {
    let color = vector(place, key, value)?;
    if color.min_element() >= 0.0 {
        return Ok(color);
    }
    Err(LoadError::new(place, format!("{key} is negative"), "use numbers from 0"))
}
