use manylights_gpu::{Error, GpuFrame, PassTime};
use manylights_scene::Scene;
use manylights_virtual_lights::{Map, VirtualSphere};

use crate::{Settings, rounded};

/// The lights that a picture with these maps uses, and the passes that made them.
///
/// # Errors
/// Where the maps exceed what the adapter holds.
pub fn virtual_spheres(
    frame: &GpuFrame,
    scene: &Scene,
    maps: &[Map],
    settings: &Settings,
) -> Result<(Vec<VirtualSphere>, Vec<PassTime>), Error> {
    let radius = (settings.radius, settings.scale);
    let (mut lights, times) =
        manylights_virtual_lights::virtual_spheres(frame, scene, maps, radius)?;
    for light in &mut lights {
        *light = rounded(light);
    }
    Ok((lights, times))
}
