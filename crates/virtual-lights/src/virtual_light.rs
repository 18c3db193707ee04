//! The virtual lights that all many-light methods share: same positions, same flux, same reflectance.

use glam::Vec3;
use manylights_gpu::{Center, Error, GpuFrame, PassTime, SurfaceRecord};
use manylights_scene::{Brdf, Scene};

use crate::rsm::Map;

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

impl VirtualLight {
    /// Unit tangent towards the primary light; any where the light is on the normal.
    pub fn tangent(&self) -> Vec3 {
        let across = self.incoming - self.normal.dot(self.incoming) * self.normal;
        // Shorter ones are rounding. The second projection takes out what rounding left of the normal
        // in short ones.
        if across.length_squared() <= 1e-12 {
            return self.normal.any_orthonormal_vector();
        }
        (across - self.normal.dot(across) * self.normal).normalize()
    }
}

impl From<&VirtualLight> for Center {
    fn from(light: &VirtualLight) -> Self {
        Self::new(light.position, light.geometric_normal)
    }
}

/// The virtual lights of one reflective shadow map, with their places on it.
#[derive(Clone, Debug)]
pub struct LitMap {
    /// Its rays and its primary light.
    pub map: Map,
    /// A light for each cell, row-major; none where the cell has no flux or no surface.
    pub lights: Vec<Option<VirtualLight>>,
}

/// Places virtual lights on what the maps of the scene's primary lights see. Cells without flux or
/// surface carry no light and are left out.
///
/// Returns the lights in a fixed order, and the time of the passes that placed them.
///
/// # Errors
/// Where the maps exceed what the adapter holds.
pub fn distribute(
    frame: &GpuFrame,
    scene: &Scene,
    maps: &[Map],
) -> Result<(Vec<VirtualLight>, Vec<PassTime>), Error> {
    let (maps, times) = lit_maps(frame, scene, maps)?;
    Ok((maps.into_iter().flat_map(|map| map.lights).flatten().collect(), times))
}

/// The lights of [`distribute`], in its order, on their maps: for methods that ask a light for its
/// neighbours.
///
/// # Errors
/// Where the maps exceed what the adapter holds.
pub fn lit_maps(
    frame: &GpuFrame,
    scene: &Scene,
    maps: &[Map],
) -> Result<(Vec<LitMap>, Vec<PassTime>), Error> {
    let mut lit = Vec::new();
    let mut times = Vec::new();
    for &map in maps {
        let (surfaces, passes) = frame.rasterise(&map.projection)?;
        // To a method they are one pass.
        times.extend(passes.into_iter().map(|time| PassTime { pass: "distribute", ..time }));
        let surfaces: Vec<SurfaceRecord> = frame.gpu().read(&surfaces)?;
        let columns = map.projection.resolution[0];
        let cells = surfaces.iter().zip(0_u32..).map(|(surface, index)| {
            let cell = map.cell(index % columns, index / columns);
            virtual_light(scene, surface, cell.direction, cell.flux)
        });
        lit.push(LitMap { map, lights: cells.collect() });
    }
    Ok((lit, times))
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
