//! Virtual spherical Gaussian lights (Tokuyoshi 2015, in the simplified form of thesis 5.2.8).
//!
//! A group of n² texels of a reflective shadow map becomes one light of two spherical Gaussians
//! G(w; p, λ) = exp(λ(p·w − 1)): one for what its texels reflect by their Lambertian lobes, one for
//! their specular lobes. Groups are the cells that other methods give one light each, and the sums are:
//!
//! - power P = Σ Φ_i ρ_i of the texels, which is also their weight w_i (sum of the channels);
//! - mean place m and variance s² along one axis of a plane, half of that of the places;
//! - mean axis ā = Σ w_i r_i a_i / Σ w_i, whose length gives the sharpness λ_e = r(3 − r²)/(1 − r²)
//!   (Banerjee et al. 2005). A texel's diffuse lobe has its geometric normal and r = 0.575 (sharpness
//!   2.2925, fitted to cos/π). Its specular lobe is the mirrored direction to the primary light about
//!   the dominant visible normal, as sharp as the distribution of normals is there.
//!
//! Seen from a distance d in the direction ω_m, places of variance s² are a Gaussian of directions of
//! sharpness d²/s², so that the incident radiance is the product
//!
//! L(w) = P/(2π ∫G_e · s²) · G(w; −ā/|ā|, λ_e) · G(w; ω_m, d²/s²),
//!
//! again a Gaussian. It is reflected by ρ/π ∫ G ⟨n·w⟩ dw (Tokuyoshi et al. 2024), with the lobes'
//! coupling at the view and at the mean cosine of that integral, and by a GGX lobe of which `lobe` says
//! how it is approximated; Fresnel, Schlick's or the exact one, is taken at the direction that
//! contributes most. With `visibility = traced` the light counts where the lit texel nearest to m is
//! seen.
//!
//! Errors of the closed forms against quadrature (`tests/truth.rs`, `tests/lobes.rs`). The diffuse
//! integral, in units of its largest value: 5e-6 for λ = 0.1, 6e-4 for 2.3, 1.5e-3 for 5, 3e-5 for 100.
//! The mean cosine is up to 0.16 too large (λ 2.3), and (1 − c)⁵ of it, which couples the lobes, is off
//! the mean of (1 − c)⁵ by up to 0.16 (λ 5). The specular integral, root mean square over light
//! directions in units of the largest value, mean over roughness 0.4 to 1, views of 10° to 75° and λ of
//! 2.3 to 200: 0.09 by filtered normals (the default), 0.20 by the anisotropic Gaussian of the thesis'
//! source. The exact Fresnel term at one direction (λ 2.3 and 20): gold paint, teflon and red phenolic
//! reflect in all between 8 % too much and 18 % too little, most at 75°; white fabric, whose index of
//! 1.05 makes it the steepest, up to 46 % too little.
//!
//! Deviations from the papers and the author's code:
//! - A texel has the extent of the patch that it stands for. A square then has one variance however
//!   finely it is cut; at the thesis' 14² texels that adds 1/196.
//! - The power of a specular lobe is the albedo of the GGX lobe from a table (one for Schlick's form, one
//!   for each α and index of the exact form), where the code takes the specular colour: rough lobes lose
//!   up to two thirds to masking.
//! - Emitted lobes are at least as sharp as the diffuse one: the formula goes to a uniform sphere for
//!   α → 1, half of which is behind the surface.
//! - Filtered normals are multiplied by G₂/G₁ at the dominant direction; the code leaves it out and
//!   reflects up to 1.6 times too much.
//! - Fresnel and the coupling of the lobes; the code knows neither.
//! - As in `manylights-vpl`: exact solid angles of texels, the emitting cosine of the geometric normal.
//!
//! Limits: one circular lobe a component, of which a measured material knows none: scenes with such are
//! declined. A Gaussian has no horizon: 9.2 % of a diffuse lobe's power goes behind its surface, and a
//! plane receives 4.6 % of its exitance from the lights on itself, so that the integrating sphere is too
//! dark by 11 % with 150 lights, 6 % with 9600 and 4.6 % in the limit
//! (`tests/tests/integrating_sphere.rs`). Groups that straddle an edge of depth have a large s² and a mean place
//! off the surfaces, from which they leak light. Lights are read back, as those of other methods are: 96
//! bytes and 32 for the centre.
//!
//! Cells at an edge of which some texel is lit, but not the middle, carry a light here alone: of cells for
//! 400 lights 437 to 448 (`tests/tests/light_counts.rs`).
//!
//! Lights without specular power have one lobe, others two. What a pair of light and pixel takes:
//! `tests/examples/virtual_light_throughput`.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod albedo;
mod gather;
mod gaussian_light;
mod light_record;
pub mod oracle;
mod params;

