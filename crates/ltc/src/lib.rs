//! Area lights by linearly transformed cosines (Heitz, Dupuy, Hill, Neubelt 2016; disks: Heitz and Hill 2017).
//!
//! Direct light of triangles and spheres, without shadows. A receiver's cosine-weighted lobe is a clamped cosine
//! whose directions a matrix transforms
//! ([`transformed_cosine`](manylights_reflectance::transformed_cosine)), so that it reflects of a light what a
//! Lambertian surface reflects of the transformed light:
//!
//! L(x, v) = Σ_j L_j ((f0 A + f90 B)/π · E(M⁻¹ Ω_j) + diffuse/π T(n·v) · E_T(Ω_j))
//!
//! with Ω_j what of light j lies above the horizon and E the irradiance in closed form:
//! - triangles: Lambert's formula, clipped at the horizon and at that of the transform; beyond ten sizes, where
//!   the sum over edges loses its digits, seven points. One-sided ones shine to their front;
//! - spheres: the disk of the silhouette, after the transform an ellipse, whose irradiance is exact where it
//!   crosses no horizon. Where it crosses the surface's, the integral around what is left, which is closed along
//!   an ellipse, too, and from four half-axes on, where its sum loses its digits, points: exact. Where it
//!   crosses the transform's alone, the cap of the same form factor, to 0.5 % of all spheres together. From
//!   inside, the hemisphere about the direction to the centre, at the centre about the normal: exact.
//!
//! The Lambertian lobe alone is exact; under a specular layer T(n·l) n·l is T(0) times the cosine and a circular
//! transformed cosine ([`Layered`](manylights_reflectance::transformed_cosine::Layered)) for the rest.
//!
//! # What it converges to
//! To nothing: it has neither bands nor samples. Against quadrature the specular term errs by 1 to 4 % below
//! roughness 0.4 up to 60° and by tens of per cent at grazing view (`tests/truth.rs`, results/ltc/fit.md).
//!
//! # Operations
//! Per light and receiver, counted in the kernel's text ([`light_operations`], `tests/operations.rs`), as if the surface's
//! horizon cut each triangle into a quadrilateral, that of the transform none, and an ellipse's axis took three
//! steps:
//!
//! | receiver | near triangle | far triangle | sphere | sphere on the horizon | receiver, once a batch |
//! |---|---|---|---|---|---|
//! | Lambertian | 589 | 520 | 130 | 130 | 70 |
//! | with a specular lobe | 1053 | 915 | 922 | 1792 | 223 |
//!
//! Harmonics of nine bands take 429 for a sphere and 3692 for a near triangle. Equal triangles of one plane with a
//! convex outline count as the fewest that cover it ([`Edges`]): a square of 648 triangles as two.
//!
//! # Declined
//! Measured lobes and the exact Fresnel term, which the fit does not know.
//!
//! # Deviations from the papers
//! - Lights are clipped at the surface's horizon before the transform; the papers clip at the transform's
//!   alone, so that lights below the surface shine.
//! - Their edge term has 1/√(1 − (v₁·v₂)²), which is infinite where a point lies between two vertices.
//! - Theirs cuts disks at the transform's horizon, by a table of caps. Here the surface's horizon cuts them
//!   exactly: an ellipse in the stead of the rest would err by 6 to 10 % at roughness 0.3 and 60° from half-angles
//!   of 0.4 on, where this errs by 1.3 and 1.0 %.
//! - No texture on lights.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod gather;
mod operations;
pub mod oracle;

use manylights_area_lights::{Edges, Estimator, Gathering, SceneTables};
use manylights_gpu::Gpu;
use manylights_method::{Error, ParameterInfo, Parameters};
use manylights_reflectance::Materials;
use manylights_scene::{AreaLight, Scene};

pub use gather::{Kind, LightKinds, LightRecord, gather, linked_shader};
pub use operations::{LightOperations, STEPS, light_operations};

/// Of a pixel and a light, about ([`light_operations`]).
pub const OPERATIONS: usize = 1100;

/// The method is `AreaLights(Ltc)`.
#[derive(Clone, Copy, Debug)]
pub struct Ltc;

impl Estimator for Ltc {
    const ID: &'static str = "ltc";
    const TITLE: &'static str = "area lights by linearly transformed cosines (Heitz et al. 2016)";
    const VERSION: u32 = 1;
    const PARAMETERS: &'static [ParameterInfo] = &[Edges::PARAMETER];
    const TAKES: &'static str = "triangles and spheres";

    fn takes(_: &AreaLight) -> bool {
        true
    }

    fn tables(gpu: &Gpu, scene: &Scene, _: &Parameters) -> Result<SceneTables, Error> {
        let materials = Materials::of_scene(scene);
        let kinds = materials.kinds();
        if kinds.measured || kinds.exact_fresnel {
            return Err(Error::Declined(
                "knows GGX lobes with Schlick's Fresnel term; this scene has others".into(),
            ));
        }
        let on_gpu = gather::tables(gpu, &materials)?;
        // One or none, of all lobes.
        let count = u64::from(!on_gpu.is_empty());
        Ok(SceneTables { on_gpu, count })
    }

    fn gather(
        scene: &Scene,
        lights: &[AreaLight],
        parameters: &Parameters,
    ) -> Result<Gathering, Error> {
        let records = LightRecord::all(lights, Edges::new(parameters));
        let kinds = Materials::of_scene(scene).kinds();
        Ok(Gathering {
            shader: linked_shader(kinds, LightKinds::of(&records))?,
            records: Box::new(records),
            operations: OPERATIONS,
        })
    }
}
