//! Materials, made when the first triangle uses them: a scene pays for what it contains.

use std::collections::HashMap;

use ::gltf as gltf_crate;
use glam::Vec3;
use gltf_crate::material::AlphaMode;

use super::fault::broken;
use super::notes::Notes;
use super::source::Source;
use super::textures::{self, Textures};
use crate::{LoadError, Material, Scene};

/// Materials of the file that are in the scene already.
#[derive(Default)]
pub(super) struct Materials {
    indices: HashMap<Option<usize>, u32>,
    textures: Textures,
}

impl Materials {
    /// The index of a material in the scene; makes it at its first use.
    ///
    /// # Errors
    /// Factors out of range, textures that cannot be read.
    pub(super) fn index(
        &mut self,
        material: &gltf_crate::Material,
        source: Source,
        scene: &mut Scene,
        notes: &mut Notes,
    ) -> Result<u32, LoadError> {
        if let Some(&index) = self.indices.get(&material.index()) {
            return Ok(index);
        }
        let place = || match material.index() {
            Some(index) => format!("materials[{index}]"),
            None => "default material".to_owned(),
        };
        let mut made = convert(material, notes).map_err(|error| error.within(place()))?;
        let surface = material.pbr_metallic_roughness();
        if let Some(info) = surface.base_color_texture() {
            made.base_color_texture = self.textures.index(&info.texture(), source, scene, notes)?;
        }
        if let Some(info) = surface.metallic_roughness_texture() {
            let mean = textures::mean(&info.texture(), source, notes)?;
            made.roughness *= mean.y;
            made.metallic *= mean.z;
        }
        let index = scene.materials.len() as u32;
        scene.materials.push(made);
        self.indices.insert(material.index(), index);
        Ok(index)
    }
}

/// The factors of a material. A file that names none gets glTF's default, a white rough metal.
fn convert(material: &gltf_crate::Material, notes: &mut Notes) -> Result<Material, LoadError> {
    note_ignored(material, notes);
    let surface = material.pbr_metallic_roughness();
    let [r, g, b, _] = surface.base_color_factor();
    let specular = material.specular();
    // A texture would say where it emits; with the factor alone all of it would glow.
    let emission = match material.emissive_texture() {
        Some(_) => Vec3::ZERO,
        None => {
            Vec3::from(material.emissive_factor()) * material.emissive_strength().unwrap_or(1.0)
        }
    };
    let index = material.index().map_or("default".to_owned(), |index| format!("material-{index}"));
    let made = Material {
        name: material.name().map_or(index, str::to_owned),
        base_color: Vec3::new(r, g, b),
        base_color_texture: None,
        metallic: surface.metallic_factor(),
        roughness: surface.roughness_factor(),
        ior: material.ior().unwrap_or(1.5),
        specular: specular.as_ref().map_or(1.0, |specular| specular.specular_factor()),
        specular_color: specular.map_or(Vec3::ONE, |s| Vec3::from(s.specular_color_factor())),
        emission,
        two_sided: material.double_sided(),
        given: None,
    };
    let unit = 0.0..=1.0;
    let in_range = [
        ("baseColorFactor", made.base_color.min_element(), unit.clone()),
        ("baseColorFactor", made.base_color.max_element(), unit.clone()),
        ("metallicFactor", made.metallic, unit.clone()),
        ("roughnessFactor", made.roughness, unit.clone()),
        ("specularFactor", made.specular, unit),
        ("specularColorFactor", made.specular_color.min_element(), 0.0..=f32::MAX),
        ("specularColorFactor", made.specular_color.max_element(), 0.0..=f32::MAX),
        // 0 is the extension's own sign for total reflection.
        ("ior", if made.ior == 0.0 { 1.0 } else { made.ior }, 1.0..=f32::MAX),
        ("emissiveFactor", emission.min_element(), 0.0..=f32::MAX),
        ("emissiveFactor", emission.max_element(), 0.0..=f32::MAX),
    ];
    match in_range.iter().find(|(_, value, range)| !range.contains(value)) {
        Some((factor, value, _)) => Err(broken(factor, format!("{value} is out of range"))),
        None => Ok(made),
    }
}

fn note_ignored(material: &gltf_crate::Material, notes: &mut Notes) {
    let surface = material.pbr_metallic_roughness();
    let specular = material.specular();
    let specular = specular.as_ref();
    let ignored = [
        (
            "metallic-roughness textures replaced by their mean",
            surface.metallic_roughness_texture().is_some(),
        ),
        ("normal textures ignored", material.normal_texture().is_some()),
        ("occlusion textures ignored", material.occlusion_texture().is_some()),
        (
            "emissive textures ignored, their materials emit nothing",
            material.emissive_texture().is_some(),
        ),
        ("specular textures ignored", specular.is_some_and(|s| s.specular_texture().is_some())),
        (
            "specular textures ignored",
            specular.is_some_and(|s| s.specular_color_texture().is_some()),
        ),
        ("single-sided materials, drawn from both sides", !material.double_sided()),
        ("materials with an alpha mask, drawn opaque", material.alpha_mode() == AlphaMode::Mask),
        ("blended materials, drawn opaque", material.alpha_mode() == AlphaMode::Blend),
        ("default materials where the file names none", material.index().is_none()),
    ];
    for (what, present) in ignored {
        notes.count(what, present.into());
    }
}
