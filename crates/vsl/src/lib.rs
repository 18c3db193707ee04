//! Virtual spherical lights (Hašan, Křivánek, Walter, Bala 2009; thesis 5.1.4 and 5.2.6).
//!
//! A virtual point light is inflated to a sphere of radius r that covers its neighbourhood. With d the
//! distance to its centre, Ω the cone of half-angle a = asin(r/d) about it (a hemisphere inside the
//! sphere), one indirect bounce is
//!
//! L(x, v) = Σ_j V(x, y_j) Φ_j/(π r_j²) ∫_Ω f_x(v, ω) ⟨n_x·ω⟩ f_j(ω_p, −ω) ⟨n_j·−ω⟩ dω
//!
//! with V the visibility of the sphere's centre, or 1 with `visibility = ignored`. Nothing else depends
//! on the place inside the sphere, only on the direction. With |Ω|/(πr²) = 2/(d² + d√(d² − r²)), which goes over into 2/r² inside the
//! sphere and into the 1/d² of point lights for r → 0, samples of density p are summed as
//!
//! L = Φ |Ω|/(πr²) · 1/n Σ_i g(ω_i)/(p(ω_i) |Ω|),   g the integrand,
//!
//! p|Ω| = 1 for uniform samples of the cone, p_x|Ω| for samples of the shaded point's lobes (the
//! thesis' choice, with 9 and 25 samples; those outside Ω count nothing), and 1 + p_x|Ω| for n samples
//! of each (the balance heuristic). Narrow cones are met by few samples of the lobes: they alone are
//! noisy where lights are many.
//!
//! Radii: see [`RadiusRule`](manylights_virtual_lights::RadiusRule); all are scaled by the user's factor.
//!
//! Deviations from the papers:
//! - The authors' shader also samples the light's own lobe, and takes more samples for wider cones;
//!   here the count is the same for all.
//! - Their shader drops a light whose centre is below a horizon; here that is a matter of V, and with
//!   `visibility = ignored` the clamped cosines of each direction decide, so nothing jumps where a
//!   sphere crosses a horizon. It also lessens πr² in
//!   corners, which the thesis does not.
//! - As in `manylights-vpl`: exact solid angles of cells, the emitting cosine of the geometric normal.
//! - Lights of radius 0 are points under every sampling.
//!
//! What does not depend on the pixel (intensity, the light's frame and its half of the Smith term, its
//! key) is in the light's record; what does not depend on the light is kept by the lane. What a pair of
//! light and pixel takes: `tests/examples/virtual_light_throughput`.
//!
//! Bias: spheres darken concave surfaces, since a part of a wide cone is below one of the horizons; on
//! the integrating sphere by 4/(3π) r/R (`tests/tests/integrating_sphere.rs`). Of the energy of 78 400
//! virtual point lights, 400 spheres send 0.90 in `trio`, 0.93 in `cornell-glossy` and 0.94 in `cornell`,
//! of that of traced references 0.85 to 0.89; `manylights-hvl` has the table. No window is in this method:
//! it expands nothing.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod gather;
mod light_record;
mod noise;
pub mod oracle;
mod params;
mod virtual_sphere;

use glam::Vec3;
use manylights_gpu::{Gpu, Reflectances, SurfaceRecord};
use manylights_method::{Error, ParameterInfo, Parameters};
use manylights_virtual_lights::LightGather;
use manylights_virtual_lights::{Estimator, ManyLightFrame, ManyLightRun};

use gather::CAPACITY;

pub use gather::linked_shader;
pub use manylights_virtual_lights::VirtualSphere;
pub use params::{Sampling, Settings};
pub use virtual_sphere::virtual_spheres;

/// Directions in one submission, about a second on a slow processor, where a batch has fewer; a batch
/// is never cut.
const DIRECTIONS_A_STEP: u64 = 1 << 26;

/// The method is `VirtualLights(Vsl)`.
#[derive(Clone, Copy, Debug)]
pub struct Vsl;

impl Estimator for Vsl {
    const ID: &'static str = "vsl";
    const TITLE: &'static str = "virtual spherical lights (Hašan et al. 2009)";
    const VERSION: u32 = 1;
    const PARAMETERS: &'static [ParameterInfo] = params::PARAMETERS;
    type Tables = ();

    fn start<'a>(
        frame: ManyLightFrame<'a>,
        parameters: &Parameters,
        _: &(),
    ) -> Result<ManyLightRun<'a>, Error> {
        let settings = Settings::new(parameters);
        let ManyLightFrame { scene, eye, seed, on_gpu, pixels, .. } = frame;
        let gpu = on_gpu.gpu();
        let kinds = Reflectances::of_scene(scene);
        let (maps, shadows) = (frame.maps(settings.lights)?, frame.shadows()?);
        let gather =
            gather::gather(gpu, (on_gpu.surfaces(), pixels), eye, &kinds, &settings, shadows)?;
        let directions_a_batch = u64::from(pixels) * CAPACITY as u64 * settings.directions_a_pair();
        let batches_a_step = DIRECTIONS_A_STEP / directions_a_batch;
        let place = move |gather: &LightGather| {
            let (lights, times) = virtual_spheres(on_gpu, scene, &maps, &settings)?;
            Ok((gather::batches(gather, &lights, seed)?, times))
        };
        Ok(ManyLightRun::new(on_gpu, gather, batches_a_step, place))
    }
}

/// Radiance of given surfaces under given lights, by the adapter's kernels: what a picture does, for
/// hard cases that no scene brings about. A surface's index is its pixel, a light's its place in the
/// picture's list: both choose the samples, with the seed.
///
/// # Errors
/// Where the adapter refuses.
pub fn gather(
    gpu: &Gpu,
    surfaces: &[SurfaceRecord],
    camera: Vec3,
    lights: &[VirtualSphere],
    settings: &Settings,
    seed: u64,
) -> Result<Vec<[f32; 3]>, manylights_gpu::Error> {
    let receivers = surfaces.iter().map(SurfaceRecord::brdf);
    let kinds = Reflectances::of(receivers.chain(lights.iter().map(|sphere| sphere.light.brdf)));
    let on_gpu = gpu.storage("surfaces", surfaces)?;
    let gather =
        gather::gather(gpu, (&on_gpu, surfaces.len() as u32), camera, &kinds, settings, None)?;
    let batches = gather::batches(&gather, lights, seed)?;
    gather.add(&batches, 0..batches.count())?;
    gather.radiance()
}
