//! Virtual lights inflated to spheres, for all methods that do so.

use manylights_gpu::{Error, GpuFrame, PassTime};
use manylights_scene::Scene;

use crate::radius::{RadiusRule, radii};
use crate::rsm::Map;
use crate::virtual_light::{VirtualLight, lit_maps};

/// A virtual light and the sphere that stands for it.
#[derive(Clone, Copy, Debug)]
pub struct VirtualSphere {
    /// Its centre, its flux, its reflectance.
    pub light: VirtualLight,
    /// Metres; 0 makes it a point.
    pub radius: f32,
}

/// The lights of [`distribute`](crate::distribute) with radii of a rule times `scale`, and the passes
/// that made them.
///
/// # Errors
/// Where the maps exceed what the adapter holds.
pub fn virtual_spheres(
    frame: &GpuFrame,
    scene: &Scene,
    maps: &[Map],
    (rule, scale): (RadiusRule, f32),
) -> Result<(Vec<VirtualSphere>, Vec<PassTime>), Error> {
    let (maps, mut times) = lit_maps(frame, scene, maps)?;
    let (radii, time) = radii(scene, &maps, rule);
    times.push(time);
    let lights = maps.into_iter().flat_map(|map| map.lights).flatten();
    let sphere = |(light, radius)| VirtualSphere { light, radius: scale * radius };
    Ok((lights.zip(radii).map(sphere).collect(), times))
}
