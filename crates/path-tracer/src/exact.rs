//! What needs no sampling.

use manylights_metrics::RadianceImage;
use manylights_paths::{SLICE, Tracer};
use manylights_scene::bvh::Ray;
use manylights_scene::{Camera, Scene, Transport, Visibility};
use rayon::prelude::*;

use crate::Error;
use crate::picture::Picture;

/// The emission that the pixel centres see, W·m⁻²·sr⁻¹: exact, and part of
/// [`Transport::All`] alone.
pub fn seen_emission(scene: &Scene, camera: &Camera, [width, height]: [u32; 2]) -> RadianceImage {
    let tracer = Tracer::new(scene, Transport::All);
    let pixels = (0..width * height).into_par_iter().map(|index| {
        let direction = camera.direction(index % width, index / width, [width, height]);
        let hit = tracer.closest(&Ray::new(camera.position, direction));
        hit.map_or([0.0; 3], |hit| tracer.primary(hit, direction).emission.to_array())
    });
    RadianceImage { width, height, pixels: pixels.collect() }
}

/// The direct light of point-like lights, shadows included, W·m⁻²·sr⁻¹: exact, and what
/// [`Transport::DirectAndIndirect`] holds beside one indirect bounce.
///
/// # Errors
/// A resolution without a picture, or a scene with emissive triangles, whose direct light is sampled.
pub fn direct_light(
    scene: &Scene,
    camera: &Camera,
    resolution: [u32; 2],
) -> Result<RadianceImage, Error> {
    let transport = Transport::DirectAndIndirect { visibility: Visibility::Traced };
    // Before its first slice a picture holds its exact part alone, whatever the seed.
    Ok(Picture::new(scene, camera, transport, resolution, 0, SLICE)?.image())
}
