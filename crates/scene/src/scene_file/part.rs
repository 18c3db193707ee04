//! Parts of a scene: `[[part]]`.

use std::path::Path;

use glam::{Affine3A, Mat3, Quat, Vec3};
use serde::Deserialize;

use super::checks::{LENGTHS, number, position, vector};
use super::document::Document;
use super::spec::MaterialSpec;
use crate::{LoadError, Scene, builtin, gltf};

/// A scene whose surfaces become part of this one.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PartSpec {
    source: String,
    #[serde(default)]
    transform: TransformSpec,
    /// For all its materials.
    material: Option<MaterialSpec>,
}

/// Scaled, then turned, then moved.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
struct TransformSpec {
    /// Metres.
    translation: [f32; 3],
    /// Degrees about x, then y, then z.
    rotation: [f32; 3],
    scale: [f32; 3],
}

impl Default for TransformSpec {
    fn default() -> Self {
        Self { translation: [0.0; 3], rotation: [0.0; 3], scale: [1.0; 3] }
    }
}

impl PartSpec {
    /// Appends the part's surfaces to the scene; its lights and cameras are left out. Materials and
    /// notes get the name of the source before theirs.
    pub(super) fn add(
        &self,
        scene: &mut Scene,
        document: &Document,
        place: &str,
    ) -> Result<(), LoadError> {
        let mut part = document.source(&self.source, true).map_err(|error| error.within(place))?;
        note_left_out(&mut part);
        self.transform.apply(&mut part, place)?;
        if let Some(spec) = &self.material {
            spec.apply_to(&mut part, document, place, |_| true)?;
        }
        let name = name_beside(scene, &self.source);
        for material in &mut part.materials {
            material.name = format!("{name}/{}", material.name);
        }
        for note in &mut part.notes {
            *note = format!("{name}: {note}");
        }
        merge(scene, part, place)
    }
}

fn note_left_out(part: &mut Scene) {
    let lights = part.lights.len() + part.area_lights.len();
    for (what, number) in [("lights", lights), ("cameras", part.cameras.len())] {
        if number > 0 {
            part.notes.push(format!("{what} of a part left out: {number}"));
        }
    }
}

impl TransformSpec {
    fn apply(&self, part: &mut Scene, place: &str) -> Result<(), LoadError> {
        let translation = position(place, "translation", self.translation)?;
        let [x, y, z] = vector(place, "rotation", self.rotation)?.to_array().map(f32::to_radians);
        let rotation =
            Quat::from_rotation_z(z) * Quat::from_rotation_y(y) * Quat::from_rotation_x(x);
        for factor in self.scale {
            number(place, "scale", factor, LENGTHS)?;
        }
        let scale = Vec3::from(self.scale);
        let to_world = Affine3A::from_scale_rotation_translation(scale, rotation, translation);
        // Normals go with the inverse transpose.
        let of_normals = Mat3::from_quat(rotation) * Mat3::from_diagonal(scale.recip());
        for vertex in &mut part.vertices {
            vertex.position = to_world.transform_point3(vertex.position);
            vertex.normal = (of_normals * vertex.normal).normalize();
        }
        if part.vertices.iter().any(|vertex| !vertex.position.is_finite()) {
            let problem = "the transform moves vertices out of single precision";
            return Err(LoadError::new(place, problem, "use smaller numbers"));
        }
        let before = part.triangles.len();
        let has_area: Vec<_> =
            (0..before as u32).map(|i| part.geometric_normal(i).is_finite()).collect();
        let mut has_area = has_area.into_iter();
        part.triangles.retain(|_| has_area.next().expect("one for each triangle"));
        let lost = before - part.triangles.len();
        if lost > 0 {
            part.notes.push(format!("triangles without area after the transform left out: {lost}"));
        }
        Ok(())
    }
}

/// The stem of a source, with a number where the scene has a part of that name.
fn name_beside(scene: &Scene, source: &str) -> String {
    let path = source.strip_prefix(builtin::PREFIX).unwrap_or(source);
    let path = path.strip_prefix("asset:").unwrap_or(path);
    let stem = Path::new(path).file_stem().unwrap_or_default().to_string_lossy();
    let is_free = |name: &String| {
        let prefix = format!("{name}/");
        scene.materials.iter().all(|material| !material.name.starts_with(&prefix))
    };
    let numbered = (2..).map(|number| format!("{stem}-{number}"));
    std::iter::once(stem.to_string()).chain(numbered).find(is_free).expect("numbers have no end")
}

fn merge(scene: &mut Scene, part: Scene, place: &str) -> Result<(), LoadError> {
    let elements = |scene: &Scene| (scene.vertices.len() + 3 * scene.triangles.len()) as u128;
    let total = elements(scene) + elements(&part);
    if total > gltf::MAX_ELEMENTS {
        let problem =
            format!("{total} vertices and indices in all parts, more than {}", gltf::MAX_ELEMENTS);
        return Err(LoadError::new(place, problem, "reduce the meshes or the parts"));
    }
    let [vertices, materials, textures] =
        [scene.vertices.len(), scene.materials.len(), scene.textures.len()].map(|n| n as u32);
    scene.vertices.extend(part.vertices);
    scene.triangles.extend(part.triangles.into_iter().map(|mut triangle| {
        triangle.vertices = triangle.vertices.map(|vertex| vertices + vertex);
        triangle.material += materials;
        triangle
    }));
    scene.materials.extend(part.materials.into_iter().map(|mut material| {
        material.base_color_texture = material.base_color_texture.map(|texture| textures + texture);
        material
    }));
    scene.textures.extend(part.textures);
    scene.notes.extend(part.notes);
    scene.sources.extend(part.sources);
    Ok(())
}
