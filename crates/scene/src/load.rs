//! Finding scenes by name or by path.

use std::path::Path;

use crate::builtin::BUILTINS;
use crate::{LoadError, Scene, gltf, scene_file};

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
/// current directory, or a path that ends in `.toml`, `.glb` or `.gltf`.
///
/// `assets` is the folder to which `asset:` sources of scene files are relative (`--assets` or
/// `MANYLIGHTS_ASSETS`; the caller reads those).
///
/// # Errors
/// One line that says what is wrong, where, and how to mend it.
pub fn load(what: &str, assets: Option<&Path>) -> Result<Scene, LoadError> {
    if let Some(extension) = Path::new(what).extension() {
        let path = Path::new(what);
        match extension.to_ascii_lowercase().to_str() {
            Some("toml") => return scene_file::load(path, assets),
            Some("glb" | "gltf") => return gltf::load(path),
            _ => {}
        }
    }
    if let Some(builtin) = BUILTINS.iter().find(|builtin| builtin.name == what) {
        return Ok((builtin.make)());
    }
    let known = list();
    if known.iter().any(|entry| entry.name == what) {
        return scene_file::load(&Path::new(FOLDER).join(format!("{what}.toml")), assets);
    }
    let names = known.iter().map(|entry| entry.name.as_str());
    Err(LoadError::unknown("scene", "name", what, names))
}

/// The built-in scenes, then the scene files in `scenes` below the current directory, by name.
pub fn list() -> Vec<SceneEntry> {
    let mut files = Vec::new();
    for file in Path::new(FOLDER).read_dir().into_iter().flatten().flatten() {
        let path = file.path();
        let name = path.file_stem().and_then(|stem| stem.to_str());
        if let (Some(name), Some("toml")) = (name, path.extension().and_then(|e| e.to_str())) {
            let about = scene_file::about(&path).unwrap_or_else(|error| error.to_string());
            files.push(SceneEntry { name: name.to_owned(), about, kind: SceneKind::File });
        }
    }
    files.sort_by(|a, b| a.name.cmp(&b.name));
    let builtins = BUILTINS.iter().map(|builtin| SceneEntry {
        name: builtin.name.to_owned(),
        about: builtin.about.to_owned(),
        kind: SceneKind::Builtin,
    });
    builtins.chain(files).collect()
}
