//! Import of glTF 2.0 files, `.glb` and `.gltf`.
//!
//! Files come from anywhere. Everything that the `gltf` crate takes on trust is checked first, so
//! that it neither panics nor reads a broken file in silence: indices, lengths against the data that
//! is there, the shape of the node hierarchy, URIs. What the renderers here cannot show is left out
//! and noted; what would change the geometry is refused.

mod buffers;
mod container;
mod extensions;
mod fault;
mod import;
mod materials;
mod mentions;
mod nodes;
mod notes;
mod optics;
mod place;
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
pub(crate) use self::nodes::MAX_ELEMENTS;
use self::notes::Notes;
use self::source::Source;
use crate::{Camera, LoadError, Scene};

/// Loads a glTF file: its default scene, in world space, with its lights or without.
///
/// # Errors
/// One line with the file, the place in it and what is wrong.
pub(crate) fn load(path: &Path, keep_lights: bool) -> Result<Scene, LoadError> {
    import(path, keep_lights).map_err(|error| error.within(path.display()))
}

fn import(path: &Path, keep_lights: bool) -> Result<Scene, LoadError> {
    let bytes = std::fs::read(path)
        .map_err(|error| LoadError::new("cannot be read", error, "check the path"))?;
    let container::Parts { mut root, binary, mentions } = container::open(&bytes)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut notes = Notes::default();
    for (name, objects) in mentions.extensions {
        notes.count(format!("extension {name} ignored"), objects);
    }
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
        keep_lights,
        far_planes: Vec::new(),
        rounded: 0,
        rounded_whole: 0,
    };
    nodes::add_all(&mut import, roots)?;
    note_whole(&mut import);
    let Import { mut scene, notes, .. } = import;
    scene.sources.push(path.to_owned());
    scene.sources.extend(mentions.uris.iter().map(|uri| buffers::mentioned(uri, folder)));
    Ok(Scene { notes: notes.into_lines(), ..scene })
}

/// Notes that need the whole scene.
fn note_whole(import: &mut Import) {
    let Import { scene, notes, far_planes, .. } = import;
    let (low, high) = scene.bounds();
    let is_cut = |(camera, far): &(&Camera, &f32)| {
        let farthest = (camera.forward * low).max(camera.forward * high).element_sum();
        farthest - camera.forward.dot(camera.position) > **far
    };
    let cut = scene.cameras.iter().zip(&*far_planes).filter(is_cut).count();
    notes.count("cameras whose far plane cuts the scene, drawn without it", cut as u64);
    // Some small triangles are in every scene, not so most of them or a whole object.
    let most = 2 * import.rounded > scene.triangles.len() as u64;
    notes.count(
        "triangles too far from the origin for single precision, rounded (move the scene there)",
        if most { import.rounded } else { import.rounded_whole },
    );
}
