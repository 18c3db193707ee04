//! Import of glTF 2.0 files, `.glb` and `.gltf`.
//!
//! Files come from anywhere. Everything that the `gltf` crate takes on trust is checked first, so
//! that it neither panics nor reads a broken file in silence: indices, lengths against the data that
//! is there, the shape of the node hierarchy, URIs. What the renderers here cannot show is left out
//! and noted; what would change the geometry is refused.

mod buffers;
mod container;
mod fault;
mod import;
mod materials;
mod nodes;
mod notes;
mod optics;
mod primitives;
mod ranges;
mod source;
mod textures;
mod validate;

use std::path::Path;

use ::gltf as gltf_crate;
use gltf_crate::Document;

use self::buffers::Buffers;
use self::import::Import;
use self::materials::Materials;
use self::notes::Notes;
use self::source::Source;
use crate::{LoadError, Scene};

/// Loads a glTF file: its default scene, in world space.
///
/// # Errors
/// One line with the file, the place in it and what is wrong.
pub(crate) fn load(path: &Path) -> Result<Scene, LoadError> {
    import(path).map_err(|error| error.within(path.display()))
}

fn import(path: &Path) -> Result<Scene, LoadError> {
    let bytes = std::fs::read(path)
        .map_err(|error| LoadError::new("cannot be read", error, "check the path"))?;
    let container::Parts { mut root, binary } = container::open(&bytes)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut notes = Notes::default();
    validate::references(&mut root, &mut notes)?;
    validate::primitives(&root)?;
    let buffers = &Buffers::read(&root, folder, binary)?;
    ranges::check(&root, buffers)?;
    let roots = nodes::roots(&root, &mut notes)?;
    let document = &Document::from_json_without_validation(root);
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut import = Import {
        source: Source { document, buffers, folder },
        materials: Materials::default(),
        notes,
        scene: Scene { name, exposure: 1.0, ..Scene::default() },
    };
    nodes::add_all(&mut import, roots)?;
    let Import { scene, notes, .. } = import;
    Ok(Scene { notes: notes.into_lines(), ..scene })
}
