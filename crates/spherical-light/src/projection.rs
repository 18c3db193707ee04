//! Spheres at the vertices of a grid.

use manylights_gpu::Error;
use manylights_harmonics::wgsl::{self, Function};
use manylights_interpolation::{ProjectionSettings, ProjectionShader, SourceShader};

use crate::gather::CAPACITY;
use crate::{Extent, Settings};

/// The projection of spheres, records of [`SphereLight`](crate::SphereLight).
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
