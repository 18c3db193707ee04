//! Virtual lights inflated to spheres.

use manylights_gpu::{Error, GpuFrame, PassTime, VirtualLight, lit_maps, radii};
use manylights_scene::Scene;

use crate::Settings;

/// A virtual light and the sphere that stands for it.
#[derive(Clone, Copy, Debug)]
pub struct SphericalLight {
    /// Its centre, its flux, its reflectance.
    pub light: VirtualLight,
    /// Metres; 0 makes it a point.
    pub radius: f32,
}

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
    let (maps, mut times) = lit_maps(frame, scene, settings.lights, seed)?;
    let (radii, time) = radii(scene, &maps, settings.radius);
    times.push(time);
    let lights = maps.into_iter().flat_map(|map| map.lights).flatten();
    let sphere = |(light, radius)| SphericalLight { light, radius: settings.scale * radius };
    Ok((lights.zip(radii).map(sphere).collect(), times))
}
