//! One run of a method, by the clock.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use manylights_method::{Bake, Error, Frame, Method, Parameters, Progress, Run};
use manylights_metrics::RadianceImage;

use crate::measurement::bakes::BakeCost;

/// What came out of a run.
pub(crate) struct MeasuredRun {
    /// The picture.
    pub(crate) image: RadianceImage,
    /// Of what it was baked from.
    pub(crate) bake: BakeCost,
    /// Wall clock of `prepare`: pipelines, acceleration structures.
    pub(crate) prepare_seconds: f64,
    /// Wall clock of all steps. Read-back, metrics and files are outside.
    pub(crate) step_seconds: f64,
    /// By the processor's own clock.
    pub(crate) pass_seconds: BTreeMap<String, f64>,
    /// What the method counted.
    pub(crate) counters: BTreeMap<String, u64>,
}

/// Called after each step with the clock off: how far the run is, the seconds of its work so far, and
/// the run to look at.
pub(crate) type Look<'l> = &'l mut dyn FnMut(Progress, f64, &mut dyn Run) -> Result<(), Error>;

/// Prepares, with a bake where the method makes one, steps to the end and resolves.
///
/// # Errors
/// Those of the method.
pub(crate) fn measure(
    method: &dyn Method,
    frame: &Frame<'_>,
    parameters: &Parameters,
    bake: Option<(&dyn Bake, BakeCost)>,
    look: Look<'_>,
) -> Result<MeasuredRun, Error> {
    let clock = Instant::now();
    let mut run = match &bake {
        Some((bake, _)) => bake.prepare(frame, parameters)?,
        None => method.prepare(frame, parameters)?,
    };
    let prepare_seconds = clock.elapsed().as_secs_f64();
    let step_seconds = step_to_the_end(run.as_mut(), look)?.as_secs_f64();
    let image = run.resolve()?;
    Ok(MeasuredRun {
        image,
        bake: bake.map_or_else(BakeCost::default, |(_, cost)| cost),
        prepare_seconds,
        step_seconds,
        pass_seconds: run
            .pass_times()
            .into_iter()
            .map(|t| (t.pass.to_owned(), t.seconds))
            .collect(),
        counters: run.counters().into_iter().map(|(name, n)| (name.to_owned(), n)).collect(),
    })
}

fn step_to_the_end(run: &mut dyn Run, look: Look<'_>) -> Result<Duration, Error> {
    let mut elapsed = Duration::ZERO;
    loop {
        let clock = Instant::now();
        let progress = run.step()?;
        elapsed += clock.elapsed();
        look(progress, elapsed.as_secs_f64(), run)?;
        if progress.finished() {
            return Ok(elapsed);
        }
    }
}
