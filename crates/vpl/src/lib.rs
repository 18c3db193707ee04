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

use manylights_gpu::GpuFrame;
use manylights_method::{Error, Frame, Method, ParameterInfo, Parameters, Processor, Run, Transport};

use gather::{Gather, VplRun};
pub use gather::linked_shaders;
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

    fn prepare<'a>(
        &self,
        frame: &Frame<'a>,
        parameters: &Parameters,
    ) -> Result<Box<dyn Run + 'a>, Error> {
        let on_gpu = accepted(frame)?;
        let settings = Settings::new(parameters);
        let gather = Gather::new(on_gpu, frame.camera, frame.scene.has_specular(), &settings)?;
        Ok(Box::new(VplRun::new(frame.scene, on_gpu, settings, frame.seed, gather)))
    }
}

/// The frame on the adapter, where it is one that virtual point lights can render.
fn accepted<'a>(frame: &Frame<'a>) -> Result<&'a GpuFrame, Error> {
    let declined = |reason: &str| Err(Error::Declined(reason.to_owned()));
    if !matches!(frame.transport, Transport::Indirect { bounces: 1, .. }) {
        return declined("computes one indirect bounce: use --transport indirect-1");
    }
    if frame.scene.emissive_triangles().next().is_some() {
        return declined("needs point-like primary lights; this scene has emissive triangles");
    }
    if frame.scene.lights.is_empty() {
        return declined("needs a point, spot or directional light; this scene has none");
    }
    frame.gpu.ok_or_else(|| Error::Failed("vpl runs on the adapter and was given none".into()))
}
