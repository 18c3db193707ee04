//! Polygonal lights on spherical harmonics at every pixel.
//!
//! Direct light of triangles, one- and two-sided, without shadows:
//!
//! L(x, v) = Σ_j L_j Σ_lm t_j,lm F_lm(v)
//!
//! with L_j the radiance of triangle j, t_j,lm the coefficients of the directions in which it is seen, and F
//! the expansion of the cosine-weighted reflectance in `bands` bands, as for spherical lights.
//!
//! # Exact triangles (Wang and Ramamoorthi 2018)
//! `approximation = exact` sums integrals over edges, in adjoint form: seen in the frame of normal and view a
//! reflectance is even in y, so that zonal functions about as many directions of its xz-plane as there are bands
//! make it ([`MirrorPlane`](manylights_harmonics::polygon::MirrorPlane)). A lane turns its lobes into weights
//! of the integrals B_l over edges once a batch; an edge then adds Σ_k (d_k·μ) Σ_l v_kl B_l(d_k), and the solid
//! angle what coefficient 0 is worth. Lambertian receivers need the normal alone, and of its B_l the odd ones and
//! B_0. Nothing is cut at the horizon: the cosine is in the lobe.
//!
//! With `edges = shared` triangles of one plane that are connected by edges, shine to the same sides and lie within
//! rounding of that plane are a group. Its edges are integrated once, times the difference of the radiances on
//! their sides; those between equal radiances vanish, and straight chains of equal differences are one edge. The
//! solid angle is a fan about one corner of the group. A square cut into 648 equal triangles is 4 edges.
//!
//! From 8 sizes on (diameters of a sphere around the group, distances from its centre) triangles are sums over
//! 7 points (Radon 1948, exact for degree 5), from 100 sizes of their own on over one. Of a group those are
//! the triangles of each part of equal radiance, re-cut where its outline is convex.
//!
//! Largest error against the f64 oracle, relative to the largest radiance at that distance, at 9 bands and roughness
//! 0.3 (`tests/exact.rs`, `tests/shared.rs`):
//!
//! | sizes | triangle | panel of 50² texels, roughness 0.5 |
//! |---|---|---|
//! | 0.5 to 1 | 3e-7 | 1e-5 |
//! | 7 | 6e-6 | 4e-5 |
//! | 8 to 100 | 1e-6 | 1e-5 |
//! | 110 | 5e-5 | |
//! | 1 000 | 1e-6 | |
//!
//! Where one form follows the other radiances differ by 6e-6 (8 sizes) and 5e-5 (100; up to 1.7e-4 of the largest
//! on glossy receivers, `results/stability/area-lights.md`). What n bands leave of
//! Lambert's formula, rms over receivers all around at one size: 0.013, 0.0046, 0.00095 and 0.00024 of the largest
//! irradiance for 3, 5, 9 and 15 bands.
//!
//! ## Hard cases
//! - In the plane an edge would pass through the point, and a light that is seen from both sides has a step. A
//!   point within 1e-5 sizes of it, of the triangle or with `edges = shared` of its group, is moved to that
//!   distance on its side, so that inside the polygon 2π are seen up to the plane; the plane itself is of the
//!   back, as with spheres in the triangles' stead. Beside an oblique plane rounding says which side it is.
//! - Needles, points next to edges and corners, on lines of edges, between opposite corners: within 1e-5 of what
//!   a square of that size covers (`tests/hard_cases.rs`).
//! - Curved surfaces that are cut so finely that neighbours seem flat are no groups; each triangle is its own.
//!
//! ## Operations
//! Per light and receiver, counted in the kernel's text ([`exact_operations`], `tests/operations.rs`); a far
//! triangle by 7 points; receivers of grey specular lobes:
//!
//! | bands | triangle | edge of a group | far | sphere | triangle over sphere | lobes to weights, once a batch |
//! |---|---|---|---|---|---|---|
//! | 5 | 1156 | 474 | 1157 | 184 | 6.3 | 427 |
//! | 6 | 1603 | 623 | 1472 | 234 | 6.9 | 547 |
//! | 7 | 2212 | 826 | 1836 | 291 | 7.6 | 708 |
//! | 8 | 2875 | 1047 | 2249 | 355 | 8.1 | 894 |
//! | 9 | 3700 | 1322 | 2711 | 426 | 8.7 | 1125 |
//!
//! Lambertian receivers: 6.0 to 5.3 times a sphere; coloured ones 5.7 to 7.8. Wang's 2n − 1 directions with sums
//! of coefficients for three channels would take 2.4 times the operations of an edge. A square of 648 triangles
//! takes 4 × 1322 near with shared edges, 2 × 2711 far, and 648 spheres 648 × 426.
//!
//! ## Deviations from the paper
//! - Weights of the lobe instead of coefficients of the light, as above.
//! - Integrals from the middle of each arc, instead of differences of its ends
//!   ([`polygon`](manylights_harmonics::wgsl::polygon)): as printed f32 loses 4e-5 at ten sizes, here 3e-6.
//! - Solid angles by van Oosterom and Strackee instead of arc cosines.
//! - Points for far triangles.
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
//!
//! # Narrow lobes
//! Below roughness 0.3 no affordable number of bands sees a lamp; scenes with such lobes are declined by default
//! ([`Narrow`]). With `narrow = ltc` such a lobe meets each triangle as a linearly transformed cosine
//! ([`transformed_cosine`](manylights_reflectance::transformed_cosine)), by the triangle's own corners whatever
//! `approximation` says; with `edges = shared` a group's far triangles serve at any distance. At roughness 0.1 it
//! misses 0.02, 0.06 and 0.5 % of triangles of size 0.1 at 0°, 30° and 60°, of which nine bands miss 86 to
//! 100 % (`tests/narrow.rs`). The Lambertian lobe under it stays on harmonics. It needs Schlick's Fresnel term; kernels
//! of scenes without narrow lobes do not change.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod exact;
mod gather;
mod light_record;
mod operations;
pub mod oracle;
mod params;
mod projection;
mod tables;

use manylights_area_lights::{Estimator, Gathering, Project, SceneTables};
use manylights_gpu::Gpu;
use manylights_method::{Error, ParameterInfo, Parameters};
use manylights_reflectance::Materials;
use manylights_scene::{AreaLight, Scene};

pub use gather::{gather, linked_shader};
pub use manylights_area_lights::{Edges, Narrow};
pub use manylights_harmonics::zonal::TriangleForm;
pub use operations::{ExactOperations, exact_operations, record_operations};
pub use params::{Approximation, MAX_BANDS, Settings};
pub use projection::{linked_exact_projection, linked_projection, project};

/// The method is `AreaLights(PolygonalLights)`.
#[derive(Clone, Copy, Debug)]
pub struct PolygonalLights;

impl Estimator for PolygonalLights {
    const ID: &'static str = "polygonal-light";
    const TITLE: &'static str =
        "polygonal lights on harmonics (Wang & Ramamoorthi 2018; thesis 3.3, 4.2)";
    const VERSION: u32 = 2;
    const PARAMETERS: &'static [ParameterInfo] = params::PARAMETERS;
    const TAKES: &'static str = "triangles";
    const PROJECT: Option<Project> = Some(projection::project_lights);

    fn takes(light: &AreaLight) -> bool {
        matches!(light, AreaLight::Triangle { .. })
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
        Ok(Gathering {
            shader: linked_shader(kinds, &settings)?,
            records: gather::records(lights, kinds, &settings),
            operations: record_operations(kinds, &settings),
        })
    }
}
