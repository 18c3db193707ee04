//! Virtual point lights (Keller 1997), placed by reflective shadow maps (Dachsbacher and Stamminger
//! 2005; thesis 5.1.2).
//!
//! One indirect bounce:
//!
//! L(x, v) = Σ_j V(x, y_j) Φ_j f_x(v, ω_j) ⟨n_x·ω_j⟩ f_j(ω_p, −ω_j) ⟨n_j·−ω_j⟩ / d_j²
//!
//! with Φ_j = I(ω) Δω the flux of the light's cell, and V the visibility between virtual light and
//! shaded point, or 1 with `visibility = ignored`. It converges to the reference of the same visibility.
//!
//! Deviations from the papers: each light carries its cell's exact solid angle, not power/count; the
//! emitting cosine is that of the geometric normal (see [`manylights_virtual_lights::VirtualLight::flux`]).
//!
//! Options, both off by default: `clamp` bounds the geometry term ⟨n_x·ω⟩⟨n_j·−ω⟩/d²; `attenuation_radius` replaces
//! 1/d² by Yuksel's attenuation (thesis 5.18).
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod gather;
mod light_record;
pub mod oracle;
mod params;

use glam::Vec3;
use manylights_gpu::{Gpu, Reflectances, SurfaceRecord};
use manylights_method::{Error, ParameterInfo, Parameters};
use manylights_virtual_lights::{Estimator, ManyLightFrame, ManyLightRun};
use manylights_virtual_lights::{LightGather, VirtualLight, distribute};

use gather::LAMBERT_CAPACITY;

pub use gather::linked_shader;
pub use params::Settings;

/// Pairs of light and pixel in one submission, about a second on a slow processor, where a batch has
/// fewer; a batch is never cut.
const PAIRS_A_STEP: u64 = 1 << 28;

/// The method is `VirtualLights(Vpl)`.
#[derive(Clone, Copy, Debug)]
pub struct Vpl;

impl Estimator for Vpl {
    const ID: &'static str = "vpl";
    const TITLE: &'static str = "virtual point lights (Keller 1997; RSM placement)";
    const VERSION: u32 = 1;
    const PARAMETERS: &'static [ParameterInfo] = params::PARAMETERS;
    type Tables = ();

    fn start<'a>(
        frame: ManyLightFrame<'a>,
        parameters: &Parameters,
        _: &(),
    ) -> Result<ManyLightRun<'a>, Error> {
        let settings = Settings::new(parameters);
        let ManyLightFrame { scene, eye, on_gpu, pixels, .. } = frame;
        let gpu = on_gpu.gpu();
        let kinds = Reflectances::of_scene(scene);
        let (maps, shadows) = (frame.maps(settings.lights)?, frame.shadows()?);
        let gather =
            gather::gather(gpu, (on_gpu.surfaces(), pixels), eye, &kinds, &settings, shadows)?;
        let batches_a_step = PAIRS_A_STEP / (u64::from(pixels) * LAMBERT_CAPACITY as u64);
        let place = move |gather: &LightGather| {
            let (lights, times) = distribute(on_gpu, scene, &maps)?;
            Ok((gather::batches(gather, &lights)?, times))
        };
        Ok(ManyLightRun::new(on_gpu, gather, batches_a_step, place))
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
    lights: &[VirtualLight],
    settings: &Settings,
) -> Result<Vec<[f32; 3]>, manylights_gpu::Error> {
    let receivers = surfaces.iter().map(SurfaceRecord::brdf);
    let kinds = Reflectances::of(receivers.chain(lights.iter().map(|light| light.brdf)));
    let on_gpu = gpu.storage("surfaces", surfaces)?;
    let gather =
        gather::gather(gpu, (&on_gpu, surfaces.len() as u32), camera, &kinds, settings, None)?;
    let batches = gather::batches(&gather, lights)?;
    gather.add(&batches, 0..batches.count())?;
    gather.radiance()
}
