//! Scene files: `scenes/*.toml` names a built-in scene or a glTF file and adds what it lacks.

mod spec;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use self::spec::{CameraSpec, LightSpec, MaterialSpec, number};
use crate::error::suggestion;
use crate::{LoadError, Material, Scene, builtin, gltf};

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

/// Loads a scene file and its source.
pub(crate) fn load(path: &Path, assets: Option<&Path>) -> Result<Scene, LoadError> {
    let file = read(path)?;
    let mut scene = source(path, &file, assets)?;
    scene.sources.push(path.to_owned());
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
        let found = named(&mut scene, &place, name)?;
        let place = format!("{place}: material `{name}`");
        for material in found {
            spec.apply(material, &place, |name| located(path, name, assets))?;
        }
        if let Some(name) = &spec.measured {
            scene.sources.push(located(path, name, assets)?);
        }
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

fn source(path: &Path, file: &SceneFile, assets: Option<&Path>) -> Result<Scene, LoadError> {
    match file.source.strip_prefix(builtin::PREFIX) {
        Some(name) => builtin::named(name, path.display()),
        None => gltf::load(&located(path, &file.source, assets)?, file.keep_lights),
    }
}

/// The path of a file that `file` names: `asset:PATH`, or relative to it.
fn located(file: &Path, name: &str, assets: Option<&Path>) -> Result<PathBuf, LoadError> {
    match name.strip_prefix("asset:") {
        Some(asset) => asset_path(file, asset, assets),
        None => Ok(file.parent().unwrap_or(Path::new("")).join(name)),
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

/// The materials of that name: at least one.
fn named<'a>(
    scene: &'a mut Scene,
    place: &str,
    name: &str,
) -> Result<impl Iterator<Item = &'a mut Material>, LoadError> {
    if scene.materials.iter().all(|material| material.name != name) {
        let names = scene.materials.iter().map(|material| material.name.as_str());
        return Err(LoadError::unknown(place, "material", name, names));
    }
    Ok(scene.materials.iter_mut().filter(move |material| material.name == name))
}
