//! The pictures that estimators make.

use glam::Vec3;
use manylights_gpu::GpuFrame;
use manylights_method::{Error, Frame};
use manylights_scene::{AreaLight, Scene, Transport, Visibility};

/// A frame that lights with a surface alone light, without shadows.
pub(crate) struct AreaLightFrame<'a> {
    /// As [`Frame::scene`].
    pub(crate) scene: &'a Scene,
    /// Of the camera.
    pub(crate) eye: Vec3,
    /// As [`Frame::gpu`].
    pub(crate) on_gpu: &'a GpuFrame,
    /// Number of pixels.
    pub(crate) pixels: u32,
    /// All of the scene, one or more.
    pub(crate) lights: Vec<AreaLight>,
}

impl<'a> AreaLightFrame<'a> {
    pub(crate) fn new(frame: &Frame<'a>) -> Result<Self, Error> {
        let declined = |reason: &str| Err(Error::Declined(reason.to_owned()));
        let Frame { scene, camera, transport, gpu, .. } = *frame;
        let Transport::Direct { visibility } = transport else {
            return declined("computes direct light: use --transport direct");
        };
        if visibility == Visibility::Traced {
            return declined("casts no shadow rays: use --visibility ignored");
        }
        let lights: Vec<_> = scene.all_area_lights().collect();
        if lights.is_empty() {
            return declined("needs lights with a surface; this scene has none");
        }
        if !scene.lights.is_empty() {
            return declined("knows lights with a surface alone; this scene has others");
        }
        let Some(on_gpu) = gpu else {
            return Err(Error::Failed("runs on the adapter and was given none".into()));
        };
        let pixels = on_gpu.resolution().into_iter().product();
        Ok(Self { scene, eye: camera.position, on_gpu, pixels, lights })
    }
}
