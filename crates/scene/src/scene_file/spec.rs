//! Cameras and materials of a scene file.

use serde::Deserialize;

use super::checks::{direction, number, radiance, vector};
use super::document::Document;
use crate::presets::PRESETS;
use crate::{Camera, LoadError, Material, Measured, Scene};

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
    /// Whether the emission leaves both sides.
    two_sided: Option<bool>,
    /// A reflectance by name, instead of all of the above but the emission and its sides.
    preset: Option<String>,
    /// Likewise, from a file: `asset:PATH` below the assets folder, or a path relative to this file.
    measured: Option<String>,
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

impl MaterialSpec {
    /// Changes the materials of a scene that `is_meant` picks.
    pub(super) fn apply_to(
        &self,
        scene: &mut Scene,
        document: &Document,
        place: &str,
        is_meant: impl Fn(&Material) -> bool,
    ) -> Result<(), LoadError> {
        for material in scene.materials.iter_mut().filter(|material| is_meant(material)) {
            self.apply(material, document, place)?;
        }
        if let Some(file) = &self.measured {
            scene.sources.push(document.located(file)?);
        }
        Ok(())
    }

    fn apply(
        &self,
        material: &mut Material,
        document: &Document,
        place: &str,
    ) -> Result<(), LoadError> {
        if let Some(emission) = self.emission {
            material.emission = radiance(place, "emission", emission)?;
        }
        material.two_sided = self.two_sided.unwrap_or(material.two_sided);
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
            let measured =
                Measured::load(&document.located(file)?).map_err(|error| error.within(place))?;
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
