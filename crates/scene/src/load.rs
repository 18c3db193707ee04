//! Finding scenes by name or by path.

use std::path::{Path, PathBuf};

use glam::Vec3;

use crate::builtin::{self, BUILTINS};
use crate::material::MIN_ROUGHNESS;
use crate::{Camera, LoadError, Material, Scene, gltf, scene_file};

/// Where scene files are looked up by name, below the current directory.
const FOLDER: &str = "scenes";

/// What stands behind a scene's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneKind {
    /// Made by code.
    Builtin,
    /// `scenes/NAME.toml`.
    File,
}

/// A scene that [`load`] finds by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneEntry {
    /// What to call it.
    pub name: String,
    /// One line about it; for a scene file that cannot be read, why.
    pub about: String,
    /// Where it comes from.
    pub kind: SceneKind,
}

/// Loads a scene: `what` is the name of a built-in scene, the name of a `scenes/NAME.toml` below the
/// current directory, or a path that ends in `.toml`, `.glb` or `.gltf`. A name that both have is
/// refused: `builtin:NAME` and the path mean one alone.
///
/// `assets` is the folder to which `asset:` sources of scene files are relative (`--assets` or
/// `MANYLIGHTS_ASSETS`; the caller reads those).
///
/// # Errors
/// One line that says what is wrong, where, and how to mend it.
pub fn load(what: &str, assets: Option<&Path>) -> Result<Scene, LoadError> {
    let mut scene = find(what, assets)?;
    if scene.lights.is_empty() && scene.all_area_lights().next().is_none() {
        scene.notes.push("no light: every picture is black".to_owned());
    }
    let is_mirror = |material: &&Material| {
        let factors = material.given.is_none() && material.has_specular();
        factors && material.roughness < MIN_ROUGHNESS
    };
    let mirrors = scene.materials.iter().filter(is_mirror).count();
    if mirrors > 0 {
        let note = format!("materials smoother than roughness {MIN_ROUGHNESS}, drawn at it");
        scene.notes.push(format!("{note}: {mirrors}"));
    }
    if scene.cameras.is_empty() {
        scene.notes.push("no camera: framed from outside".to_owned());
        let (low, high) = scene.bounds();
        scene.cameras.push(frame(low, high));
    }
    Ok(scene)
}

fn find(what: &str, assets: Option<&Path>) -> Result<Scene, LoadError> {
    let path = Path::new(what);
    if let Some(extension) = path.extension() {
        match extension.to_ascii_lowercase().to_str() {
            Some("toml") => return scene_file::load(path, assets),
            Some("glb" | "gltf") => return gltf::load(path, true),
            _ if path.is_file() => {
                let remedy = "use a .toml, .glb or .gltf file";
                return Err(LoadError::new(what, "is not a scene file", remedy));
            }
            _ => {}
        }
    }
    if let Some(name) = what.strip_prefix(builtin::PREFIX) {
        return builtin::named(name, "scenes");
    }
    let file = files().into_iter().find(|(name, _)| name == what).map(|(_, path)| path);
    match (is_builtin(what), file) {
        (true, None) => builtin::named(what, "scenes"),
        (false, Some(path)) => scene_file::load(&path, assets),
        (true, Some(path)) => {
            let problem = format!("is a built-in scene and {} too", path.display());
            let remedy = format!("say {}{what} or {}", builtin::PREFIX, path.display());
            Err(LoadError::new(format!("scene `{what}`"), problem, remedy))
        }
        (false, None) => {
            let known = list();
            let names = known.iter().map(|entry| entry.name.as_str());
            let place = "scenes (built-in, or scenes/NAME.toml here)";
            Err(LoadError::unknown(place, "name", what, names))
        }
    }
}

fn is_builtin(name: &str) -> bool {
    BUILTINS.iter().any(|builtin| builtin.name == name)
}

/// A camera that sees the box from `low` to `high` whole, from the front and a little above.
fn frame(low: Vec3, high: Vec3) -> Camera {
    const FOV: f32 = 0.7;
    let centre = low.midpoint(high);
    let radius = 0.5 * low.distance(high);
    let distance = if radius > 0.0 { radius / (0.5 * FOV).sin() } else { 1.0 };
    let position = centre + distance * Vec3::new(0.4, 0.35, 1.0).normalize();
    Camera::look_at("framed", position, centre, Vec3::Y, FOV)
}

/// The built-in scenes, then the scene files in `scenes` below the current directory, by name. Each
/// is called what [`load`] takes for it.
pub fn list() -> Vec<SceneEntry> {
    let files = files();
    let is_file = |name: &str| files.iter().any(|(file, _)| file == name);
    let builtins = BUILTINS.iter().map(|builtin| {
        let prefix = if is_file(builtin.name) { builtin::PREFIX } else { "" };
        let name = format!("{prefix}{}", builtin.name);
        SceneEntry { name, about: builtin.about.to_owned(), kind: SceneKind::Builtin }
    });
    let of_files = files.iter().map(|(name, path)| {
        let name = if is_builtin(name) { path.display().to_string() } else { name.clone() };
        let about = scene_file::about(path).unwrap_or_else(|error| error.to_string());
        SceneEntry { name, about, kind: SceneKind::File }
    });
    builtins.chain(of_files).collect()
}

/// Names and paths of the scene files in `scenes` below the current directory, by name.
fn files() -> Vec<(String, PathBuf)> {
    let mut files = Vec::new();
    for file in Path::new(FOLDER).read_dir().into_iter().flatten().flatten() {
        let path = file.path();
        let name = path.file_stem().and_then(|stem| stem.to_str());
        if let (Some(name), Some("toml")) = (name, path.extension().and_then(|e| e.to_str())) {
            files.push((name.to_owned(), path));
        }
    }
    files.sort();
    files
}
