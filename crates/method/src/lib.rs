//! The trait that every rendering method implements, and what it is told.
//!
//! A method never sees the clock, the budget, the reference or the file system. It is progressive:
//! [`Method::prepare`], then [`Run::step`] until it says that it is done, then [`Run::resolve`]. What
//! further frames may reuse is its [`Bake`].
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod bake;
mod cost;
mod parameters;
mod pass_times;

use manylights_gpu::GpuFrame;
use manylights_metrics::RadianceImage;
use manylights_scene::{Camera, Scene, Transport, Visibility};

pub use bake::{Bake, Baking, Dependencies};
pub use cost::{Amounts, Cost, Direction};
pub use manylights_gpu::PassTime;
pub use parameters::{ChoiceWord, ParameterInfo, ParameterKind, ParameterValue, Parameters};
pub use pass_times::PassTimes;

/// Where the work of a method is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Processor {
    /// All cores of the host; [`Frame::gpu`] may be absent.
    Cpu,
    /// The adapter; [`Frame::gpu`] is present.
    Gpu,
}

/// One picture to make.
#[derive(Clone, Copy)]
pub struct Frame<'a> {
    /// Triangles, materials, lights.
    pub scene: &'a Scene,
    /// Its pixel centres are the primary hits of every method and of the reference.
    pub camera: &'a Camera,
    /// Width, height in pixels.
    pub resolution: [u32; 2],
    /// Which light paths count.
    pub transport: Transport,
    /// Same seed, same picture, bit for bit, on one adapter ([`Method::is_random`]).
    pub seed: u64,
    /// The scene on the adapter and its G-buffer for this camera.
    pub gpu: Option<&'a GpuFrame>,
}

/// How far a run is, in the method's own unit of work (virtual lights, samples a pixel).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Work done.
    pub done: u64,
    /// Work in all.
    pub total: u64,
}

impl Progress {
    /// Whether nothing is left to do.
    pub fn finished(self) -> bool {
        self.done >= self.total
    }
}

/// A number that a method counts, as `list methods` shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CounterInfo {
    /// Its name in results.
    pub name: &'static str,
    /// What is counted.
    pub help: &'static str,
}

/// What a method has to say when it cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The scene or the transport is outside what the method computes. Not a failure: the table
    /// shows the reason.
    #[error("{0}")]
    Declined(String),
    /// Something broke.
    #[error("{0}")]
    Failed(String),
}

impl From<manylights_gpu::Error> for Error {
    fn from(error: manylights_gpu::Error) -> Self {
        Self::Failed(error.to_string())
    }
}

/// A rendering method.
pub trait Method: Sync {
    /// Its name on the command line and in results: lower case, digits and hyphens.
    fn id(&self) -> &'static str;

    /// One line for lists and legends, with its source.
    fn title(&self) -> &'static str;

    /// Of what it computes: raised whenever the same parameters give another picture. Results of
    /// another version are not those of this one.
    fn version(&self) -> u32;

    /// Where it works.
    fn processor(&self) -> Processor;

    /// What can be set with `--set KEY=VALUE`.
    fn parameters(&self) -> &'static [ParameterInfo];

    /// What [`Run::counters`] may return, in its order.
    fn counters(&self) -> &'static [CounterInfo];

    /// The parameter that time and accuracy depend on; `None` where there is none: such a method runs once
    /// under any budget, and its time is what it is.
    fn cost(&self) -> Option<Cost>;

    /// Of the last segment, where nobody says: what its source computes.
    fn visibility(&self) -> Visibility;

    /// Whether the picture after every step estimates the final one, so that one run gives a whole
    /// curve of error against time. It has a cost then, a count, the one that [`Progress`] tells of.
    fn is_progressive(&self) -> bool;

    /// Whether chance has a part in the picture: then another [`Frame::seed`] gives another one. Else all
    /// seeds give the same, bit for bit.
    fn is_random(&self) -> bool {
        true
    }

    /// How it bakes what further frames reuse; `None` where there is nothing.
    fn baking(&self) -> Option<&dyn Baking> {
        None
    }

    /// Checks that the method can make this picture and sets up what does not depend on the amount
    /// of work: pipelines, acceleration structures. A method that bakes does so, for this one frame.
    ///
    /// # Errors
    /// [`Error::Declined`] with a reason where the scene or transport is not the method's.
    fn prepare<'a>(
        &self,
        frame: &Frame<'a>,
        parameters: &Parameters,
    ) -> Result<Box<dyn Run + 'a>, Error>;
}

/// One picture in the making.
pub trait Run {
    /// Does the next slice of work and waits for its end.
    ///
    /// # Errors
    /// [`Error::Failed`] where the device gave up.
    fn step(&mut self) -> Result<Progress, Error>;

    /// The picture of the work done so far. May be called after any step.
    ///
    /// # Errors
    /// [`Error::Failed`] where the device gave up.
    fn resolve(&mut self) -> Result<RadianceImage, Error>;

    /// What the run has counted: of [`Method::counters`] those that its parameters have a use for, always the same.
    fn counters(&self) -> Vec<(&'static str, u64)>;

    /// The time of each pass so far.
    fn pass_times(&self) -> Vec<PassTime>;
}
