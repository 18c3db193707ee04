use super::materials::Materials;
use super::notes::Notes;
use super::source::Source;
use crate::Scene;

/// A scene in the making.
pub(super) struct Import<'a> {
    pub(super) source: Source<'a>,
    pub(super) materials: Materials,
    pub(super) notes: Notes,
    pub(super) scene: Scene,
    /// Whether its lights are wanted.
    pub(super) keep_lights: bool,
    /// Of the scene's cameras, metres.
    pub(super) far_planes: Vec<f32>,
    /// Triangles that single precision rounds visibly.
    pub(super) rounded: u64,
    /// Those of them whose primitive is as small for its distance from the origin.
    pub(super) rounded_whole: u64,
}
