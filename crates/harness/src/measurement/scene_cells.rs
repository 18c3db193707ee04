//! The cells of a scene.

use crate::measurement::cell::Cell;
use crate::measurement::provenance::Provenance;
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

impl SceneCells {
    /// Where the cells of some scenes were made: that of the last one on an adapter, where there is one.
    /// Of no cells there is none.
    pub(crate) fn provenance(scenes: &[Self]) -> Option<&Provenance> {
        let cells = || scenes.iter().flat_map(|scene| &scene.cells).map(|(_, cell)| cell).rev();
        let on_adapter = cells().find(|cell| cell.provenance.adapter.is_some());
        on_adapter.or_else(|| cells().next()).map(|cell| &cell.provenance)
    }
}
