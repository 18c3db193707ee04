//! A scene made ready: camera chosen, adapter filled.

use std::path::{Path, PathBuf};

use manylights_gpu::{Gpu, GpuFrame};
use manylights_method::{Frame, Method, Processor};
use manylights_metrics::RadianceImage;
use manylights_path_tracer as path_tracer;
use manylights_scene::{Camera, Scene, Transport, Visibility};

use crate::error::Failure;

/// Opens the adapter where one of `methods` needs it.
///
/// # Errors
/// One line where there is none, or none of that name.
pub(crate) fn open_gpu<'m>(
    methods: impl IntoIterator<Item = &'m dyn Method>,
    adapter: Option<&str>,
) -> Result<Option<Gpu>, Failure> {
    let needed = methods.into_iter().any(|method| method.processor() == Processor::Gpu);
    if needed { Gpu::new(adapter).map(Some).map_err(Failure::input) } else { Ok(None) }
}

/// Loads a scene and prints what import changed.
///
/// # Errors
/// One line: what, where, how to mend it.
pub(crate) fn load(what: &str, assets: Option<&Path>) -> Result<Scene, Failure> {
    let scene = manylights_scene::load(what, assets).map_err(Failure::input)?;
    for note in &scene.notes {
        eprintln!("{}: {note}", scene.name);
    }
    Ok(scene)
}

/// What all methods under comparison share.
pub(crate) struct Stage<'a> {
    /// Triangles, materials, lights.
    pub(crate) scene: &'a Scene,
    /// The chosen camera.
    pub(crate) camera: &'a Camera,
    /// Width, height in pixels.
    pub(crate) resolution: [u32; 2],
    /// Light paths of all pictures.
    pub(crate) transport: Transport,
    gpu: Option<GpuFrame>,
    /// The part of all pictures that no method estimates.
    direct: Option<RadianceImage>,
}

impl<'a> Stage<'a> {
    /// Fills the adapter, where there is one, and computes the direct light that `direct+indirect-1`
    /// adds to every picture alike.
    ///
    /// # Errors
    /// One line where the camera is unknown, the adapter cannot hold the scene or its direct light is
    /// not exact.
    pub(crate) fn new(
        scene: &'a Scene,
        camera: Option<&str>,
        transport: Transport,
        resolution: [u32; 2],
        gpu: Option<&Gpu>,
    ) -> Result<Self, Failure> {
        let camera = scene.camera(camera).map_err(Failure::input)?;
        let gpu = gpu.map(|gpu| GpuFrame::new(gpu, scene, camera, resolution)).transpose();
        let gpu = gpu.map_err(Failure::input)?;
        let direct = match transport {
            Transport::DirectAndIndirect { .. } => Some(
                path_tracer::direct_light(scene, camera, resolution)
                    .map_err(|error| Failure::input(format!("{}: {error}", scene.name)))?,
            ),
            Transport::Direct { .. } | Transport::Indirect { .. } | Transport::All => None,
        };
        Ok(Self { scene, camera, resolution, transport, gpu, direct })
    }

    /// One picture to estimate; [`Self::completed`] makes it whole.
    pub(crate) fn frame(&self, visibility: Visibility, seed: u64) -> Frame<'_> {
        Frame {
            scene: self.scene,
            camera: self.camera,
            resolution: self.resolution,
            transport: self.transport.with_visibility(visibility).estimated(),
            seed,
            gpu: self.gpu.as_ref(),
        }
    }

    /// An estimate together with what is added to all pictures alike, outside every clock.
    pub(crate) fn completed(&self, mut estimate: RadianceImage) -> RadianceImage {
        if let Some(direct) = &self.direct {
            let direct = direct.pixels.as_flattened();
            for (value, direct) in estimate.pixels.as_flattened_mut().iter_mut().zip(direct) {
                *value += direct;
            }
        }
        estimate
    }
}

/// The folder of references: `wanted`, else `manylights/references` in the user's cache folder.
///
/// # Errors
/// One line where it cannot be written.
pub(crate) fn reference_cache(wanted: Option<&Path>) -> Result<PathBuf, Failure> {
    let folder = match wanted {
        Some(folder) => folder.to_owned(),
        None => dirs::cache_dir()
            .ok_or_else(|| Failure::input("no cache folder: name one with --cache"))?
            .join("manylights")
            .join("references"),
    };
    crate::output::check_directory(&folder, "--cache")?;
    Ok(folder)
}
