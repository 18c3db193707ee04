//! What methods on lights with a surface have in common, but for the estimator.

use manylights_interpolation::{Held, Interpolation, LightGrid, Lit};
use manylights_method::{
    Bake, Baking, Cost, CounterInfo, Dependencies, Direction, Error, Frame, Method, ParameterInfo,
    Parameters, PassTime, Processor, Run,
};
use manylights_scene::Visibility;

use crate::estimator::{BANDS, Estimator, Project, SceneTables};
use crate::frame::AreaLightFrame;
use crate::run::{AreaLightRun, COUNTERS, GRID_COUNTERS};

/// The method of an estimator.
#[derive(Clone, Copy, Debug)]
pub struct AreaLights<M>(pub M);

impl<M: Estimator> Method for AreaLights<M> {
    fn id(&self) -> &'static str {
        M::ID
    }

    fn title(&self) -> &'static str {
        M::TITLE
    }

    fn version(&self) -> u32 {
        M::VERSION
    }

    fn processor(&self) -> Processor {
        Processor::Gpu
    }

    fn parameters(&self) -> &'static [ParameterInfo] {
        M::PARAMETERS
    }

    fn counters(&self) -> &'static [CounterInfo] {
        if M::PROJECT.is_some() { &GRID_COUNTERS } else { &COUNTERS }
    }

    fn cost(&self) -> Option<Cost> {
        let has_bands = M::PARAMETERS.iter().any(|info| info.name == BANDS);
        has_bands.then_some(Cost { parameter: BANDS, grows: Direction::Up })
    }

    fn visibility(&self) -> Visibility {
        Visibility::Ignored
    }

    fn is_progressive(&self) -> bool {
        false
    }

    fn is_random(&self) -> bool {
        false
    }

    fn baking(&self) -> Option<&dyn Baking> {
        Some(self)
    }

    fn prepare<'a>(
        &self,
        frame: &Frame<'a>,
        parameters: &Parameters,
    ) -> Result<Box<dyn Run + 'a>, Error> {
        self.bake(frame, parameters)?.prepare(frame, parameters)
    }
}

impl<M: Estimator> Baking for AreaLights<M> {
    fn depends_on(&self, parameters: &Parameters) -> Dependencies {
        let tables = Dependencies { scene: true, amount: true, ..Dependencies::default() };
        projection::<M>(parameters).map_or(tables, |(how, _)| how.depends_on())
    }

    fn processor(&self, parameters: &Parameters) -> Processor {
        projection::<M>(parameters).map_or(Processor::Cpu, |_| Processor::Gpu)
    }

    fn counters(&self) -> &'static [CounterInfo] {
        &[CounterInfo { name: "tables", help: "made of the scene's materials and of coefficients" }]
    }

    fn bake(&self, frame: &Frame<'_>, parameters: &Parameters) -> Result<Box<dyn Bake>, Error> {
        let frame = frame_of::<M>(frame)?;
        let tables = M::tables(frame.on_gpu.gpu(), frame.scene, parameters)?;
        let grid = light_grid::<M>(&frame, parameters)?;
        Ok(Box::new(Baked { estimator: std::marker::PhantomData::<M>, tables, grid }))
    }
}

/// Where these parameters ask for a grid.
fn projection<M: Estimator>(parameters: &Parameters) -> Option<(Interpolation, Project)> {
    M::PROJECT.and_then(|project| Some((Interpolation::new(parameters)?, project)))
}

/// A frame whose lights are all of the estimator's kind.
fn frame_of<'a, M: Estimator>(frame: &Frame<'a>) -> Result<AreaLightFrame<'a>, Error> {
    let frame = AreaLightFrame::new(frame)?;
    let others = frame.lights.iter().filter(|light| !M::takes(light)).count();
    if others == 0 {
        return Ok(frame);
    }
    Err(Error::Declined(format!(
        "takes lights that are {}; of this scene's {} lights {others} are others",
        M::TAKES,
        frame.lights.len()
    )))
}

/// What a grid holds of a picture.
fn light_grid<M: Estimator>(
    frame: &AreaLightFrame<'_>,
    parameters: &Parameters,
) -> Result<Option<LightGrid>, Error> {
    let Some((how, project)) = projection::<M>(parameters) else { return Ok(None) };
    let AreaLightFrame { scene, on_gpu, pixels, ref lights, .. } = *frame;
    let gpu = on_gpu.gpu();
    let lit = Lit { gpu, scene, surfaces: (on_gpu.surfaces(), pixels), lights };
    let project = |grid, held: &Held<'_>| project(gpu, grid, how, parameters, held);
    Ok(Some(LightGrid::new(how, &lit, project)?))
}

/// What further frames reuse.
struct Baked<M> {
    estimator: std::marker::PhantomData<M>,
    tables: SceneTables,
    grid: Option<LightGrid>,
}

impl<M: Estimator> Bake for Baked<M> {
    fn prepare<'a>(
        &self,
        frame: &Frame<'a>,
        parameters: &Parameters,
    ) -> Result<Box<dyn Run + 'a>, Error> {
        let (frame, grid) = (frame_of::<M>(frame)?, self.grid.as_ref());
        let lights = grid.map_or(&frame.lights[..], LightGrid::near);
        let gathering = M::gather(frame.scene, lights, parameters)?;
        Ok(Box::new(AreaLightRun::new(&frame, &self.tables.on_gpu, gathering, grid)?))
    }

    fn grow(&mut self, frame: &Frame<'_>, parameters: &Parameters) -> Result<(), Error> {
        let mut next = light_grid::<M>(&frame_of::<M>(frame)?, parameters)?;
        if let (Some(next), Some(before)) = (&mut next, &self.grid) {
            next.follow(before);
        }
        self.grid = next;
        Ok(())
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        vec![("tables", self.tables.count)]
    }

    fn pass_times(&self) -> Vec<PassTime> {
        self.grid.as_ref().map_or(Vec::new(), LightGrid::pass_times)
    }
}
