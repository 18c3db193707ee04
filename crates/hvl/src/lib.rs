//! Harmonics virtual lights (Mézières et al. 2022; thesis 5.2): virtual lights as spheres, their light
//! against the reflectance of the shaded point on spherical harmonics.
//!
//! One indirect bounce, with V the visibility of the sphere's centre, or 1 with `visibility = ignored`:
//!
//! L(x, v) = Σ_j V(x, y_j) Φ_j f_j(ω_p, −ω_j) ⟨n_j·−ω_j⟩/(π r_j²) H(n_x, ω_j) Σ_lm c_l(r_j/d_j) Y_lm(ω_j) F'_lm(v)
//!
//! with c_l the scales of the cap that the sphere covers (thesis 3.11, in the form that keeps its digits
//! for small caps), F' the expansion of the cosine-weighted reflectance f_x(v, ·) ⟨n_x·⟩ in `bands`
//! bands, and H the share of the sphere above the horizon (5.5–5.8). Seen from inside (d < r) the
//! sphere covers the hemisphere about ω_j. At the centre itself ω_j has no limit, and the value jumps.
//!
//! # What it converges to
//! For `scale` → 0 to virtual point lights whose reflectance is cut at `bands`. For `bands` → ∞ to the
//! integral of f_x cos⁺ over the sphere's cap times H ([`oracle::by_quadrature`]). Where the horizon
//! cuts a sphere, that is less than the sphere sends: the expansion of cos⁺ clips already, and H clips
//! again; it is there to stop what a short expansion leaks below the horizon. Where x lies inside a
//! sphere, 1/(π r²) replaces 1/(π d²). Both fade with the radius.
//!
//! # Lobes
//! - Lambertian: a zonal function, n terms; odd bands but l = 1 vanish ([`diffuse`](manylights_reflectance::diffuse)).
//! - Specular: m ≥ 0 alone, n(n + 1)/2 terms, tabulated over the view's angle ([`lobes`](manylights_reflectance::lobes)); twice where
//!   some f0 has a colour. One table serves all materials of one roughness, textured ones included.
//!   With the exact Fresnel term of a dielectric there is one a roughness and index.
//! - Measured: a lobe for each channel, in two tables, by quadrature of the measurement's own
//!   interpolation; and the same for what lights emit. Neither the zonal form nor `emission_bands` = 0
//!   knows measurements.
//! - A window damps the bands of both where it is asked for; it is part of the tables.
//!
//! # Zonal form (5.2.7)
//! The specular lobe is one circular lobe about its own axis ([`zonal`](manylights_reflectance::zonal)), n terms. The Lambertian lobe
//! is no expansion at all: the irradiance of the cap, clipped by the horizon in closed form
//! ([`horizon::irradiance`]), times the transmission at the sphere's centre; H is for the specular lobe
//! alone. So a Lambertian surface is exact, whatever the bands. Limit: one circular lobe. What it
//! misses of a lobe is printed by `examples/hvl_bands.rs`.
//!
//! # Emission (5.6)
//! On Lambertian surfaces one colour: nothing of the light depends on the pixel but the cosine. On
//! glossy ones the scene's reflectance itself by default (`emission_bands` = 0), which is exact
//! and takes about the time of two or three bands of an expansion; or an expansion ([`emission`]), of
//! which band 0 alone leaves nothing of the lobe to evaluate. See `examples/hvl_emission.rs` for what
//! each costs and changes.
//!
//! # Energy
//! What 400 lights send of the energy of 78 400 virtual point lights, and the root mean square error of
//! the display's values against those (96 × 72 pixels, 3 seeds, visibility ignored; 5 bands and no window
//! where nothing is said):
//!
//! | | `trio` | `cornell-glossy` | `cornell` |
//! |---|---|---|---|
//! | vpl, points | 0.94, 0.069 | 1.00, 0.037 | 1.00, 0.035 |
//! | vsl, spheres by samples | 0.90, 0.047 | 0.93, 0.028 | 0.94, 0.027 |
//! | 3 bands | 0.91, 0.069 | 1.10, 0.060 | 0.95, 0.031 |
//! | 5 bands | 0.92, 0.067 | 0.96, 0.045 | 0.96, 0.031 |
//! | 9 bands | 0.92, 0.066 | 0.96, 0.034 | 0.96, 0.030 |
//! | 20 bands | 0.92, 0.066 | 0.96, 0.033 | 0.96, 0.030 |
//! | `window` = `lanczos` | 0.89, 0.068 | 0.99, 0.045 | 0.90, 0.032 |
//! | `window` = `hamming` | 0.89, 0.069 | 0.98, 0.048 | 0.89, 0.033 |
//! | `window` = `hann` | 0.88, 0.069 | 0.99, 0.051 | 0.88, 0.033 |
//! | `window` = `weakest` | 0.75, 0.082 | 0.76, 0.065 | 0.67, 0.055 |
//!
//! Spheres lose 4 to 6 % where horizons cut them, and the more the larger they are. Against traced
//! references of the thesis' and our scenes, 400 lights send 0.72 to 0.94 of the energy, those of vsl 0.85
//! to 0.89: spheres cause much of it, short expansions the rest. Every window errs more than none but
//! Lanczos' on `cornell-glossy`, which ties; at 9 bands the first three cost a third of that energy, and
//! `weakest` as much as at 5.
//!
//! # Cost
//! A pixel's expansion is fetched once a batch, not once a light. Lights take 48 bytes, glossy ones 64.
//! What a pair of light and pixel takes: `tests/examples/virtual_light_throughput`.
//!
//! # Deviations from the papers
//! - 5.8: the lower clamp is π/2 − a; as printed it never acts.
//! - No window damps the reflectance unless one is asked for. The paper has one (HVL 4.2) and does not say
//!   which; what each costs is above.
//! - Tables of shaded points' lobes, a degree apart as in the paper, are interpolated; the paper reads one
//!   entry.
//! - The expansion of a light's emission is scaled to the flux of the lobe itself ([`emission`]): as
//!   projected, one band emits half to 23 times of it.
//! - Φ_j is the flux of the light's cell, not power/count; the emitting cosine is that of the geometric
//!   normal (see [`manylights_virtual_lights::VirtualLight::flux`]).
//! - 5.2.7: axis, cosine and Lambertian lobe, see [`zonal`](manylights_reflectance::zonal) and above.
//! - A pixel whose sum is negative, which no radiance is, is shown as 0.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

