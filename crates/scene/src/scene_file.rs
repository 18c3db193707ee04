//! Scene files: `scenes/*.toml` names a built-in scene or a glTF file and adds what it lacks.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::Vec3;
use serde::Deserialize;

use crate::builtin::BUILTINS;
use crate::error::suggestion;
use crate::{Camera, Light, LoadError, Material, Scene, gltf};

/// A scene file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    /// One line for `list scenes`, with the credit that the scene's licence asks for.
    about: String,
    /// `builtin:NAME`, `asset:PATH` below the assets folder, or a path relative to this file.
    source: String,
    /// Factor from radiance to display-referred values.
    exposure: Option<f32>,
    /// Whether the source's own lights stay.
    #[serde(default = "yes")]
    keep_lights: bool,
    /// These come before the source's own cameras; the first is the default.
    #[serde(default)]
    camera: Vec<CameraSpec>,
    #[serde(default)]
    light: Vec<LightSpec>,
    /// By the name of the material.
    #[serde(default)]
    material: BTreeMap<String, MaterialSpec>,
}

fn yes() -> bool {
    true
}

/// A pinhole camera; lengths in metres, angles in degrees.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraSpec {
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
enum LightSpec {
    Point { position: [f32; 3], intensity: [f32; 3] },
    Spot { position: [f32; 3], target: [f32; 3], intensity: [f32; 3], inner: f32, outer: f32 },
    Directional { direction: [f32; 3], irradiance: [f32; 3] },
}

/// What replaces parts of a material.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MaterialSpec {
    base_color: Option<[f32; 3]>,
    metallic: Option<f32>,
    roughness: Option<f32>,
    ior: Option<f32>,
    specular: Option<f32>,
    emission: Option<[f32; 3]>,
}

/// Loads a scene file and its source.
pub(crate) fn load(path: &Path, assets: Option<&Path>) -> Result<Scene, LoadError> {
    let file = read(path)?;
    let mut scene = source(path, &file.source, assets)?;
    if let Some(stem) = path.file_stem() {
        scene.name = stem.to_string_lossy().into_owned();
    }
    let place = path.display().to_string();
    if let Some(exposure) = file.exposure {
        scene.exposure = number(&place, "exposure", exposure, 1e-12..=1e12)?;
    }
    if !file.keep_lights {
        scene.lights.clear();
    }
    for light in &file.light {
        scene.lights.push(light.light(&place)?);
    }
    let cameras: Result<Vec<_>, _> = file.camera.iter().map(|spec| spec.camera(&place)).collect();
    scene.cameras.splice(0..0, cameras?);
    for (name, spec) in &file.material {
        override_material(&mut scene, &place, name, spec)?;
    }
    Ok(scene)
}

/// The `about` line of a scene file.
pub(crate) fn about(path: &Path) -> Result<String, LoadError> {
    read(path).map(|file| crate::error::one_line(&file.about))
}

fn read(path: &Path) -> Result<SceneFile, LoadError> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| LoadError::new(path.display(), error, "check the path"))?;
    toml::from_str(&text).map_err(|error| {
        let line = error.span().map(|span| text[..span.start].matches('\n').count() + 1);
        let place = match line {
            Some(line) => format!("{}:{line}", path.display()),
            None => path.display().to_string(),
        };
        LoadError::new(place, error.message(), remedy(error.message()))
    })
}

/// The nearest key where serde says "unknown field `a`, expected one of `b`, `c`" (or "variant").
fn remedy(message: &str) -> String {
    let mut quoted = message.split('`').skip(1).step_by(2);
    match quoted.next() {
        Some(word) if message.starts_with("unknown ") => suggestion(word, quoted),
        _ => "correct the scene file".to_owned(),
    }
}

fn source(file: &Path, source: &str, assets: Option<&Path>) -> Result<Scene, LoadError> {
    if let Some(name) = source.strip_prefix("builtin:") {
        let names = BUILTINS.iter().map(|builtin| builtin.name);
        return match BUILTINS.iter().find(|builtin| builtin.name == name) {
            Some(builtin) => Ok((builtin.make)()),
            None => Err(LoadError::unknown(file.display(), "built-in scene", name, names)),
        };
    }
    match source.strip_prefix("asset:") {
        Some(asset) => gltf::load(&asset_path(file, asset, assets)?),
        None => gltf::load(&file.parent().unwrap_or(Path::new("")).join(source)),
    }
}

fn asset_path(file: &Path, asset: &str, assets: Option<&Path>) -> Result<PathBuf, LoadError> {
    let remedy = "set MANYLIGHTS_ASSETS or --assets to a folder that has it; the models come from \
                  the archives that README.md lists under Scenes";
    let Some(assets) = assets else {
        let problem = format!("needs the asset `{asset}`, and no assets folder is set");
        return Err(LoadError::new(file.display(), problem, remedy));
    };
    let path = assets.join(asset);
    if path.is_file() {
        return Ok(path);
    }
    let problem = format!("needs the asset `{asset}`, which {} lacks", assets.display());
    Err(LoadError::new(file.display(), problem, remedy))
}

impl CameraSpec {
    fn camera(&self, place: &str) -> Result<Camera, LoadError> {
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
    fn light(&self, place: &str) -> Result<Light, LoadError> {
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

fn override_material(
    scene: &mut Scene,
    place: &str,
    name: &str,
    spec: &MaterialSpec,
) -> Result<(), LoadError> {
    let mut found: Vec<_> = scene.materials.iter_mut().filter(|m| m.name == name).collect();
    if found.is_empty() {
        let names = scene.materials.iter().map(|material| material.name.as_str());
        return Err(LoadError::unknown(place, "material", name, names));
    }
    let place = format!("{place}: material `{name}`");
    for material in &mut found {
        spec.apply(material, &place)?;
    }
    Ok(())
}

impl MaterialSpec {
    fn apply(&self, material: &mut Material, place: &str) -> Result<(), LoadError> {
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
        if let Some(emission) = self.emission {
            material.emission = radiance(place, "emission", emission)?;
        }
        Ok(())
    }
}

fn number(
    place: &str,
    key: &str,
    value: f32,
    range: std::ops::RangeInclusive<f32>,
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
    value.try_normalize().ok_or_else(|| LoadError::new(place, format!("{key} has no length"), remedy))
}

/// A finite colour without negative channels.
fn radiance(place: &str, key: &str, value: [f32; 3]) -> Result<Vec3, LoadError> {
    let color = vector(place, key, value)?;
    if color.min_element() >= 0.0 {
        return Ok(color);
    }
    Err(LoadError::new(place, format!("{key} is negative"), "use numbers from 0"))
}
