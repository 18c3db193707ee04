//! Pictures with what is known of their noise, kept on disk while they grow.

use std::path::Path;

use manylights_method::Progress;
use manylights_metrics::RadianceImage;
use manylights_paths::SLICE;
use manylights_scene::{Camera, Scene, content_digest};

use crate::cache::{CacheFile, Cached};
use crate::picture::Picture;
use crate::{Error, Settings};

/// A picture and what is known of its noise.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The mean over all samples.
    pub image: RadianceImage,
    /// The means over the even and over the odd slices: independent of each other.
    pub halves: [RadianceImage; 2],
    /// Estimated variance of `image`, for each pixel and channel.
    pub variance: RadianceImage,
    /// Samples a pixel in `image`: those asked for, rounded up ([`Settings::whole_samples`]).
    pub samples: u32,
    /// RMSE of `image` over pixels and channels that noise alone lets expect.
    pub noise_floor: f64,
    /// Rays traced by this call.
    pub rays: u64,
    /// What the user should know, such as a damaged cache file.
    pub notes: Vec<String>,
}

/// Renders a reference, or goes on with the one in the folder `cache`.
///
/// The cache is found by content (scene, camera, transport, resolution, seed) and by the number of
/// samples. Asking for more goes on from where an earlier call stopped; whatever the cache holds, the
/// same settings give the same picture. It is stored after every slice. `observe` is told the samples a
/// pixel after each.
///
/// # Errors
/// Settings without a picture, a radiance that is not finite, a cache that cannot be written.
pub fn render(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    cache: Option<&Path>,
    observe: &mut dyn FnMut(Progress),
) -> Result<Reference, Error> {
    let Settings { transport, resolution, seed, .. } = *settings;
    let mut picture = Picture::new(scene, camera, transport, resolution, seed, SLICE)?;
    let file = cache.map(|folder| CacheFile::new(folder, &content_digest(scene, camera), settings));
    let mut notes = Vec::new();
    if let Some(file) = &file {
        let smaller = if file.path().exists() { None } else { file.smaller() };
        let source = smaller.as_ref().unwrap_or(file);
        match source.load(picture.sums().len()) {
            Cached::Nothing => {}
            Cached::Sums(sums, slices) => picture.restore(sums, slices),
            Cached::Damaged(reason) => notes.push(format!(
                "cached reference {} is damaged ({reason}): rendered again",
                source.path().display()
            )),
        }
    }
    let slices = settings.slices();
    while picture.slices() < slices {
        picture.slice()?;
        if let Some(file) = &file {
            file.store(&picture)?;
        }
        let [done, total] = [picture.slices(), slices].map(|n| u64::from(n) * u64::from(SLICE));
        observe(Progress { done, total });
    }
    Ok(Reference {
        image: picture.image(),
        halves: [picture.half(0), picture.half(1)],
        variance: picture.variance(),
        samples: picture.slices() * SLICE,
        noise_floor: picture.noise_floor(),
        rays: picture.rays(),
        notes,
    })
}
