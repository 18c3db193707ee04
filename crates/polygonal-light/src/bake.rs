//! What further frames reuse.

use manylights_area_lights::{AreaLightFrame, SceneTables};
use manylights_gpu::Buffer;
use manylights_interpolation::{Interpolation, LightGrid, Lit};
use manylights_method::{Dependencies, Error, Parameters, PassTime, Processor};
use manylights_reflectance::{Materials, Tables};

use crate::{Narrow, Settings, project};

/// The grid of a picture.
fn light_grid(
    frame: &AreaLightFrame<'_>,
    settings: &Settings,
    how: Interpolation,
) -> Result<LightGrid, Error> {
    let AreaLightFrame { scene, on_gpu, pixels, ref lights, .. } = *frame;
    let gpu = on_gpu.gpu();
    let lit = Lit { gpu, scene, surfaces: (on_gpu.surfaces(), pixels), lights };
    Ok(LightGrid::new(how, &lit, |grid, far| project(gpu, grid, settings, how.projection(), far))?)
}

/// The lobes of a scene's materials, on the adapter, and what a grid holds of the lights: the bake.
pub struct LobeTables {
    pub(crate) on_gpu: Vec<Buffer>,
    count: u64,
    pub(crate) grid: Option<LightGrid>,
}

impl SceneTables for LobeTables {
    fn new(frame: &AreaLightFrame<'_>, parameters: &Parameters) -> Result<Self, Error> {
        let settings = Settings::new(parameters);
        let interpolation = Interpolation::new(parameters);
        if interpolation.is_some() {
            refuse_interpolated(&settings)?;
        }
        settings.narrow.check(frame.scene)?;
        let (materials, receivers) = (Materials::of_scene(frame.scene), Tables::new());
        let on_gpu = crate::gather::tables(frame.on_gpu.gpu(), &materials, &settings, &receivers)?;
        let grid = interpolation.map(|how| light_grid(frame, &settings, how)).transpose()?;
        Ok(Self { on_gpu, count: receivers.count(), grid })
    }

    fn depends_on(parameters: &Parameters) -> Dependencies {
        let tables = Dependencies { scene: true, amount: true, ..Dependencies::default() };
        Interpolation::new(parameters).map_or(tables, |how| how.depends_on())
    }

    fn processor(parameters: &Parameters) -> Processor {
        Interpolation::new(parameters).map_or(Processor::Cpu, |_| Processor::Gpu)
    }

    fn grow(&mut self, frame: &AreaLightFrame<'_>, parameters: &Parameters) -> Result<(), Error> {
        if let (Some(grid), Some(how)) = (&mut self.grid, Interpolation::new(parameters)) {
            let mut next = light_grid(frame, &Settings::new(parameters), how)?;
            next.follow(grid);
            *grid = next;
        }
        Ok(())
    }

    fn pass_times(&self) -> Vec<PassTime> {
        self.grid.as_ref().map_or(Vec::new(), LightGrid::pass_times)
    }

    fn count(&self) -> u64 {
        self.count
    }
}

/// What a grid holds are coefficients, which meet lobes on harmonics alone.
fn refuse_interpolated(settings: &Settings) -> Result<(), Error> {
    if settings.narrow != Narrow::Transformed {
        return Ok(());
    }
    Err(Error::Declined(
        "interpolates coefficients against lobes on harmonics, with no ltc of narrow ones: --set \
         narrow=decline, or keep"
            .into(),
    ))
}
