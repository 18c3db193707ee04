//! Virtual point lights (Keller 1997), placed by reflective shadow maps (Dachsbacher and Stamminger
//! 2005; thesis 5.1.2).
//!
//! One indirect bounce, without visibility between virtual light and shaded point:
//!
//! L(x, v) = Σ_j Φ_j f_x(v, ω_j) ⟨n_x·ω_j⟩ f_j(ω_p, −ω_j) ⟨n_j·−ω_j⟩ / d_j²
//!
//! with Φ_j = I(ω) Δω the flux of the light's cell. It converges to the reference with
//! `visibility = ignored`; the distance to the `traced` one is the price of the missing shadows.
//!
//! Deviations from the papers: each light carries its cell's exact solid angle, not power/count; the
//! emitting cosine is that of the geometric normal (see [`manylights_gpu::VirtualLight::flux`]).
//!
//! Options, both off by default: `clamp` bounds the geometry term ⟨n_x·ω⟩⟨n_j·−ω⟩/d²; `radius` replaces
//! 1/d² by Yuksel's attenuation (thesis 5.18).

mod gather;
mod light_record;
pub mod oracle;
mod params;
mod run;

use glam::Vec3;
use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord, VirtualLight};
use manylights_method::{
    Error, Frame, Method, ParameterInfo, Parameters, Processor, Run, Transport, Visibility,
};

use gather::{Batches, Gather};
use run::VplRun;

pub use gather::linked_shader;
pub use params::Settings;

/// The method.
pub struct Vpl;

impl Method for Vpl {
    fn id(&self) -> &'static str {
        "vpl"
    }

    fn title(&self) -> &'static str {
        "virtual point lights (Keller 1997; RSM placement)"
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

    /// Half of the lights is half of the flux.
    fn is_progressive(&self) -> bool {
        false
    }

    fn prepare<'a>(
        &self,
        frame: &Frame<'a>,
        parameters: &Parameters,
    ) -> Result<Box<dyn Run + 'a>, Error> {
        let on_gpu = accepted(frame)?;
        let settings = Settings::new(parameters);
        let [width, height] = on_gpu.resolution();
        let specular = frame.scene.has_specular();
        let camera = frame.camera.position;
        let gather = Gather::new(on_gpu.gpu(), width * height, camera, specular, &settings)?;
        Ok(Box::new(VplRun {
            scene: frame.scene,
            frame: on_gpu,
            settings,
            seed: frame.seed,
            gather,
            placed: None,
            times: Vec::new(),
        }))
    }
}

/// The frame on the adapter, where it is one that virtual point lights can render.
fn accepted<'a>(frame: &Frame<'a>) -> Result<&'a GpuFrame, Error> {
    let declined = |reason: &str| Err(Error::Declined(reason.to_owned()));
    let Transport::Indirect { bounces: 1, visibility } = frame.transport else {
        return declined("computes one indirect bounce: use --transport indirect-1");
    };
    if visibility == Visibility::Traced {
        return declined("has no shadow test for its last segment: use --visibility ignored");
    }
    if frame.scene.emissive_triangles().next().is_some() {
        return declined("needs point-like primary lights; this scene has emissive triangles");
    }
    if frame.scene.lights.is_empty() {
        return declined("needs a point, spot or directional light; this scene has none");
    }
    frame.gpu.ok_or_else(|| Error::Failed("vpl runs on the adapter and was given none".into()))
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
    lights: &[VirtualLight],
    settings: &Settings,
) -> Result<Vec<[f32; 3]>, manylights_gpu::Error> {
    let specular = surfaces.iter().any(|surface| surface.brdf().has_specular())
        || lights.iter().any(|light| light.brdf.has_specular());
    let gather = Gather::new(gpu, surfaces.len() as u32, camera, specular, settings)?;
    let batches = Batches::new(gpu, lights)?;
    gather.add(&gpu.storage("surfaces", surfaces)?, &batches, 0..batches.len())?;
    gather.radiance()
}
