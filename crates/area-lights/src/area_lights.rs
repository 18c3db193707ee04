//! What methods on lights with a surface have in common, but for the estimator.

use manylights_method::{
    Bake, Baking, Cost, CounterInfo, Dependencies, Direction, Error, Frame, Method, ParameterInfo,
    Parameters, PassTime, Processor, Run,
};
use manylights_scene::{AreaLight, Visibility};

use crate::frame::AreaLightFrame;

/// The name of the parameter that time and accuracy grow with.
pub const BANDS: &str = "bands";

/// What every run counts first.
pub const LIGHTS: CounterInfo = CounterInfo { name: "lights", help: "that were gathered" };

/// What a light with a surface contributes to a pixel, on the adapter. All else is alike for all of them,
/// and [`AreaLights`] makes them a [`Method`] of it: direct light of all lights at every pixel, without
/// shadows; time and accuracy grow with the parameter [`BANDS`]; nothing is left to chance; and half of
/// the lights is half of the light, so that only the last picture estimates anything.
pub trait Estimator: Sync + 'static {
    /// As [`Method::id`].
    const ID: &'static str;
    /// As [`Method::title`].
    const TITLE: &'static str;
    /// As [`Method::version`].
    const VERSION: u32;
    /// As [`Method::parameters`], [`BANDS`] among them.
    const PARAMETERS: &'static [ParameterInfo];
    /// The kind of light that it takes, in the plural.
    const TAKES: &'static str;
    /// As [`Method::counters`].
    const COUNTERS: &'static [CounterInfo] = &[LIGHTS];
    /// What it bakes.
    type Tables: SceneTables;

    /// Whether a light is of that kind.
    fn takes(light: &AreaLight) -> bool;

    /// As [`Bake::prepare`], for a frame whose lights are of its kind: an
    /// [`AreaLightRun`](crate::AreaLightRun) over records of all of them.
    ///
    /// # Errors
    /// [`Error::Declined`] with a reason where the scene is not the method's.
    fn start<'a>(
        frame: AreaLightFrame<'a>,
        parameters: &Parameters,
        tables: &Self::Tables,
    ) -> Result<Box<dyn Run + 'a>, Error>;
}

/// What an estimator tabulates of the materials of a scene and of its own formulas, and what else it bakes.
pub trait SceneTables: Sized + 'static {
    /// Makes all of them anew.
    ///
    /// # Errors
    /// [`Error::Declined`] with a reason where the scene is not the method's.
    fn new(frame: &AreaLightFrame<'_>, parameters: &Parameters) -> Result<Self, Error>;

    /// How many tables were made.
    fn count(&self) -> u64;

    /// As [`Baking::depends_on`]; of tables alone the scene and the amount.
    fn depends_on(_: &Parameters) -> Dependencies {
        Dependencies { scene: true, amount: true, ..Dependencies::default() }
    }

    /// As [`Baking::processor`].
    fn processor(_: &Parameters) -> Processor {
        Processor::Cpu
    }

    /// As [`Bake::grow`].
    ///
    /// # Errors
    /// As there.
    fn grow(&mut self, _: &AreaLightFrame<'_>, _: &Parameters) -> Result<(), Error> {
        Ok(())
    }

    /// As [`Bake::pass_times`].
    fn pass_times(&self) -> Vec<PassTime> {
        Vec::new()
    }
}

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
        M::COUNTERS
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
        M::Tables::depends_on(parameters)
    }

    fn processor(&self, parameters: &Parameters) -> Processor {
        M::Tables::processor(parameters)
    }

    fn counters(&self) -> &'static [CounterInfo] {
        &[CounterInfo { name: "tables", help: "made of the scene's materials and of coefficients" }]
    }

    fn bake(&self, frame: &Frame<'_>, parameters: &Parameters) -> Result<Box<dyn Bake>, Error> {
        let frame = frame_of::<M>(frame)?;
        Ok(Box::new(Baked::<M>(M::Tables::new(&frame, parameters)?)))
    }
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

/// The tables of an estimator.
struct Baked<M: Estimator>(M::Tables);

impl<M: Estimator> Bake for Baked<M> {
    fn prepare<'a>(
        &self,
        frame: &Frame<'a>,
        parameters: &Parameters,
    ) -> Result<Box<dyn Run + 'a>, Error> {
        M::start(frame_of::<M>(frame)?, parameters, &self.0)
    }

    fn grow(&mut self, frame: &Frame<'_>, parameters: &Parameters) -> Result<(), Error> {
        self.0.grow(&frame_of::<M>(frame)?, parameters)
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        vec![("tables", self.0.count())]
    }

    fn pass_times(&self) -> Vec<PassTime> {
        self.0.pass_times()
    }
}
