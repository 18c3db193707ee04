//! Scene files: `scenes/*.toml` names a built-in scene or a glTF file and adds what it lacks.

mod arrangement;
mod checks;
mod document;
mod light;
mod light_set;
mod panel;
mod part;
mod picture;
mod polygon;
mod random;
mod spec;

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use toml::Spanned;

use self::checks::number;
use self::document::Document;
use self::light::LightSpec;
use self::light_set::LightSetSpec;
use self::part::PartSpec;
use self::spec::{CameraSpec, MaterialSpec};
use crate::{LoadError, Scene};

/// A scene file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    /// One line for `list scenes`, with the credit that the scene's licence asks for.
    about: String,
    /// `builtin:NAME`, `asset:PATH` below the assets folder, or a path relative to this file.
    source: Option<String>,
    /// Factor from radiance to display-referred values.
    exposure: Option<Spanned<f32>>,
    /// Whether the source's own lights stay.
    #[serde(default = "yes")]
    keep_lights: bool,
    /// These come before the source's own cameras; the first is the default.
    #[serde(default)]
    camera: Vec<Spanned<CameraSpec>>,
    #[serde(default)]
    light: Vec<Spanned<LightSpec>>,
    /// Sets of lights, a table each.
    #[serde(default)]
    lights: Vec<Spanned<LightSetSpec>>,
    /// Surfaces of other files.
    #[serde(default)]
    part: Vec<Spanned<PartSpec>>,
    /// By the name of the material.
    #[serde(default)]
    material: BTreeMap<String, Spanned<MaterialSpec>>,
}

fn yes() -> bool {
    true
}

/// Loads a scene file and its sources.
pub(crate) fn load(path: &Path, assets: Option<&Path>) -> Result<Scene, LoadError> {
    let document = &Document::read(path, assets)?;
    let file: SceneFile = document.parse()?;
    let mut scene = match &file.source {
        Some(source) => document.source(source, file.keep_lights)?,
        None if file.part.is_empty() => {
            let remedy = "add source = \"builtin:NAME\" or a [[part]]";
            return Err(LoadError::new(path.display(), "has neither a source nor a part", remedy));
        }
        None => Scene { exposure: 1.0, ..Scene::default() },
    };
    scene.sources.push(path.to_owned());
    if let Some(stem) = path.file_stem() {
        scene.name = stem.to_string_lossy().into_owned();
    }
    if let Some(exposure) = &file.exposure {
        let place = document.place(exposure.span());
        scene.exposure = number(&place, "exposure", *exposure.get_ref(), 1e-12..=1e12)?;
    }
    if !file.keep_lights {
        scene.lights.clear();
        scene.area_lights.clear();
    }
    add_parts(&mut scene, document, &file)?;
    let place = |spec: &Spanned<CameraSpec>| document.place(spec.span());
    let cameras: Result<Vec<_>, _> =
        file.camera.iter().map(|spec| spec.get_ref().camera(&place(spec))).collect();
    scene.cameras.splice(0..0, cameras?);
    Ok(scene)
}

/// Surfaces and lights, then what replaces parts of materials.
fn add_parts(scene: &mut Scene, document: &Document, file: &SceneFile) -> Result<(), LoadError> {
    for part in &file.part {
        let place = format!("{}: part", document.place(part.span()));
        part.get_ref().add(scene, document, &place)?;
    }
    for light in &file.light {
        let place = format!("{}: light", document.place(light.span()));
        light.get_ref().add(scene, &place)?;
    }
    for lights in &file.lights {
        let place = format!("{}: lights", document.place(lights.span()));
        lights.get_ref().add(scene, document, &place)?;
    }
    for (name, spec) in &file.material {
        let place = document.place(spec.span());
        if scene.materials.iter().all(|material| material.name != *name) {
            let names = scene.materials.iter().map(|material| material.name.as_str());
            return Err(LoadError::unknown(place, "material", name, names));
        }
        let place = format!("{place}: material `{name}`");
        spec.get_ref().apply_to(scene, document, &place, |material| material.name == *name)?;
    }
    Ok(())
}

/// The `about` line of a scene file.
pub(crate) fn about(path: &Path) -> Result<String, LoadError> {
    let file: SceneFile = Document::read(path, None)?.parse()?;
    Ok(crate::error::one_line(&file.about))
}
