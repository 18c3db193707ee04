//! What all methods of a picture share on the adapter.

use std::sync::{Arc, OnceLock};

use manylights_scene::{Camera, Scene};

use crate::occluders::Occluders;
use crate::raster::rasterise;
use crate::scene_buffers::SceneBuffers;
use crate::{Buffer, Error, Gpu, PassTime, Projection};

/// A scene on the adapter, with the G-buffer of one camera.
pub struct GpuFrame {
    gpu: Gpu,
    scene: SceneBuffers,
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

    /// The surfaces that a projection sees: `array<Surface>`, row-major; and the passes that found them.
    ///
    /// # Errors
    /// Where the map is larger than the adapter allows.
    pub fn rasterise(&self, projection: &Projection) -> Result<(Buffer, Vec<PassTime>), Error> {
        rasterise(&self.gpu, &self.scene, projection)
    }

    /// The vertices: `array<Vertex>`.
    pub fn vertices(&self) -> &Buffer {
        &self.scene.vertices
    }

    /// The triangles: `array<Triangle>`.
    pub fn triangles(&self) -> &Buffer {
        &self.scene.triangles
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
