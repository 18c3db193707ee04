//! What methods that gather virtual lights have in common, but for the estimator.

use std::time::Instant;

use glam::Vec3;
use manylights_gpu::{GpuFrame, Shadows};
use manylights_method::{
    Bake, Baking, Cost, CounterInfo, Dependencies, Error, Frame, Method, ParameterInfo, Parameters,
    PassTime, PassTimes, Processor, Progress, Run,
};
use manylights_metrics::RadianceImage;
use manylights_scene::{Scene, Transport, Visibility};

use crate::light_gather::{LightBatches, LightGather};
use crate::parameters::COST;
use crate::placement::scene_maps;
use crate::rsm::Map;

/// What a light contributes to a pixel, for methods that gather virtual lights on the adapter. All else
/// is alike for all of them, and [`VirtualLights`] makes them a [`Method`] of it: one indirect bounce of point-like primary lights; time
/// and accuracy grow with the parameter [`LIGHTS`](crate::LIGHTS); the thesis casts no shadow rays; and
/// half of the lights is half of the flux, so that only the last picture estimates anything.
pub trait Estimator: Sync + 'static {
    /// As [`Method::id`].
    const ID: &'static str;
    /// As [`Method::title`].
    const TITLE: &'static str;
    /// As [`Method::version`].
    const VERSION: u32;
    /// As [`Method::parameters`], [`LIGHTS`](crate::LIGHTS) among them.
    const PARAMETERS: &'static [ParameterInfo];
    /// What it bakes; `()` where there is nothing.
    type Tables: SceneTables;

    /// As [`Bake::prepare`], for a frame that virtual lights can render.
    ///
    /// # Errors
    /// [`Error::Declined`] with a reason where the scene is not the method's.
    fn start<'a>(
        frame: ManyLightFrame<'a>,
        parameters: &Parameters,
        tables: &Self::Tables,
    ) -> Result<ManyLightRun<'a>, Error>;
}

/// What an estimator tabulates, on the processor, of the materials of a scene: the bake of methods with
/// virtual lights.
pub trait SceneTables: Sized + 'static {
    /// Whether there are any.
    const BAKED: bool = true;

    /// Makes all of them anew.
    ///
    /// # Errors
    /// [`Error::Declined`] with a reason where the scene is not the method's.
    fn new(frame: &ManyLightFrame<'_>, parameters: &Parameters) -> Result<Self, Error>;

    /// How many were made.
    fn count(&self) -> u64;
}

impl SceneTables for () {
    const BAKED: bool = false;

    fn new(_: &ManyLightFrame<'_>, _: &Parameters) -> Result<Self, Error> {
        Ok(())
    }

    fn count(&self) -> u64 {
        0
    }
}

/// The method of an estimator.
#[derive(Clone, Copy, Debug)]
pub struct VirtualLights<M>(pub M);

impl<M: Estimator> Method for VirtualLights<M> {
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
        &[CounterInfo { name: "lights", help: "lit cells that were gathered" }]
    }

    fn cost(&self) -> Option<Cost> {
        Some(COST)
    }

    fn visibility(&self) -> Visibility {
        Visibility::Ignored
    }

    fn is_progressive(&self) -> bool {
        false
    }

    fn baking(&self) -> Option<&dyn Baking> {
        M::Tables::BAKED.then_some(self)
    }

    fn prepare<'a>(
        &self,
        frame: &Frame<'a>,
        parameters: &Parameters,
    ) -> Result<Box<dyn Run + 'a>, Error> {
        self.bake(frame, parameters)?.prepare(frame, parameters)
    }
}

impl<M: Estimator> Baking for VirtualLights<M> {
    fn depends_on(&self, _: &Parameters) -> Dependencies {
        Dependencies { scene: true, ..Dependencies::default() }
    }

    fn processor(&self, _: &Parameters) -> Processor {
        Processor::Cpu
    }

    fn counters(&self) -> &'static [CounterInfo] {
        &[CounterInfo { name: "tables", help: "made of the materials of the scene" }]
    }

    fn bake(&self, frame: &Frame<'_>, parameters: &Parameters) -> Result<Box<dyn Bake>, Error> {
        let tables = M::Tables::new(&ManyLightFrame::new(frame)?, parameters)?;
        Ok(Box::new(Baked::<M>(tables)))
    }
}

/// The tables of an estimator.
struct Baked<M: Estimator>(M::Tables);

impl<M: Estimator> Bake for Baked<M> {
    fn prepare<'a>(
        &self,
        frame: &Frame<'a>,
        parameters: &Parameters,
    ) -> Result<Box<dyn Run + 'a>, Error> {
        Ok(Box::new(M::start(ManyLightFrame::new(frame)?, parameters, &self.0)?))
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        vec![("tables", self.0.count())]
    }

    fn pass_times(&self) -> Vec<PassTime> {
        Vec::new()
    }
}

