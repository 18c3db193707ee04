//! What methods that gather virtual lights have in common, but for the estimator.

use manylights_gpu::{GpuFrame, LightBatches, LightGather, Shadows};
use manylights_metrics::RadianceImage;

use crate::{Error, Frame, PassTime, Progress, Run, Transport, Visibility};

/// The frame on the adapter, where it is one that virtual lights can render (one indirect bounce of
/// point-like primary lights), and the shadow rays that the transport wants.
///
/// # Errors
/// [`Error::Declined`] with the reason.
pub fn many_light_frame<'a>(frame: &Frame<'a>) -> Result<(&'a GpuFrame, Option<Shadows>), Error> {
    let declined = |reason: &str| Err(Error::Declined(reason.to_owned()));
    let Transport::Indirect { bounces: 1, visibility } = frame.transport else {
        return declined("computes one indirect bounce: use --transport indirect-1");
    };
    if frame.scene.emissive_triangles().next().is_some() {
        return declined("needs point-like primary lights; this scene has emissive triangles");
    }
    if frame.scene.lights.is_empty() {
        return declined("needs a point, spot or directional light; this scene has none");
    }
    let Some(on_gpu) = frame.gpu else {
        return Err(Error::Failed("runs on the adapter and was given none".into()));
    };
    let shadows = match visibility {
        Visibility::Traced => Some(Shadows::new(on_gpu, frame.scene)?),
        Visibility::Ignored => None,
    };
    Ok((on_gpu, shadows))
}

/// The lights of a picture on the adapter, and the passes that placed them there.
pub type PlacedLights =
    Result<(LightBatches, Vec<manylights_gpu::PassTime>), manylights_gpu::Error>;

/// A picture in the making: lights are placed in the first step, then gathered batch by batch.
pub struct ManyLightRun<'a> {
    frame: &'a GpuFrame,
    gather: LightGather,
    batches_a_step: usize,
    place: Box<dyn Fn(&LightGather) -> PlacedLights + 'a>,
    placed: Option<LightBatches>,
    next: usize,
    times: Vec<PassTime>,
}

impl<'a> ManyLightRun<'a> {
    /// `place` makes the lights, inside the clock; `batches_a_step` of them are gathered in one
    /// submission, at least one.
    pub fn new(
        frame: &'a GpuFrame,
        gather: LightGather,
        batches_a_step: usize,
        place: impl Fn(&LightGather) -> PlacedLights + 'a,
    ) -> Self {
        let most = gather.traced_batches().unwrap_or(usize::MAX);
        Self {
            frame,
            gather,
            batches_a_step: batches_a_step.clamp(1, most),
            place: Box::new(place),
            placed: None,
            next: 0,
            times: Vec::new(),
        }
    }

    /// Adds up the times of passes of one name.
    fn add_times(&mut self, times: &[manylights_gpu::PassTime]) {
        for &manylights_gpu::PassTime { pass, seconds } in times {
            match self.times.iter_mut().find(|time| time.pass == pass) {
                Some(time) => time.seconds += seconds,
                None => self.times.push(PassTime { pass, seconds }),
            }
        }
    }
}

impl Run for ManyLightRun<'_> {
    fn step(&mut self) -> Result<Progress, Error> {
        let batches = match self.placed.take() {
            Some(batches) => batches,
            None => {
                let (batches, times) = (self.place)(&self.gather)?;
                self.add_times(&times);
                batches
            }
        };
        let end = (self.next + self.batches_a_step).min(batches.count());
        let times = self.gather.add(self.frame.surfaces(), &batches, self.next..end)?;
        self.add_times(&times);
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
        self.times.clone()
    }
}
