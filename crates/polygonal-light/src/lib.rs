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
//! A sphere at the centroid that has the triangle's area as its disk's sends c_l Y_lm(ω); what c_l is the
//! parameter `approximation` says ([`TriangleForm`]).
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
