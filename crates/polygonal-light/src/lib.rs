//! Polygonal lights on spherical harmonics at every pixel.
//!
//! Direct light of triangles, one- and two-sided, without shadows:
//!
//! L(x, v) = Σ_j L_j Σ_lm t_j,lm F_lm(v)
//!
//! with L_j the radiance of triangle j, t_j,lm the coefficients of the directions in which it is seen, and F
//! the expansion of the cosine-weighted reflectance in `bands` bands, as for spherical lights.
//!
//! # Spheres in the triangles' stead (Mézières 2023, thesis 4.2)
//! A sphere at the centroid (4.7) of radius r = √(area/π) (4.8) sends c_l Y_lm(ω), at a distance d from the point
//! in the direction ω, at γ from the triangle's normal; with c_l(s) of the cap of sine s and Ω the triangle's
//! own solid angle:
//!
//! | `approximation` | c_l | error of an equilateral triangle's 5 bands at 2 and 10 sizes √(2 area) |
//! |---|---|---|
//! | `sphere` | c_l(r/d) | 2.2, 2.4 |
//! | `main` (4.9) | \|cos γ\| c_l(r/d) | 0.066, 0.0026 |
//! | `solid-angle` (4.14) | of the cap of solid angle Ω | 0.055, 0.0021 |
//! | `compromise` (4.17) | c_l(r/d \|cos γ\|) | 0.52, 0.52 |
//! | `compromise-root` | c_l(r/d √\|cos γ\|) | 0.058, 0.0022 |
//! | `scaled` | c_l(r/d) Ω/c_0(r/d) | 0.053, 0.0021 |
//! | `point` | Ω | 0.079, 0.0031 |
//!
//! All but `sphere` and `compromise` tend to the triangle with the square of the distance, or with the number
//! of triangles that a polygon is cut into (`tests/forms.rs`). A one-sided triangle sends nothing to its back.
//! [`TriangleSighting`](manylights_harmonics::zonal::TriangleSighting) has all of them with their gradients.
//!
//! ## Hard cases
//! - Within the sphere about the centroid (d ≤ r) its cap is the hemisphere, at the centroid itself that about the
//!   receiver's normal, as of spherical lights.
//! - In the triangle's plane |cos γ| has a kink, like the two-sided light itself; `sphere` has a step
//!   there where the light is one-sided.
//! - A triangle without area is no light.
//! - The solid angle is that of van Oosterom and Strackee from differences of corners: with unit vectors
//!   (4.13) f32 loses all digits of it at a thousand sizes. Lengths may be 1e-10 to 1e11 m.
//!
//! ## Cost
//! A light takes 48 bytes, where its solid angle counts 64.
//!
//! ## Deviations from the thesis
//! - 4.14's arc cosine leaves no digit of a small light in f32; here cos a = 1 − Ω/2π and sin² a = Ω/π (1 −
//!   Ω/4π).
//! - The root in `compromise-root`: a cap's solid angle is quadratic in its angle, the foreshortening that it has to
//!   show linear in the cosine, so that 4.17 as printed is wrong by |cos γ| at any distance.
//! - `scaled` and `point` are not in the thesis.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod exact;
mod gather;
mod light_record;
mod operations;
pub mod oracle;
mod params;

use manylights_area_lights::{AreaGather, AreaLightFrame, AreaLightRun, Estimator, SceneTables};
use manylights_gpu::Buffer;
use manylights_harmonics::even_count;
use manylights_method::{Error, ParameterInfo, Parameters, Run};
use manylights_reflectance::{Materials, Tables};
use manylights_scene::AreaLight;

pub use exact::Edges;
pub use gather::{gather, linked_shader};
pub use manylights_area_lights::Narrow;
pub use manylights_harmonics::zonal::TriangleForm;
pub use operations::{ExactOperations, exact_operations};
pub use params::{Approximation, MAX_BANDS, Settings};

use gather::Records;

/// The method is `AreaLights(PolygonalLights)`.
#[derive(Clone, Copy, Debug)]
pub struct PolygonalLights;

impl Estimator for PolygonalLights {
    const ID: &'static str = "polygonal-light";
    const TITLE: &'static str =
        "polygonal lights on harmonics (Wang & Ramamoorthi 2018; thesis 3.3, 4.2)";
    const VERSION: u32 = 1;
    const PARAMETERS: &'static [ParameterInfo] = params::PARAMETERS;
    const TAKES: &'static str = "triangles";
    type Tables = LobeTables;

    fn takes(light: &AreaLight) -> bool {
        matches!(light, AreaLight::Triangle { .. })
    }

    fn start<'a>(
        frame: AreaLightFrame<'a>,
        parameters: &Parameters,
        tables: &LobeTables,
    ) -> Result<Box<dyn Run + 'a>, Error> {
        let settings = Settings::new(parameters);
        let AreaLightFrame { scene, eye, on_gpu, pixels, lights } = frame;
        let kinds = Materials::of_scene(scene).kinds();
        let shader = linked_shader(kinds, &settings)?;
        let surfaces = (on_gpu.surfaces(), pixels);
        let gather = AreaGather::new(on_gpu.gpu(), surfaces, eye, &shader, tables.on_gpu.clone())?;
        let (products, count) = (even_count(settings.bands) * kinds.channels(), lights.len());
        Ok(match Records::new(&lights, settings.approximation) {
            Records::Exact(records) => {
                Box::new(AreaLightRun::new(on_gpu, gather, (records, count), products))
            }
            Records::Centers(records) => {
                Box::new(AreaLightRun::new(on_gpu, gather, (records, count), products))
            }
            Records::Corners(records) => {
                Box::new(AreaLightRun::new(on_gpu, gather, (records, count), products))
            }
        })
    }
}

/// The lobes of a scene's materials, on the adapter: the bake.
pub struct LobeTables {
    on_gpu: Vec<Buffer>,
    count: u64,
}

impl SceneTables for LobeTables {
    fn new(frame: &AreaLightFrame<'_>, parameters: &Parameters) -> Result<Self, Error> {
        let settings = Settings::new(parameters);
        settings.narrow.check(frame.scene)?;
        let (materials, receivers) = (Materials::of_scene(frame.scene), Tables::new());
        let on_gpu = gather::tables(frame.on_gpu.gpu(), &materials, &settings, &receivers)?;
        Ok(Self { on_gpu, count: receivers.count() })
    }

    fn count(&self) -> u64 {
        self.count
    }
}
