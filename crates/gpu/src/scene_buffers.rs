use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_scene::{Material, Scene};

use crate::{Buffer, Error, Gpu};

/// The scene in storage buffers.
pub(crate) struct SceneBuffers {
    pub(crate) vertices: Buffer,
    pub(crate) triangles: Buffer,
    pub(crate) materials: Buffer,
    pub(crate) textures: Buffer,
    pub(crate) texels: Buffer,
    pub(crate) triangle_count: u32,
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct MaterialRecord {
    base_color: Vec3,
    /// Index of the texture, −1 for none.
    texture: i32,
    /// Of the dielectric part, or of a reflectance given whole: f0 and [`manylights_scene::Lobe::slot`].
    dielectric_f0: Vec3,
    dielectric_f90: f32,
    metallic: f32,
    alpha: f32,
    padding: [u32; 2],
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct TextureRecord {
    first_texel: u32,
    width: u32,
    height: u32,
    padding: u32,
}

impl SceneBuffers {
    pub(crate) fn new(gpu: &Gpu, scene: &Scene) -> Result<Self, Error> {
        let materials: Vec<_> = scene.materials.iter().map(MaterialRecord::new).collect();
        let mut texels = Vec::new();
        let mut textures = Vec::new();
        for texture in &scene.textures {
            textures.push(TextureRecord {
                first_texel: texels.len() as u32,
                width: texture.width,
                height: texture.height,
                padding: 0,
            });
            texels.extend_from_slice(&texture.texels);
        }
        Ok(Self {
            vertices: gpu.storage("vertices", &scene.vertices)?,
            triangles: gpu.storage("triangles", &scene.triangles)?,
            materials: gpu.storage("materials", &materials)?,
            textures: gpu.storage("textures", &textures)?,
            texels: gpu.storage("texels", &texels)?,
            triangle_count: scene.triangles.len() as u32,
        })
    }
}

impl MaterialRecord {
    fn new(material: &Material) -> Self {
        let (dielectric_f0, dielectric_f90) = match &material.given {
            Some(brdf) => (brdf.f0, brdf.lobe.slot()),
            None => material.dielectric_fresnel(),
        };
        Self {
            base_color: material.base_color,
            texture: material.base_color_texture.map_or(-1, |index| index as i32),
            dielectric_f0,
            dielectric_f90,
            metallic: material.metallic,
            alpha: material.brdf(material.base_color).alpha,
            padding: [0; 2],
        }
    }
}
