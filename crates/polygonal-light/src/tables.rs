//! What further frames reuse.

use manylights_area_lights::SceneTables;
use manylights_gpu::Gpu;
use manylights_interpolation::{Interpolation, Near};
use manylights_method::{Error, Parameters};
use manylights_reflectance::{Materials, Tables};
use manylights_scene::Scene;

use crate::{Narrow, Settings};

/// The lobes of a scene's materials.
pub(crate) fn tables(
    gpu: &Gpu,
    scene: &Scene,
    parameters: &Parameters,
) -> Result<SceneTables, Error> {
    let settings = Settings::new(parameters);
    if let Some(how) = Interpolation::new(parameters) {
        refuse_interpolated(&settings, how)?;
    }
    settings.narrow.check(scene)?;
    let (materials, receivers) = (Materials::of_scene(scene), Tables::new());
    let on_gpu = crate::gather::tables(gpu, &materials, &settings, &receivers)?;
    Ok(SceneTables { on_gpu, count: receivers.count() })
}

/// What a grid holds are coefficients, which meet lobes on harmonics alone; of near lights spheres alone are
/// smoothed.
fn refuse_interpolated(settings: &Settings, how: Interpolation) -> Result<(), Error> {
    let reason = if settings.narrow == Narrow::Transformed {
        "interpolates coefficients against lobes on harmonics, with no ltc of narrow ones: --set \
         narrow=decline, or keep"
    } else if how.near == Near::Smoothed {
        "smooths no triangles near the grid: --set near=apart"
    } else {
        return Ok(());
    };
    Err(Error::Declined(reason.into()))
}
