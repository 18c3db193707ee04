//! Spheres at the vertices of a grid.

use manylights_gpu::{Error, Gpu};
use manylights_harmonics::wgsl::{self, Function};
use manylights_interpolation::{
    Grid, GridCoefficients, Held, Interpolation, ProjectionSettings, ProjectionShader,
    SourceShader, project,
};
use manylights_method::{Parameters, PassTime};

use crate::gather::CAPACITY;
use crate::{Extent, Settings, SphereLight};

/// As [`Estimator::PROJECT`](manylights_area_lights::Estimator::PROJECT).
pub(crate) fn project_lights(
    gpu: &Gpu,
    grid: Grid<f32>,
    how: Interpolation,
    parameters: &Parameters,
    held: &Held<'_>,
) -> Result<(GridCoefficients, Vec<PassTime>), Error> {
    let settings = Settings::new(parameters);
    let shader = linked_projection(&settings, how.projection())?;
    let (coefficients, mut times) = project(gpu, grid, &shader, &SphereLight::all(held.far))?;
    if !held.near.is_empty() {
        let discs = Settings { extent: Extent::Disc, ..settings };
        let shader = linked_projection(&discs, how.projection())?;
        let near = SphereLight::all(held.near);
        let smoothed: Vec<_> = near.iter().map(|light| light.smoothed(&grid)).collect();
        times.extend(coefficients.add(gpu, &shader, &smoothed)?);
    }
    Ok((coefficients, times))
}

/// The projection of spheres, records of [`SphereLight`].
///
/// # Errors
/// Where the shader does not link.
pub fn linked_projection(
    settings: &Settings,
    how: ProjectionSettings,
) -> Result<ProjectionShader, Error> {
    let Settings { bands, extent, .. } = *settings;
    let function = if how.gradients { Function::CapScalesWithRate } else { Function::CapScalesOf };
    SourceShader {
        source: include_str!("shaders/source.wesl"),
        modules: &[
            ("sh", &*wgsl::module(bands, &[function])),
            ("sphere", include_str!("shaders/sphere.wesl")),
        ],
        features: &[("disc", extent == Extent::Disc), ("tabulated", false)],
        capacity: CAPACITY,
    }
    .link(bands, how)
}
