//! Harmonics virtual lights (Mézières et al. 2022; thesis 5.2): virtual lights as spheres, their light
//! against the reflectance of the shaded point on spherical harmonics.
//!
//! One indirect bounce, without visibility between virtual light and shaded point:
//!
//! L(x, v) = Σ_j Φ_j f_j(ω_p, −ω_j) ⟨n_j·−ω_j⟩/(π r_j²) H(n_x, ω_j) Σ_lm c_l(r_j/d_j) Y_lm(ω_j) F'_lm(v)
//!
//! with c_l the scales of the cap that the sphere covers (thesis 3.11, in the form that keeps its digits
//! for small caps), F' the expansion of the cosine-weighted reflectance f_x(v, ·) ⟨n_x·⟩ in `bands`
//! bands, and H the share of the sphere above the horizon (5.5–5.8). Seen from inside (d < r) the
//! sphere covers the hemisphere about ω_j.
//!
//! # What it converges to
//! For `scale` → 0 to virtual point lights whose reflectance is cut at `bands`. For `bands` → ∞ to the
//! integral of f_x cos⁺ over the sphere's cap times H ([`oracle::by_quadrature`]). Where the horizon
//! cuts a sphere, that is less than the sphere sends: the expansion of cos⁺ clips already, and H clips
//! again; it is there to stop what a short expansion leaks below the horizon. Where x lies inside a
//! sphere, 1/(π r²) replaces 1/(π d²). Both fade with the radius.
//!
//! # Lobes
//! - Lambertian: a zonal function, n terms; odd bands but l = 1 vanish ([`diffuse`]).
//! - Specular: m ≥ 0 alone, n(n + 1)/2 terms, tabulated over the view's angle ([`lobes`]); twice, since
//!   f0 may have a colour. One table serves all materials of one roughness, textured ones included.
//! - A light's emission is its plain reflectance towards the shaded point; on Lambertian surfaces that
//!   is one colour, and nothing of the light depends on the pixel but the cosine.
//!
//! # Cost
//! A pair of light and pixel takes, for n bands, about 40 operations of geometry, 4n for the scales of
//! the cap, 5n for the Lambertian lobe (3n/2 without a specular one) and 2n² + 5n for the two
//! specular products: see [`manylights_harmonics::wgsl::Generated::operations`]. A pixel's expansions
//! (n(n + 1) numbers) are fetched once a batch. Lights take 48 bytes, glossy ones 64.
//!
//! # Deviations from the papers
//! - 5.8: the lower clamp is π/2 − a; as printed it never acts.
//! - 5.6: emission is not expanded (the thesis: 1 to 5 bands).
//! - Φ_j is the flux of the light's cell, not power/count; the emitting cosine is that of the geometric
//!   normal (see [`manylights_gpu::VirtualLight::flux`]).
//! - A pixel whose sum is negative, which no radiance is, is shown as 0.

pub mod diffuse;
mod gather;
mod light_record;
pub mod lobes;
pub mod oracle;
mod params;
mod spherical_light;

use glam::Vec3;
use manylights_gpu::{Gpu, SurfaceRecord};
use manylights_harmonics::even_count;
use manylights_method::{
    Error, Frame, ManyLightRun, Method, ParameterInfo, Parameters, Processor, Run, many_light_frame,
};
use manylights_scene::Brdf;

use gather::CAPACITY;

pub use gather::linked_shader;
pub use light_record::rounded;
pub use manylights_gpu::SphericalLight;
pub use params::{Horizon, MAX_BANDS, Settings};
pub use spherical_light::spherical_lights;

/// Products of coefficients in one submission, light by pixel: about a second on a slow processor,
/// far below any watchdog on a fast one.
const PRODUCTS_A_STEP: u64 = 1 << 31;

/// The method.
pub struct Hvl;

impl Method for Hvl {
    fn id(&self) -> &'static str {
        "hvl"
    }

    fn title(&self) -> &'static str {
        "harmonics virtual lights (Mézières et al. 2022)"
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
        let on_gpu = many_light_frame(frame)?;
        let settings = Settings::new(parameters);
        let (gpu, Frame { scene, camera, seed, .. }) = (on_gpu.gpu(), *frame);
        let [width, height] = on_gpu.resolution();
        let pixels = width * height;
        let alphas = distinct_alphas(scene.materials.iter().map(|m| m.brdf(Vec3::ZERO)));
        let gather = gather::gather(gpu, pixels, camera.position, &alphas, &settings)?;
        let products_a_batch = u64::from(pixels) * (CAPACITY * even_count(settings.bands)) as u64;
        let batches_a_step = (PRODUCTS_A_STEP / products_a_batch) as usize;
        let place = move || {
            let (lights, times) = spherical_lights(on_gpu, scene, &settings, seed)?;
            Ok((gather::batches(gpu, &lights)?, times))
        };
        Ok(Box::new(ManyLightRun::new(on_gpu, gather, batches_a_step, place)))
    }
}

/// The widths of all specular lobes.
fn distinct_alphas(brdfs: impl Iterator<Item = Brdf>) -> Vec<f32> {
    let mut alphas: Vec<_> = brdfs.filter(Brdf::has_specular).map(|brdf| brdf.alpha).collect();
    alphas.sort_by(f32::total_cmp);
    alphas.dedup();
    alphas
}

/// Radiance of given surfaces under given lights ([`rounded`]), by the adapter's kernels: what a picture
/// does, for hard cases that no scene brings about.
///
/// # Errors
/// Where the adapter refuses.
pub fn gather(
    gpu: &Gpu,
    surfaces: &[SurfaceRecord],
    camera: Vec3,
    lights: &[SphericalLight],
    settings: &Settings,
) -> Result<Vec<[f32; 3]>, manylights_gpu::Error> {
    let brdfs = surfaces.iter().map(SurfaceRecord::brdf);
    let alphas = distinct_alphas(brdfs.chain(lights.iter().map(|sphere| sphere.light.brdf)));
    let gather = gather::gather(gpu, surfaces.len() as u32, camera, &alphas, settings)?;
    let batches = gather::batches(gpu, lights)?;
    gather.add(&gpu.storage("surfaces", surfaces)?, &batches, 0..batches.count())?;
    gather.radiance()
}
