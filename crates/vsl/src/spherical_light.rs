use manylights_gpu::{Error, GpuFrame, PassTime, SphericalLight};
use manylights_scene::Scene;

use crate::Settings;

/// The lights that a picture uses, and the passes that made them.
///
/// # Errors
/// Where the maps exceed what the adapter holds.
pub fn spherical_lights(
    frame: &GpuFrame,
    scene: &Scene,
    settings: &Settings,
    seed: u64,
) -> Result<(Vec<SphericalLight>, Vec<PassTime>), Error> {
    let radius = (settings.radius, settings.scale);
    manylights_gpu::spherical_lights(frame, scene, settings.lights, radius, seed)
}
