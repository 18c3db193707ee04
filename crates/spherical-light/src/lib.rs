//! Spherical lights on spherical harmonics at every pixel (Mézières, Desrichard, Vanderhaeghe, Paulin, JFIG
//! 2020; thesis 3.1, 4.1).
//!
//! Direct light of spheres, without shadows:
//!
//! L(x, v) = Σ_j L_j Σ_lm c_l(a_j) Y_lm(ω_j) F_lm(v)
//!
//! with L_j the radiance of sphere j, ω_j the direction to its centre, c_l the scales of the cap of half-angle
//! a_j that it covers (thesis 3.11 in the form that keeps its digits for small caps), and F the expansion of
//! the cosine-weighted reflectance f_x(v, ·) ⟨n_x·⟩ in `bands` bands:
//! - Lambertian lobe: zonal about the normal, n terms A_l c_l P_l(n·ω) (2l + 1)/4π, odd bands but l = 1
//!   vanish; under a specular layer with the transmission towards the light
//!   ([`diffuse`](manylights_reflectance::diffuse));
//! - specular lobe: in the frame of normal and view m ≥ 0 alone, n(n + 1)/2 terms, tabulated over the view's
//!   angle ([`lobes`](manylights_reflectance::lobes)); twice where some f0 has a colour, and for each channel
//!   of a measurement.
//!
//! # The thesis' products
//! With `product` other than `full` the pixel sums the coefficients L_lm of all lights and shades once: the SH
//! product T of L and the clamped cosine, in one of five ways (4.1.3, [`CosineProduct`]), against the specular
//! lobe without its cosine as a circular lobe about the mirror direction
//! ([`mirror`](manylights_reflectance::mirror)). The irradiance is 2√π T_00 (4.4), or of three bands of its own
//! (`diffuse = three-bands`); under a specular layer the transmission towards the light is a second zonal sum.
//! The ways that expand the cosine (`general`, `4.5`, `4.5-cut`) go up to 9 bands.
//!
//! # What it converges to
//! For `bands` → ∞ to the integral of f_x cos⁺ over the spheres' caps: the truth of transport `direct`
//! without occlusion. Since the cosine is in the lobe, n bands of it are exact for a light of n bands. What n
//! bands leave of a Lambertian surface is 0.8 % at a half-angle of 0.2 and 9 bands; of glossy ones the more
//! the narrower the lobe: `tests/floors.rs`. The thesis' products keep the floor of their circular lobe, 11–35 %
//! at roughness 0.7 and 1, which 15 bands leave as 9 have it: there as well.
//!
//! # Hard cases
//! - Inside the sphere and on it (d ≤ r) it covers the hemisphere about the direction to its centre, at the
//!   centre itself about the normal. `extent = disc` sees a disc of the sphere's radius that faces the point
//!   (thesis 3.29, sin a = r/√(d² + r²)), whose cap has a bounded derivative everywhere.
//! - No light is cut at the horizon: that would put a step where the expansion has none.
//! - A pixel whose sum is negative, which no radiance is, is shown as 0.
//! - Lights within two cells of a grid, which no scheme follows, are met at each pixel, or with `near = smoothed` held
//!   by the grid as discs of the same power L r² and at least half a cell's radius. Of a sphere of radius h/5 in
//!   a 9³ grid of spacing h Hermite then misses 62 to 86 % where the sphere itself left 82 to 110 %, and 81 % for
//!   2400 % next to a vertex; in the middle of a cell 80 for 75 % (`tests/smoothed.rs`).
//!
//! # Narrow lobes
//! Below roughness 0.3 no affordable number of bands sees a lamp: of one of half-angle 0.05 nine bands miss
//! 94 % at roughness 0.1 and 55 % at 0.3. Such scenes are declined by default ([`Narrow`]). Of a measurement
//! the roughness is the one of the GGX lobe that its own data stand next to
//! ([`Brdf::alpha`](manylights_scene::Brdf)), an estimate: it decides as well.
//!
//! With `narrow = ltc` such a lobe meets each light as a linearly transformed cosine
//! ([`transformed_cosine`](manylights_reflectance::transformed_cosine)): of that lamp it misses below 2 % at roughness
//! 0.1 up to 60°. The Lambertian lobe under it stays on harmonics. It needs Schlick's Fresnel term and `product = full`;
//! kernels of scenes without narrow lobes do not change.
//!
//! # Cost
//! A pixel's expansion is fetched once a batch of lights, not once a light; a light takes 32 bytes.
//!
//! # Deviations from the papers
//! - The papers' lobe is without its cosine and zonal about the mirror direction, and the light is multiplied
//!   with the cosine: a floor of 11–35 % on rough surfaces that more bands do not lower.
//! - Their recurrence of the coefficients loses all digits of small lights in f32.
//! - They compute inside a sphere as outside, where arcsin has no value.
//! - The gradient of a disc turns by at most 1/r at a vertex within its radius, where 3.26 has no bound.
//! - Tabulated coefficients: the papers do not say over what; here [`cap_table`].
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

pub mod cap_table;
mod gather;
pub mod oracle;
mod params;
mod projection;
mod tables;

use manylights_area_lights::{
    Estimator, Gathering, Project, SceneTables, TRANSFORMED_OPERATIONS, cap_operations,
};
use manylights_gpu::Gpu;
use manylights_method::{Error, ParameterInfo, Parameters};
use manylights_reflectance::Materials;
use manylights_scene::{AreaLight, Scene};

pub use gather::{SphereLight, gather, linked_shader};
pub use manylights_area_lights::Narrow;
pub use manylights_reflectance::{CosineProduct, Diffuse};
pub use params::{Coefficients, Extent, MAX_BANDS, Product, Settings};
pub use projection::linked_projection;

/// The method is `AreaLights(SphericalLights)`.
#[derive(Clone, Copy, Debug)]
pub struct SphericalLights;

impl Estimator for SphericalLights {
    const ID: &'static str = "spherical-light";
    const TITLE: &'static str =
        "spherical lights on harmonics (Mézières et al., JFIG 2020; thesis 3.1)";
    const VERSION: u32 = 2;
    const PARAMETERS: &'static [ParameterInfo] = params::PARAMETERS;
    const TAKES: &'static str = "spheres";
    const PROJECT: Option<Project> = Some(projection::project_lights);

    fn takes(light: &AreaLight) -> bool {
        matches!(light, AreaLight::Sphere { .. })
    }

    fn tables(gpu: &Gpu, scene: &Scene, parameters: &Parameters) -> Result<SceneTables, Error> {
        tables::tables(gpu, scene, parameters)
    }

    fn gather(
        scene: &Scene,
        lights: &[AreaLight],
        parameters: &Parameters,
    ) -> Result<Gathering, Error> {
        let settings = Settings::new(parameters);
        let kinds = Materials::of_scene(scene).kinds();
        let transformed = gather::transformed(kinds, &settings);
        Ok(Gathering {
            shader: linked_shader(kinds, &settings)?,
            records: Box::new(SphereLight::all(lights)),
            operations: cap_operations(kinds, settings.bands)
                + if transformed { TRANSFORMED_OPERATIONS } else { 0 },
        })
    }
}
