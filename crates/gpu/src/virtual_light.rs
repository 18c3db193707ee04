//! The virtual lights that all many-light methods share: same positions, same flux, same reflectance.

use glam::Vec3;
use manylights_scene::{Brdf, Scene};

use crate::frame::SurfaceRecord;
use crate::raster::rasterise;
use crate::rsm::maps;
use crate::{Error, GpuFrame, PassTime};

/// A small lit patch of surface that stands for one cell of a reflective shadow map.
#[derive(Clone, Copy, Debug)]
pub struct VirtualLight {
    /// World space, metres.
    pub position: Vec3,
    /// Unit normal of the triangle, on the lit side: flux leaves the patch with its cosine.
    pub geometric_normal: Vec3,
    /// Unit shading normal on the same side: the frame of the reflectance.
    pub normal: Vec3,
    /// Unit direction from the patch to the primary light.
    pub incoming: Vec3,
    /// Incident flux, W, times n_s·ω / n_g·ω: with interpolated normals the patch of a cell reflects
    /// E_s ΔA = Φ cos_s / cos_g (Veach 1997, section 5.3), and only then do virtual lights converge
    /// to the same picture as paths traced from the camera. 1 on flat surfaces.
    pub flux: Vec3,
    /// Reflectance with textures applied.
    pub brdf: Brdf,
}

/// Places virtual lights on what the scene's primary lights see: at least `count` cells in all, split
/// evenly between the lights. Cells without flux or surface carry no light and are left out.
///
/// Returns the lights in a fixed order, and the time of the passes that placed them.
///
/// # Errors
/// Where the maps exceed what the adapter holds.
pub fn distribute(
    frame: &GpuFrame,
    scene: &Scene,
    count: u64,
    seed: u64,
) -> Result<(Vec<VirtualLight>, Vec<PassTime>), Error> {
    let share = count.div_ceil(scene.lights.len().max(1) as u64);
    let mut lights = Vec::new();
    let mut times = Vec::new();
    for map in scene.lights.iter().flat_map(|light| maps(scene, light, share, seed)) {
        let (surfaces, passes) = rasterise(frame.gpu(), &frame.scene, &map.projection)?;
        times.extend(passes);
        let surfaces: Vec<SurfaceRecord> = frame.gpu().read(&surfaces)?;
        let columns = map.projection.resolution[0];
        for (index, surface) in surfaces.iter().enumerate() {
            let index = index as u32;
            let cell = map.cell(index % columns, index / columns);
            lights.extend(virtual_light(scene, surface, cell.direction, cell.flux));
        }
    }
    Ok((lights, times))
}

fn virtual_light(
    scene: &Scene,
    surface: &SurfaceRecord,
    direction: Vec3,
    flux: Vec3,
) -> Option<VirtualLight> {
    if surface.triangle == SurfaceRecord::NO_TRIANGLE || flux == Vec3::ZERO {
        return None;
    }
    let incoming = -direction;
    let front = scene.geometric_normal(surface.triangle);
    let geometric_normal = if front.dot(incoming) >= 0.0 { front } else { -front };
    let shading_cosine = surface.normal.dot(incoming);
    let geometric_cosine = geometric_normal.dot(incoming);
    if shading_cosine <= 0.0 || geometric_cosine <= 0.0 {
        return None;
    }
    Some(VirtualLight {
        position: surface.position,
        geometric_normal,
        normal: surface.normal,
        incoming,
        flux: flux * (shading_cosine / geometric_cosine),
        brdf: surface.brdf(),
    })
}
