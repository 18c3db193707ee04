//! What further frames of a variant reuse: tables of a scene's materials, coefficients on a grid,
//! records of a cache.
//!
//! A bake has a clock of its own, and nothing hides it: the harness bakes once for each change of what
//! the method depends on, by the clock, and tells the time beside that of every frame that the bake
//! served. What the method keeps elsewhere, in a process-wide cache say, would be missing there; only
//! compiled pipelines may stay. Drivers compile them at the first dispatch, so that a bake on the adapter
//! ([`Baking::processor`]) is made once before, without the clock, and thrown away.

use crate::{CounterInfo, Error, Frame, Parameters, PassTime, Processor, Run};

/// What a bake depends on, beside all parameters but the method's cost and beside transport and
/// resolution. The default is nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dependencies {
    /// Triangles, materials, textures; not what they emit.
    pub scene: bool,
    /// Primary lights, emissive triangles among them.
    pub lights: bool,
    /// The camera: the bake of one is grown for the next ([`Bake::grow`]), in the order in which they
    /// are listed.
    pub camera: bool,
    /// [`Frame::seed`].
    pub seed: bool,
    /// The value of the method's cost parameter.
    pub amount: bool,
}

/// How a method bakes.
pub trait Baking: Sync {
    /// What it must be baked again for, with these parameters.
    fn depends_on(&self, parameters: &Parameters) -> Dependencies;

    /// Where the bake is made with these parameters, which need not be where frames are.
    fn processor(&self, parameters: &Parameters) -> Processor;

    /// What [`Bake::counters`] returns, in its order.
    fn counters(&self) -> &'static [CounterInfo];

    /// Bakes for a frame and waits for the end of it.
    ///
    /// # Errors
    /// [`Error::Declined`] with a reason where the scene or transport is not the method's.
    fn bake(&self, frame: &Frame<'_>, parameters: &Parameters) -> Result<Box<dyn Bake>, Error>;
}

/// What was baked.
pub trait Bake {
    /// Adds what the frame's camera needs to what earlier ones left; all else is as it was. Called where
    /// [`Dependencies::camera`] is declared.
    ///
    /// # Errors
    /// [`Error::Failed`] where the device gave up.
    fn grow(&mut self, frame: &Frame<'_>, parameters: &Parameters) -> Result<(), Error> {
        let _ = (frame, parameters);
        Ok(())
    }

    /// As [`Method::prepare`](crate::Method::prepare), with what was baked. The run shares what it needs
    /// of it: a bake may grow or go meanwhile.
    ///
    /// # Errors
    /// [`Error::Declined`] with a reason where the scene or transport is not the method's.
    fn prepare<'a>(
        &self,
        frame: &Frame<'a>,
        parameters: &Parameters,
    ) -> Result<Box<dyn Run + 'a>, Error>;

    /// What the bake has counted so far, one number for each of [`Baking::counters`].
    fn counters(&self) -> Vec<(&'static str, u64)>;

    /// The time of each of its passes so far, by the processor's own clock.
    fn pass_times(&self) -> Vec<PassTime>;
}
