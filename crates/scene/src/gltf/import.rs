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
}
