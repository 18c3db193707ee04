//! Operations on floats in the kernels' text.

use manylights_gpu::operations;
use manylights_harmonics::count;
use manylights_harmonics::polygon::PolygonProjection;
use manylights_interpolation::Loops;
use manylights_polygonal_light::{Approximation, linked_exact_projection};
use {manylights_polygonal_light as polygonal, manylights_spherical_light as spherical};

use crate::projected::{Case, Kind, far_share};

/// Of a matrix of three channels, a value and three derivatives each: additions that the count leaves out.
const MATRIX: f64 = 12.0;

fn floats(wgsl: &str, function: &str, turns: u64) -> f64 {
    let found = operations(wgsl, function, turns).expect("it has the function");
    (found.simple + found.special) as f64
}

/// Of all lights of a case at a vertex, all lanes of it together.
pub(crate) fn operations_a_vertex(case: &Case) -> f64 {
    let Case { kind, bands, lights, .. } = *case;
    let a_light = match kind.approximation() {
        _ if kind == Kind::Spheres => {
            let settings = spherical::Settings { bands, ..Default::default() };
            let shader = spherical::linked_projection(&settings, case.how()).expect("it links");
            zonal(case, &shader.wgsl)
        }
        Approximation::Sphere(form) => {
            let shader = polygonal::linked_projection(form, bands, case.how()).expect("it links");
            zonal(case, &shader.wgsl)
        }
        Approximation::Exact(_) => exact(case),
    };
    f64::from(lights) * a_light
}

/// What is outside of the loop over lights, its stores, is left out.
fn zonal(case: &Case, wgsl: &str) -> f64 {
    let (bands, coefficients) = (case.bands, count(case.bands) as f64);
    let sight = |turns| floats(wgsl, "package_source_sight", turns);
    let stores = coefficients * floats(wgsl, "package_store_store", 1);
    let lanes = if case.loops == Loops::Forward { 1 } else { bands };
    let each_band = lanes as f64 * (sight(bands as u64) - sight(1));
    let sums = if case.gradients { MATRIX * coefficients } else { 0.0 };
    floats(wgsl, "package_loops_project", 1) - stores + each_band + sums
}

/// Without what one inverse a vertex takes.
fn exact(case: &Case) -> f64 {
    let projection = PolygonProjection::new(case.bands);
    let [wgsl, _] = linked_exact_projection(&projection, case.gradients).expect("it links");
    let bands = case.bands as f64;
    let near = floats(&wgsl, "add_edges", case.bands as u64);
    // A loop over points around one over bands.
    let [none, one, two] = [0, 1, 2].map(|turns| floats(&wgsl, "add_points", turns));
    let inner = 0.5 * (two - 2.0 * one + none);
    let points = none + 7.0 * (one - none - inner) + 7.0 * bands * inner;
    let far = far_share(case.vertices, case.lights);
    let sums = bands * if case.gradients { 2.0 * MATRIX } else { 6.0 };
    projection.directions().len() as f64 * (far * points + (1.0 - far) * near + sums)
}
