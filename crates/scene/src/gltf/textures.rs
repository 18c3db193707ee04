//! Images: PNG and JPEG, decoded when the first material uses them.

use std::collections::HashMap;

use ::gltf as gltf_crate;
use glam::{DVec3, U8Vec3, Vec3};
use gltf_crate::texture::{MagFilter, MinFilter, Sampler, WrappingMode};

use super::buffers;
use super::fault::broken;
use super::notes::Notes;
use super::source::Source;
use crate::{LoadError, Scene, Texture, image_file};

/// Images of the file that are in the scene already.
#[derive(Default)]
pub(super) struct Textures {
    indices: HashMap<usize, u32>,
}

impl Textures {
    /// The index of a texture's image in the scene; `None` where the file has it only in the format
    /// of an extension.
    ///
    /// # Errors
    /// Images that are missing, malformed or too large.
    pub(super) fn index(
        &mut self,
        texture: &gltf_crate::Texture,
        source: Source,
        scene: &mut Scene,
        notes: &mut Notes,
    ) -> Result<Option<u32>, LoadError> {
        let Some(image) = image_of(texture, source, notes) else { return Ok(None) };
        let sampler = texture.sampler();
        let repeats = [sampler.wrap_s(), sampler.wrap_t()] == [WrappingMode::Repeat; 2];
        notes.count("textures repeated against their sampler", u64::from(!repeats));
        notes.count(
            "textures filtered bilinearly against their sampler",
            is_nearest(&sampler).into(),
        );
        if let Some(&index) = self.indices.get(&image) {
            return Ok(Some(index));
        }
        let index = scene.textures.len() as u32;
        scene.textures.push(decode(image, source)?);
        self.indices.insert(image, index);
        Ok(Some(index))
    }
}

/// Whether a texel is to be seen as a square, near or far. That there are no mip levels is what the
/// specification allows.
fn is_nearest(sampler: &Sampler) -> bool {
    use MinFilter::{Nearest, NearestMipmapLinear, NearestMipmapNearest};
    sampler.mag_filter() == Some(MagFilter::Nearest)
        || matches!(
            sampler.min_filter(),
            Some(Nearest | NearestMipmapNearest | NearestMipmapLinear)
        )
}

/// The mean of a texture's channels, in [0, 1], without a transfer function; white where the file has
/// it only in the format of an extension.
///
/// # Errors
/// Images that are missing, malformed or too large.
pub(super) fn mean(
    texture: &gltf_crate::Texture,
    source: Source,
    notes: &mut Notes,
) -> Result<Vec3, LoadError> {
    let Some(image) = image_of(texture, source, notes) else { return Ok(Vec3::ONE) };
    let texels = decode(image, source)?.texels;
    let sum: DVec3 = texels.iter().map(|&[r, g, b, _]| U8Vec3::new(r, g, b).as_dvec3()).sum();
    Ok((sum / (255.0 * texels.len() as f64)).as_vec3())
}

/// The index of a texture's image.
fn image_of(texture: &gltf_crate::Texture, source: Source, notes: &mut Notes) -> Option<usize> {
    let root = source.document.as_json();
    let image = root.textures[texture.index()].source.value();
    if image < root.images.len() {
        return Some(image);
    }
    notes.count("textures without a PNG or JPEG image, left out", 1);
    None
}

fn decode(image: usize, source: Source) -> Result<Texture, LoadError> {
    read(image, source)
        .and_then(|bytes| image_file::decode(&bytes))
        .map_err(|error| error.within(format!("images[{image}]")))
}

fn read(image: usize, source: Source) -> Result<Vec<u8>, LoadError> {
    let root = source.document.as_json();
    let image = &root.images[image];
    match (image.buffer_view, &image.uri) {
        (Some(view), _) => {
            // Its range has been checked against the buffer.
            let view = &root.buffer_views[view.value()];
            let start = view.byte_offset.map_or(0, |offset| offset.0) as usize;
            let bytes = &source.buffers.get(view.buffer.value())[start..];
            Ok(bytes[..view.byte_length.0 as usize].to_vec())
        }
        (None, Some(uri)) => buffers::resolve(uri, source.folder, image_file::MAX_BYTES),
        (None, None) => Err(broken("uri", "is missing, and there is no buffer view")),
    }
}