/// A frame that virtual lights can render.
pub struct ManyLightFrame<'a> {
    /// As [`Frame::scene`].
    pub scene: &'a Scene,
    /// Of the camera.
    pub eye: Vec3,
    /// As [`Frame::seed`].
    pub seed: u64,
    /// As [`Frame::gpu`].
    pub on_gpu: &'a GpuFrame,
    /// Number of pixels.
    pub pixels: u32,
    visibility: Visibility,
}

impl<'a> ManyLightFrame<'a> {
    fn new(frame: &Frame<'a>) -> Result<Self, Error> {
        let declined = |reason: &str| Err(Error::Declined(reason.to_owned()));
        let Frame { scene, camera, transport, seed, gpu, .. } = *frame;
        let Transport::Indirect { bounces: 1, visibility } = transport else {
            return declined(
                "computes one indirect bounce: use --transport indirect-1 or direct+indirect-1",
            );
        };
        if scene.all_area_lights().next().is_some() {
            return declined("needs point-like primary lights; this scene has some with a surface");
        }
        if scene.lights.is_empty() {
            return declined("needs a point, spot or directional light; this scene has none");
        }
        let Some(on_gpu) = gpu else {
            return Err(Error::Failed("runs on the adapter and was given none".into()));
        };
        let pixels = on_gpu.resolution().into_iter().product();
        Ok(Self { scene, eye: camera.position, seed, on_gpu, pixels, visibility })
    }

    /// The maps that place so many lights: to be found before the clock of the work starts.
    ///
    /// # Errors
    /// Where the maps exceed what the adapter holds.
    pub fn maps(&self, count: u64) -> Result<Vec<Map>, Error> {
        Ok(scene_maps(self.on_gpu, self.scene, count, self.seed)?)
    }

    /// The shadow rays that the transport wants.
    ///
    /// # Errors
    /// Where the adapter cannot hold the scene's hierarchy.
    pub fn shadows(&self) -> Result<Option<Shadows>, Error> {
        match self.visibility {
            Visibility::Traced => Ok(Some(Shadows::new(self.on_gpu, self.scene)?)),
            Visibility::Ignored => Ok(None),
        }
    }
}

/// The lights of a picture on the adapter, and the passes that placed them there.
pub type PlacedLights = Result<(LightBatches, Vec<PassTime>), manylights_gpu::Error>;

/// A picture in the making: lights are placed in the first step, then gathered batch by batch.
pub struct ManyLightRun<'a> {
    frame: &'a GpuFrame,
    gather: LightGather,
    batches_a_step: usize,
    place: Box<dyn Fn(&LightGather) -> PlacedLights + 'a>,
    placed: Option<LightBatches>,
    next: usize,
    times: PassTimes,
}

impl<'a> ManyLightRun<'a> {
    /// `place` makes the lights, inside the clock; `batches_a_step` of them are gathered in one
    /// submission, at least one.
    pub fn new(
        frame: &'a GpuFrame,
        gather: LightGather,
        batches_a_step: u64,
        place: impl Fn(&LightGather) -> PlacedLights + 'a,
    ) -> Self {
        let most = gather.traced_batches().unwrap_or(usize::MAX);
        Self {
            frame,
            gather,
            batches_a_step: (batches_a_step as usize).clamp(1, most),
            place: Box::new(place),
            placed: None,
            next: 0,
            times: PassTimes::default(),
        }
    }
}

impl Run for ManyLightRun<'_> {
    fn step(&mut self) -> Result<Progress, Error> {
        let start = Instant::now();
        let batches = match self.placed.take() {
            Some(batches) => batches,
            None => {
                let (batches, times) = (self.place)(&self.gather)?;
                // Maps read back, lights made of them and uploaded.
                self.times.add(&times, "place", start);
                batches
            }
        };
        let start = Instant::now();
        let end = (self.next + self.batches_a_step).min(batches.count());
        let times = self.gather.add(&batches, self.next..end)?;
        // Passes encoded, submitted and waited for.
        self.times.add(&times, "submit", start);
        self.next = end;
        let [done, total] = [end, batches.count()].map(|end| batches.lights(0..end));
        self.placed = Some(batches);
        Ok(Progress { done, total })
    }

    fn resolve(&mut self) -> Result<RadianceImage, Error> {
        let [width, height] = self.frame.resolution();
        let mut pixels = self.gather.radiance()?;
        // Truncated expansions may sum to less than no light. `max` would hide what is not a number.
        for value in pixels.as_flattened_mut().iter_mut().filter(|value| **value < 0.0) {
            *value = 0.0;
        }
        Ok(RadianceImage { width, height, pixels })
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        let done = self.placed.as_ref().map_or(0, |batches| batches.lights(0..self.next));
        vec![("lights", done)]
    }

    fn pass_times(&self) -> Vec<PassTime> {
        self.times.list()
    }
}