pub mod emission;
mod gather;
pub mod horizon;
mod light_record;
pub mod oracle;
mod params;
mod virtual_sphere;

use glam::Vec3;
use manylights_gpu::{Buffer, Gpu, SurfaceRecord};
use manylights_harmonics::even_count;
use manylights_method::{Error, ParameterInfo, Parameters};
use manylights_reflectance::{Materials, Tables};
use manylights_virtual_lights::LightGather;
use manylights_virtual_lights::{Estimator, ManyLightFrame, ManyLightRun, SceneTables};

use emission::EmissionTables;
use gather::CAPACITY;

pub use gather::{LobeKinds, linked_shader};
pub use light_record::rounded;
pub use manylights_virtual_lights::VirtualSphere;
pub use params::{Horizon, MAX_BANDS, Settings};
pub use virtual_sphere::virtual_spheres;

/// Products of coefficients in one submission, light by pixel, where a batch has fewer; a batch is never
/// cut. About a second on a slow processor, far below any watchdog on a fast one.
const PRODUCTS_A_STEP: u64 = 1 << 31;

/// The method is `VirtualLights(Hvl)`.
#[derive(Clone, Copy, Debug)]
pub struct Hvl;

impl Estimator for Hvl {
    const ID: &'static str = "hvl";
    const TITLE: &'static str = "harmonics virtual lights (Mézières et al. 2022)";
    const VERSION: u32 = 1;
    const PARAMETERS: &'static [ParameterInfo] = params::PARAMETERS;
    type Tables = LobeTables;

    fn start<'a>(
        frame: ManyLightFrame<'a>,
        parameters: &Parameters,
        tables: &LobeTables,
    ) -> Result<ManyLightRun<'a>, Error> {
        let settings = Settings::new(parameters);
        let ManyLightFrame { scene, eye, on_gpu, pixels, .. } = frame;
        let gpu = on_gpu.gpu();
        let materials = Materials::of_scene(scene);
        let (maps, shadows) = (frame.maps(settings.lights)?, frame.shadows()?);
        let tables = tables.on_gpu.clone();
        let surfaces = (on_gpu.surfaces(), pixels);
        let gather = gather::gather(gpu, surfaces, eye, &materials, tables, &settings, shadows)?;
        let products_a_pair = even_count(settings.bands) * materials.kinds().channels();
        let products_a_batch = u64::from(pixels) * (CAPACITY * products_a_pair) as u64;
        let batches_a_step = PRODUCTS_A_STEP / products_a_batch;
        let place = move |gather: &LightGather| {
            let (lights, times) = virtual_spheres(on_gpu, scene, &maps, &settings)?;
            Ok((gather::batches(gather, &lights, &materials, &settings)?, times))
        };
        Ok(ManyLightRun::new(on_gpu, gather, batches_a_step, place))
    }
}

/// The lobes of a scene's materials on the adapter: the bake.
pub struct LobeTables {
    on_gpu: Vec<Buffer>,
    count: u64,
}

impl SceneTables for LobeTables {
    fn new(frame: &ManyLightFrame<'_>, parameters: &Parameters) -> Result<Self, Error> {
        let settings = Settings::new(parameters);
        let materials = Materials::of_scene(frame.scene);
        if let Some(reason) = gather::declined(&materials, &settings) {
            return Err(Error::Declined(reason.into()));
        }
        let (receivers, emissions) = (Tables::new(), EmissionTables::new());
        let gpu = frame.on_gpu.gpu();
        let on_gpu = gather::tables(&materials, gpu, &settings, (&receivers, &emissions))?;
        Ok(Self { on_gpu, count: receivers.count() + emissions.count() })
    }

    fn count(&self) -> u64 {
        self.count
    }
}

/// Radiance of given surfaces under given lights ([`rounded`]), by the adapter's kernels: what a picture
/// does, for hard cases that no scene brings about. The settings are to be such that [`Hvl`] would not
/// decline the reflectances.
///
/// # Errors
/// Where the adapter refuses.
pub fn gather(
    gpu: &Gpu,
    surfaces: &[SurfaceRecord],
    camera: Vec3,
    lights: &[VirtualSphere],
    settings: &Settings,
) -> Result<Vec<[f32; 3]>, manylights_gpu::Error> {
    let brdfs = surfaces.iter().map(SurfaceRecord::brdf);
    let materials = Materials::new(brdfs.chain(lights.iter().map(|sphere| sphere.light.brdf)));
    let shared = (Tables::shared(), EmissionTables::shared());
    let tables = gather::tables(&materials, gpu, settings, shared)?;
    let on_gpu = gpu.storage("surfaces", surfaces)?;
    let surfaces = (&on_gpu, surfaces.len() as u32);
    let gather = gather::gather(gpu, surfaces, camera, &materials, tables, settings, None)?;
    let batches = gather::batches(&gather, lights, &materials, settings)?;
    gather.add(&batches, 0..batches.count())?;
    gather.radiance()
}
