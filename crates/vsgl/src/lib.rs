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
//! again a Gaussian, of sharpness λ. It is reflected by ρ/π ∫ G ⟨n·w⟩ dw (Tokuyoshi et al. 2024), with
//! the lobes' coupling at the view and at the mean cosine of that integral, and by a GGX lobe: its
//! distribution of normals, widened by the light (2024), blended with the product of the light and a
//! Gaussian about the mirrored view of sharpness Λ = (1 − α²)/(2α²), by Λ/(Λ + λ). Fresnel, Schlick's or
//! the exact one, is taken at the direction that contributes most. With `visibility = traced` the light
//! counts where the lit texel nearest to m is seen.
//!
//! # The thesis' variant
//! `lobe = thesis` is what the source of the thesis' time computed (the author's code of 2020, which
//! differs from Tokuyoshi 2015 in taking Banerjee's sharpness for Toksvig's); what `lobe = filtered`,
//! the default, has in its place is later than the thesis:
//!
//! | | `thesis` | `filtered` |
//! |---|---|---|
//! | lobe of cos/π | r = 0.5293 (sharpness 2) | r = 0.575 (sharpness 2.2925, 2025) |
//! | emitted specular lobe | mirrored about the normal | about the dominant visible normal (2025) |
//! | cosine of the shaded point | G(w; n, 2), its product with the light by Iwasaki et al. 2012 | closed form of ∫ G ⟨n·w⟩ (2024) |
//! | GGX lobe of the shaded point | anisotropic Gaussian (Xu et al. 2013) | widened normals (2024), blended (ours) |
//!
//! The deviations below hold for both, but those that name filtered normals; the coupling's mean cosine
//! is in `thesis` that of the product's axis. That the thesis changed nothing else in that source is
//! what its text says, not what we could see.
//!
//! Errors of the closed forms against quadrature: [`oracle::gaussian`], [`oracle::reflection`].
//!
//! # Bias
//! A flat square cell of 14² texels of side a, lit at 30°, against the point lights of its texels: what
//! surfaces at a distance from its centre reflect in all directions, over all places in front and all
//! orientations towards it (`tests/biases.rs`; a number is a roughness of white metal):
//!
//! | cell → surface | a/2 | a | 2 a | 20 a |
//! |---|---|---|---|---|
//! | Lambertian → Lambertian | −41 % | −18 % | −11 % | −9 % |
//! | Lambertian → 0.8 | −46 % | −27 % | −22 % | −20 % |
//! | 0.3 → Lambertian | −33 % | −8 % | −2 % | 0 % |
//! | 0.3 → 0.8 | −41 % | −19 % | −14 % | −12 % |
//! | 0.8 → Lambertian | −42 % | −19 % | −13 % | −10 % |
//! | 0.8 → 0.8 | −46 % | −28 % | −23 % | −21 % |
//!
//! Surfaces of roughness 0.3 are as Lambertian ones to within 3 % but for the light of cells of 0.3 far off
//! (−6 %). Four causes:
//! - Behind its surface, where none is sent, a Gaussian has 9.2 % of a diffuse lobe; of a specular lobe
//!   9 to 13 % from roughness 0.8 on and 2 % at most up to 0.5. Cells that bend or hold an edge have
//!   more: 12 % of the diffuse power in `cornell`, 33 % of the specular in `trio` by the mean normal.
//! - The closed form of rough receivers, whose horizon and mask are taken at one direction, gives 12 %
//!   less at roughness 0.8.
//! - Close by, the Gaussian of places ends neither at the cell nor at the receiver's horizon.
//! - A Gaussian of places is not flat: a plane receives 4.6 % of its exitance from the lights on itself.
//!
//! So the integrating sphere is too dark by 11 % with 150 lights, 6 % with 9600 and 4.6 % in the limit
//! (`tests/tests/integrating_sphere.rs`).
//!
//! Cells that straddle an edge of depth have a large s² and a mean place off the surfaces, from which they
//! leak light. With 400 cells asked for, the mean of 19 % of the power in `cornell`, 15 % in
//! `cornell-glossy`, 8 % in `atrium` and 3 % in `trio` is farther than s/2 from every texel of its cell.
//!
//! # Cutting lobes at their surface
//! `behind = cut` multiplies what arrives of a diffuse lobe by the share of L that is above the surface it
//! leaves, by the closed form of Tokuyoshi 2022, and by 1 + e^{−λ_e}, which gives the lobe in front the
//! power of the whole. Errors against the point lights of all texels, 400 cells asked for, 14² texels,
//! 96 × 72 pixels, 3 seeds, visibility ignored (energy; root mean square of the display's values; median
//! of a pixel's relative error; the sphere 24 × 24 pixels):
//!
//! | | `sent` | `cut` | `lobe = thesis` |
//! |---|---|---|---|
//! | `cornell` | −8.1 %, 0.0358, 0.124 | −1.7 %, 0.0353, 0.104 | −17.4 %, 0.0495, 0.248 |
//! | `cornell-glossy` | −6.2 %, 0.0351, 0.134 | −0.9 %, 0.0351, 0.098 | −15.5 %, 0.0535, 0.250 |
//! | `integrating-sphere` | −9.0 %, 0.0230, 0.094 | −0.7 %, 0.0032, 0.012 | −19.1 %, 0.0507, 0.200 |
//! | `atrium` | −3.0 %, 0.0466, 0.100 | +3.7 %, 0.0451, 0.094 | −1.0 %, 0.0621, 0.274 |
//! | `trio` | +2.4 %, 0.0373, 0.131 | +6.0 %, 0.0368, 0.131 | +13.1 %, 0.0551, 0.312 |
//!
//! It is no default: Tokuyoshi has none, it costs a closed form a light, and but for the sphere the
//! display gains 4 % at most. Specular lobes are not cut: their cell has one normal, and at that curved
//! metal loses a third of what it sends (`trio`: −10 % of all energy).
//!
//! # Deviations from the papers and the author's code
//! - The blend of filtered normals with a product of Gaussians.
//! - A texel has the extent of the patch that it stands for. A square then has one variance however
//!   finely it is cut; at the thesis' 14² texels that adds 1/196.
//! - The power of a specular lobe is the albedo of the GGX lobe from a table (one for Schlick's form, one
//!   for each α and index of the exact form), where the code takes the specular colour times G₂/G₁ at the
//!   lobe's axis or, later, alone: rough lobes lose up to two thirds to masking.
//! - Emitted lobes are at least as sharp as the diffuse one: the formula goes to a uniform sphere for
//!   α → 1, half of which is behind the surface.
//! - Filtered normals are multiplied by G₂/G₁ at the dominant direction; the code leaves it out and
//!   reflects up to 1.6 times too much.
//! - Fresnel and the coupling of the lobes; the code knows neither.
//! - As in `manylights-vpl`: exact solid angles of texels, the emitting cosine of the geometric normal.
//! - `behind = cut`, where it is asked for.
//!
//! # Limits and cost
//! Cells at an edge of which some texel is lit, but not the middle, carry a light here alone: of cells for
//! 400 lights 437 to 448 (`tests/tests/light_counts.rs`).
//!
//! One circular lobe a component, of which a measured material knows none: scenes with such are
//! declined. Lights are read back, as those of other methods are: 96 bytes and 32 for the centre. Lights
//! without specular power have one lobe, others two. What a pair of light and pixel takes:
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
pub use params::{Approximation, Settings};

/// Pairs of light and pixel in one submission: about a second on a slow processor, far below any
/// watchdog on a fast one.
const PAIRS_A_STEP: u64 = 1 << 26;

/// The method is `VirtualLights(Vsgl)`.
#[derive(Clone, Copy, Debug)]
pub struct Vsgl;

impl Estimator for Vsgl {
    const ID: &'static str = "vsgl";
    const TITLE: &'static str = "virtual spherical Gaussian lights (Tokuyoshi 2015)";
    const VERSION: u32 = 2;
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
            Ok((gather::batches(gather, &lights, &settings)?, times))
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
    let batches = gather::batches(&gather, lights, settings)?;
    gather.add(&batches, 0..batches.count())?;
    gather.radiance()
}
