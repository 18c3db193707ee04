//! What a picture is made from, as a hash.

use glam::Vec3;
use sha2::{Digest, Sha256};

use crate::{AreaLight, Brdf, Camera, Light, Lobe, Material, Scene};

/// Hash of everything in a scene and camera that a picture depends on, as 64 hexadecimal digits:
/// triangles, materials, textures, lights of all kinds, camera; not names, notes or exposure.
pub fn content_hash(scene: &Scene, camera: &Camera) -> String {
    content_digest(scene, camera).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// [`content_hash`] as bytes.
pub fn content_digest(scene: &Scene, camera: &Camera) -> [u8; 32] {
    // Every field by name, so that a new one cannot be forgotten here.
    let Scene {
        name: _,
        vertices,
        triangles,
        materials,
        textures,
        lights,
        area_lights,
        cameras: _, // the one that looks is hashed
        exposure: _,
        notes: _,
        sources: _,
    } = scene;
    let mut hasher = Sha256::new();
    let mut part = |bytes: &[u8]| {
        hasher.update((bytes.len() as u64).to_le_bytes());
        hasher.update(bytes);
    };
    part(bytemuck::cast_slice(vertices));
    part(bytemuck::cast_slice(triangles));
    for material in materials {
        part(material_text(material).as_bytes());
        if let Some(Brdf { lobe: Lobe::Measured(measured), .. }) = material.given {
            part(bytemuck::cast_slice(&measured.words()));
        }
    }
    for texture in textures {
        part(&texture.width.to_le_bytes());
        part(&texture.height.to_le_bytes());
        part(bytemuck::cast_slice(&texture.texels));
    }
    for light in lights {
        part(light_text(light).as_bytes());
    }
    for light in area_lights {
        part(area_light_text(light).as_bytes());
    }
    part(camera_text(camera).as_bytes());
    hasher.finalize().into()
}

// `{:?}` prints the shortest digits that read back as the same number: texts differ where numbers do.
// The patterns name every field, so that a new one cannot be forgotten here.

fn material_text(material: &Material) -> String {
    let Material {
        name: _,
        base_color,
        base_color_texture,
        metallic,
        roughness,
        ior,
        specular,
        specular_color,
        emission,
        two_sided,
        given,
    } = material;
    let mut text = format!(
        "material {base_color:?} {base_color_texture:?} {metallic:?} {roughness:?} {ior:?} \
         {specular:?} {specular_color:?} {emission:?}"
    );
    if let Some(brdf) = given {
        text += &format!(" {brdf:?}");
    }
    // Of what is dark both sides are alike.
    if *two_sided && *emission != Vec3::ZERO {
        text += " two-sided";
    }
    text
}

fn light_text(light: &Light) -> String {
    format!("{light:?}")
}

/// Of what has one side the text that it had before there were two.
fn area_light_text(light: &AreaLight) -> String {
    match light {
        AreaLight::Sphere { center, radius, radiance } => {
            format!("Sphere {{ center: {center:?}, radius: {radius:?}, radiance: {radiance:?} }}")
        }
        AreaLight::Triangle { corners, radiance, two_sided } => {
            let sides = if *two_sided { " two-sided" } else { "" };
            format!("Triangle {{ corners: {corners:?}, radiance: {radiance:?} }}{sides}")
        }
    }
}

fn camera_text(camera: &Camera) -> String {
    let Camera { name: _, position, right, up, forward, vertical_fov } = camera;
    format!("camera {position:?} {right:?} {up:?} {forward:?} {vertical_fov:?}")
}
