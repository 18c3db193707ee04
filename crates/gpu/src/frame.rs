use std::sync::{Arc, OnceLock};

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_scene::{Brdf, Camera, Lobe, Scene};

use crate::raster::rasterise;
use crate::scene_buffers::SceneBuffers;
use crate::shadows::Occluders;
use crate::{Buffer, Error, Gpu, PassTime, Projection};

/// A texel of the G-buffer or of a reflective shadow map, as `shaders/surface.wesl` lays it out.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct SurfaceRecord {
    /// World space, metres.
    pub position: Vec3,
    /// GGX width.
    pub alpha: f32,
    /// Unit shading normal, on the viewer's side.
    pub normal: Vec3,
    /// What the specular lobe is, see [`Lobe::slot`].
    pub f90: f32,
    /// Albedo of the Lambertian lobe.
    pub diffuse: Vec3,
    /// Index of the triangle; [`SurfaceRecord::NO_TRIANGLE`] where the ray left the scene.
    pub triangle: u32,
    /// Specular reflectance at normal incidence.
    pub f0: Vec3,
    /// Index of the material.
    pub material: u32,
}

impl SurfaceRecord {
    /// Marks a texel without a surface.
    pub const NO_TRIANGLE: u32 = u32::MAX;

    /// A point of triangle 0 and material 0, for gathers of points that no scene holds.
    pub fn new(position: Vec3, normal: Vec3, brdf: Brdf) -> Self {
        let Brdf { diffuse, f0, lobe, alpha } = brdf;
        let f90 = lobe.slot();
        Self { position, alpha, normal, f90, diffuse, triangle: 0, f0, material: 0 }
    }

    /// Its reflectance.
    pub fn brdf(&self) -> Brdf {
        let Self { diffuse, f0, f90, alpha, .. } = *self;
        Brdf { diffuse, f0, lobe: Lobe::from_slot(f90), alpha }
    }
}

/// A scene on the adapter, with the G-buffer of one camera.
pub struct GpuFrame {
    gpu: Gpu,
    pub(crate) scene: SceneBuffers,
    surfaces: Buffer,
    resolution: [u32; 2],
    times: Vec<PassTime>,
    /// Made for the first method that casts shadow rays.
    occluders: OnceLock<Result<Arc<Occluders>, Error>>,
}

impl GpuFrame {
    /// Uploads the scene and rasterises the camera's pixels.
    ///
    /// # Errors
    /// Where scene or resolution exceed what the adapter holds.
    pub fn new(
        gpu: &Gpu,
        scene: &Scene,
        camera: &Camera,
        resolution: [u32; 2],
    ) -> Result<Self, Error> {
        let buffers = SceneBuffers::new(gpu, scene)?;
        let projection = Projection::camera(camera, resolution, scene.size());
        let (surfaces, times) = rasterise(gpu, &buffers, &projection)?;
        let occluders = OnceLock::new();
        Ok(Self { gpu: gpu.clone(), scene: buffers, surfaces, resolution, times, occluders })
    }

    /// The adapter that holds it.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The G-buffer: `array<Surface>`, row-major.
    pub fn surfaces(&self) -> &Buffer {
        &self.surfaces
    }

    /// Width, height in pixels.
    pub fn resolution(&self) -> [u32; 2] {
        self.resolution
    }

    pub(crate) fn occluders(&self, scene: &Scene) -> Result<Arc<Occluders>, Error> {
        let make = || Occluders::new(&self.gpu, scene).map(Arc::new);
        self.occluders.get_or_init(make).clone()
    }

    /// What the G-buffer took.
    pub fn pass_times(&self) -> &[PassTime] {
        &self.times
    }
}