use glam::Vec3;
use manylights_gpu::{Gpu, Reflectances, SurfaceRecord};
use manylights_method::{Error, ParameterInfo, Parameters};
use manylights_virtual_lights::LightGather;
use manylights_virtual_lights::{Estimator, ManyLightFrame, ManyLightRun, SceneTables};

use gather::LAMBERT_CAPACITY;
use gaussian_light::{Materials, lights_of_materials};

pub use gather::linked_shader;
pub use gaussian_light::{
    GaussianLight, GaussianLobe, filter_group, filter_shader, gaussian_lights,
};
pub use params::{Settings, SpecularLobe};

/// Pairs of light and pixel in one submission: about a second on a slow processor, far below any
/// watchdog on a fast one.
const PAIRS_A_STEP: u64 = 1 << 26;

/// The method is `VirtualLights(Vsgl)`.
#[derive(Clone, Copy, Debug)]
pub struct Vsgl;

impl Estimator for Vsgl {
    const ID: &'static str = "vsgl";
    const TITLE: &'static str = "virtual spherical Gaussian lights (Tokuyoshi 2015)";
    const VERSION: u32 = 1;
    const PARAMETERS: &'static [ParameterInfo] = params::PARAMETERS;
    type Tables = AlbedoTables;

    fn start<'a>(
        frame: ManyLightFrame<'a>,
        parameters: &Parameters,
        AlbedoTables(materials): &AlbedoTables,
    ) -> Result<ManyLightRun<'a>, Error> {
        let settings = Settings::new(parameters);
        let ManyLightFrame { eye, on_gpu, pixels, .. } = frame;
        let gpu = on_gpu.gpu();
        let materials = materials.clone();
        let (maps, shadows) = (frame.maps(settings.lights)?, frame.shadows()?);
        let gather = gather::gather(
            gpu,
            (on_gpu.surfaces(), pixels),
            eye,
            &materials.kinds,
            &settings,
            shadows,
        )?;
        let batches_a_step = PAIRS_A_STEP / (u64::from(pixels) * LAMBERT_CAPACITY as u64);
        let place = move |gather: &LightGather| {
            let (lights, times) = lights_of_materials(on_gpu, &maps, &materials, &settings)?;
            Ok((gather::batches(gather, &lights)?, times))
        };
        Ok(ManyLightRun::new(on_gpu, gather, batches_a_step, place))
    }
}

/// The albedos of a scene's specular lobes on the adapter: the bake.
pub struct AlbedoTables(Materials);

impl SceneTables for AlbedoTables {
    fn new(frame: &ManyLightFrame<'_>, _: &Parameters) -> Result<Self, Error> {
        if !Reflectances::of_scene(frame.scene).measured.is_empty() {
            return Err(Error::Declined(
                "has circular lobes alone and knows no measured materials; this scene has some"
                    .into(),
            ));
        }
        Ok(Self(Materials::of_scene(frame.on_gpu.gpu(), frame.scene)?))
    }

    fn count(&self) -> u64 {
        self.0.count
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
    let mut kinds = Reflectances::of(surfaces.iter().map(SurfaceRecord::brdf));
    kinds.specular |= lights.iter().any(GaussianLight::has_specular);
    let on_gpu = gpu.storage("surfaces", surfaces)?;
    let gather =
        gather::gather(gpu, (&on_gpu, surfaces.len() as u32), camera, &kinds, settings, None)?;
    let batches = gather::batches(&gather, lights)?;
    gather.add(&batches, 0..batches.count())?;
    gather.radiance()
}
