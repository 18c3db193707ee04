//! Virtual spherical Gaussian lights (Tokuyoshi 2015, in the simplified form of thesis 5.2.8).

mod albedo;
mod gather;
mod gaussian_light;
mod light_record;
pub mod oracle;
mod params;

use glam::Vec3;
use manylights_gpu::{Gpu, LightGather, SurfaceRecord};
use manylights_method::{
    Error, Frame, ManyLightRun, Method, ParameterInfo, Parameters, Processor, Run, Visibility,
    many_light_frame,
};

use gather::LAMBERT_CAPACITY;

pub use gather::linked_shader;
pub use gaussian_light::{GaussianLight, Lobe, filter_group, filter_shader, gaussian_lights};
pub use params::{Settings, SpecularLobe};

/// Pairs of light and pixel in one submission: about a second on a slow processor, far below any
/// watchdog on a fast one.
const PAIRS_A_STEP: u64 = 1 << 26;

/// The method.
pub struct Vsgl;

impl Method for Vsgl {
    fn id(&self) -> &'static str {
        "vsgl"
    }

    fn title(&self) -> &'static str {
        "virtual spherical Gaussian lights (Tokuyoshi 2015)"
    }

    fn processor(&self) -> Processor {
        Processor::Gpu
    }

    fn parameters(&self) -> &'static [ParameterInfo] {
        params::PARAMETERS
    }

    fn cost_parameter(&self) -> &'static str {
        "lights"
    }

    fn visibility(&self) -> Visibility {
        Visibility::Ignored
    }

    /// Half of the lights is half of the flux.
    fn is_progressive(&self) -> bool {
        false
    }

    fn prepare<'a>(
        &self,
        frame: &Frame<'a>,
        parameters: &Parameters,
    ) -> Result<Box<dyn Run + 'a>, Error> {
        let (on_gpu, shadows) = many_light_frame(frame)?;
        let settings = Settings::new(parameters);
        let (gpu, Frame { scene, camera, seed, .. }) = (on_gpu.gpu(), *frame);
        let [width, height] = on_gpu.resolution();
        let pixels = width * height;
        let specular = scene.has_specular();
        let gather = gather::gather(gpu, pixels, camera.position, specular, &settings, shadows)?;
        let pairs_a_batch = u64::from(pixels) * LAMBERT_CAPACITY as u64;
        let batches_a_step = (PAIRS_A_STEP / pairs_a_batch) as usize;
        let place = move |gather: &LightGather| {
            let (lights, times) = gaussian_lights(on_gpu, scene, &settings, seed)?;
            Ok((gather::batches(gather, &lights)?, times))
        };
        Ok(Box::new(ManyLightRun::new(on_gpu, gather, batches_a_step, place)))
    }
}

/// Radiance of given surfaces under given lights, by the adapter's kernels: what a picture does, for
/// hard cases that no scene brings about.
///
/// # Errors
/// Where the adapter refuses.
pub fn gather(
    gpu: &Gpu,
    surfaces: &[SurfaceRecord],
    camera: Vec3,
    lights: &[GaussianLight],
    settings: &Settings,
) -> Result<Vec<[f32; 3]>, manylights_gpu::Error> {
    let specular = surfaces.iter().any(|surface| surface.brdf().has_specular())
        || lights.iter().any(GaussianLight::has_specular);
    let gather = gather::gather(gpu, surfaces.len() as u32, camera, specular, settings, None)?;
    let batches = gather::batches(&gather, lights)?;
    gather.add(&gpu.storage("surfaces", surfaces)?, &batches, 0..batches.count())?;
    gather.radiance()
}
