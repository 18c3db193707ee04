//! Spheres at the vertices of a grid.

use manylights_gpu::{Error, Gpu};
use manylights_harmonics::wgsl::{self, Function};
use manylights_interpolation::{
    Grid, GridCoefficients, Interpolation, Loops, ProjectionShader, SourceShader, project,
};
use manylights_method::{Parameters, PassTime};
use manylights_scene::AreaLight;

use crate::gather::CAPACITY;
use crate::{Extent, Settings, SphereLight};

/// As [`Estimator::PROJECT`](manylights_area_lights::Estimator::PROJECT).
pub(crate) fn project_lights(
    gpu: &Gpu,
    grid: Grid<f32>,
    how: Interpolation,
    parameters: &Parameters,
    lights: &[AreaLight],
) -> Result<(GridCoefficients, Vec<PassTime>), Error> {
    let settings = Settings::new(parameters);
    let shader = linked_projection(&settings, how.scheme.reads_gradients(), how.loops)?;
    project(gpu, grid, &shader, &SphereLight::all(lights))
}

/// The projection of spheres, records of [`SphereLight`](crate::SphereLight), by the recurrence.
///
/// # Errors
/// Where the shader does not link.
pub fn linked_projection(
    settings: &Settings,
    gradients: bool,
    loops: Loops,
) -> Result<ProjectionShader, Error> {
    let Settings { bands, extent, .. } = *settings;
    let function = if gradients { Function::CapScalesWithRate } else { Function::CapScalesOf };
    SourceShader {
        source: include_str!("shaders/source.wesl"),
        modules: &[
            ("sh", &*wgsl::module(bands, &[function])),
            ("sphere", include_str!("shaders/sphere.wesl")),
        ],
        features: &[("disc", extent == Extent::Disc), ("tabulated", false)],
        capacity: CAPACITY,
    }
    .link(bands, gradients, loops)
}
