//! A scene made ready: camera chosen, adapter filled.

use std::path::{Path, PathBuf};

use manylights_gpu::{Gpu, GpuFrame};
use manylights_method::{Frame, Method, Processor};
use manylights_scene::Transport;
use manylights_scene::{Camera, Scene};

use crate::error::Failure;
use crate::output::say;

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
        say(format_args!("{}: {note}", scene.name));
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
    gpu: Option<GpuFrame>,
}

impl<'a> Stage<'a> {
    /// Fills the adapter, where there is one.
    ///
    /// # Errors
    /// One line where the camera is unknown or the adapter cannot hold the scene.
    pub(crate) fn new(
        scene: &'a Scene,
        camera: Option<&str>,
        resolution: [u32; 2],
        gpu: Option<&Gpu>,
    ) -> Result<Self, Failure> {
        let camera = scene.camera(camera).map_err(Failure::input)?;
        let gpu = gpu.map(|gpu| GpuFrame::new(gpu, scene, camera, resolution)).transpose();
        Ok(Self { scene, camera, resolution, gpu: gpu.map_err(Failure::input)? })
    }

    /// One picture to make.
    pub(crate) fn frame(&self, transport: Transport, seed: u64) -> Frame<'_> {
        Frame {
            scene: self.scene,
            camera: self.camera,
            resolution: self.resolution,
            transport,
            seed,
            gpu: self.gpu.as_ref(),
        }
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
