//! Checks of the parsed JSON: references, required members, types of attributes.

use ::gltf as gltf_crate;
use gltf_crate::json::accessor::{ComponentType, Type};
use gltf_crate::json::mesh::{Primitive, Semantic};
use gltf_crate::json::validation::{Checked, Error, Validate};
use gltf_crate::json::{Accessor, Index, Path, Root, camera};

use super::fault::broken;
use super::notes::Notes;
use crate::LoadError;

/// Takes out of the JSON what is not used and checks that all indices of the rest are in range and
/// all required members are there.
pub(super) fn references(root: &mut Root, notes: &mut Notes) -> Result<(), LoadError> {
    strip(root, notes);
    let places = |i: usize, j: usize| format!("meshes[{i}].primitives[{j}].attributes");
    for (i, mesh) in root.meshes.iter().enumerate() {
        for (j, primitive) in mesh.primitives.iter().enumerate() {
            // The crate's own check indexes the accessors before it has checked the index.
            if primitive.attributes.values().any(|index| root.get(*index).is_none()) {
                return Err(broken(places(i, j), "refers to an accessor that does not exist"));
            }
        }
    }
    let mut first = None;
    root.validate(root, Path::new, &mut |path, error| {
        let path = path().0;
        if first.is_none() && !harmless(&path, error) {
            first = Some((path, error));
        }
    });
    if let Some((path, error)) = first {
        return Err(broken(path, error));
    }
    projections(root)
}

/// Violations of the specification that do no harm here: bounds of positions are not used, and a
/// texture without a core image (it has one in an extension's format) is noted by its material.
fn harmless(path: &str, error: Error) -> bool {
    let bounds = path.ends_with("[\"POSITION\"].min") || path.ends_with("[\"POSITION\"].max");
    let source = path.starts_with("textures[") && path.ends_with(".source");
    error == Error::Missing && (bounds || source)
}

fn strip(root: &mut Root, notes: &mut Notes) {
    root.extensions_required.clear(); // checked before
    notes.count("animations ignored", root.animations.len() as u64);
    root.animations.clear();
    notes.count("skins ignored, meshes drawn in their bind pose", root.skins.len() as u64);
    root.skins.clear();
    root.nodes.iter_mut().for_each(|node| node.skin = None);
    for primitive in root.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        let targets = primitive.targets.take();
        notes.count("morph targets ignored", targets.map_or(0, |targets| targets.len() as u64));
        let unknown = primitive.attributes.remove(&Checked::Invalid);
        notes.count("primitives with unknown attributes, ignored", u64::from(unknown.is_some()));
    }
}

/// The projection that a camera's `type` names; the crate unwraps it.
fn projections(root: &Root) -> Result<(), LoadError> {
    for (i, camera) in root.cameras.iter().enumerate() {
        let present = match camera.type_ {
            Checked::Valid(camera::Type::Perspective) => camera.perspective.is_some(),
            _ => camera.orthographic.is_some(),
        };
        if !present {
            return Err(broken(
                format!("cameras[{i}]"),
                "lacks the projection that its type names",
            ));
        }
    }
    Ok(())
}

/// Checks that every attribute and index list that is drawn has a type and count that fit.
///
/// References have been checked before.
pub(super) fn primitives(root: &Root) -> Result<(), LoadError> {
    for (i, mesh) in root.meshes.iter().enumerate() {
        for (j, drawn) in mesh.primitives.iter().enumerate() {
            primitive(root, drawn)
                .map_err(|error| error.within(format!("meshes[{i}].primitives[{j}]")))?;
        }
    }
    Ok(())
}

fn primitive(root: &Root, primitive: &Primitive) -> Result<(), LoadError> {
    use ComponentType::{F32, U8, U16, U32};
    let accessor = |index: Index<Accessor>| &root.accessors[index.value()];
    let mut vertices = None;
    for (semantic, &index) in &primitive.attributes {
        let Checked::Valid(semantic) = semantic else { continue };
        let attribute = accessor(index);
        let count = *vertices.get_or_insert(attribute.count.0);
        let name = semantic.to_string();
        let fits = match semantic {
            Semantic::Positions | Semantic::Normals => is(attribute, Type::Vec3, &[F32]),
            Semantic::TexCoords(_) => is(attribute, Type::Vec2, &[F32, U8, U16]),
            _ => continue,
        };
        if !fits {
            return Err(broken(name, "has a type that the specification does not allow"));
        }
        if attribute.count.0 != count {
            let problem = format!("has {} values, other attributes {count}", attribute.count.0);
            return Err(broken(name, problem));
        }
    }
    match primitive.indices {
        Some(index) if !is(accessor(index), Type::Scalar, &[U8, U16, U32]) => {
            Err(broken("indices", "are not unsigned integers"))
        }
        _ => Ok(()),
    }
}

fn is(accessor: &Accessor, shape: Type, components: &[ComponentType]) -> bool {
    accessor.type_ == Checked::Valid(shape)
        && matches!(accessor.component_type, Checked::Valid(c) if components.contains(&c.0))
}
