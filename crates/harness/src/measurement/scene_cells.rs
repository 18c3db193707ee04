//! The cells of a scene, and where their pictures are.

use std::path::{Path, PathBuf};

use crate::measurement::cell::Cell;
use crate::measurement::reference::SceneReference;
use crate::question::plan::Turn;

/// A scene, seen by one camera, with all its cells.
pub(crate) struct SceneCells {
    /// Its name, with that of the camera where the experiment lists some.
    pub(crate) scene: String,
    /// The camera's name, where the experiment lists some.
    pub(crate) camera: Option<String>,
    /// Its exposure.
    pub(crate) exposure: f32,
    /// In the order of the experiment's references.
    pub(crate) references: Vec<SceneReference>,
    /// In the order in which they ran.
    pub(crate) cells: Vec<(Turn, Cell)>,
}

/// The picture of a cell, without extension. The name is the key's: settings may be many.
pub(crate) fn image_path(out: &Path, scene: &str, key: &str) -> PathBuf {
    out.join("cells").join(format!("{scene}-{}", &key[..16]))
}
