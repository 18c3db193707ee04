//! A picture in the making.

use std::time::Instant;

use bytemuck::Pod;
use manylights_gpu::GpuFrame;
use manylights_harmonics::even_count;
use manylights_method::{Error, PassTime, PassTimes, Progress, Run};
use manylights_metrics::RadianceImage;
use manylights_reflectance::ReceiverKinds;

use crate::gather::{AreaGather, LightBatches};

/// Operations in one submission, where a batch has fewer; a batch is never cut. Below a second on a slow processor,
/// far below any watchdog on a fast one.
const OPERATIONS_A_STEP: u64 = 1 << 33;

/// What a cap of light and a receiver's lobes in so many bands take, about.
pub fn cap_operations(kinds: ReceiverKinds, bands: usize) -> usize {
    // Legendre's polynomials, or the basis and a product for each lobe.
    80 + if kinds.specular { even_count(bands) * (6 + 2 * kinds.channels()) } else { 5 * bands }
}

/// What a triangle and a narrow lobe as a transformed cosine take, or a sphere, about.
pub const TRANSFORMED_OPERATIONS: usize = 600;

/// What the shader reads of the lights is laid out in the first step, then gathered batch by batch.
pub struct AreaLightRun<'a, R> {
    frame: &'a GpuFrame,
    gather: AreaGather,
    records: Vec<R>,
    lights: u64,
    batches_a_step: usize,
    placed: Option<LightBatches>,
    next: usize,
    times: PassTimes,
}

impl<'a, R: Pod> AreaLightRun<'a, R> {
    /// Over the `records` of so many `lights`. `operations` are what a pixel and a record take, about, as
    /// [`manylights_gpu::operations`] counts them.
    pub fn new(
        frame: &'a GpuFrame,
        gather: AreaGather,
        (records, lights): (Vec<R>, usize),
        operations: usize,
    ) -> Self {
        let [width, height] = frame.resolution().map(u64::from);
        let a_batch = width * height * (gather.capacity() * operations) as u64;
        let batches_a_step = (OPERATIONS_A_STEP / a_batch.max(1)).max(1) as usize;
        let (lights, times) = (lights as u64, PassTimes::default());
        Self { frame, gather, records, lights, batches_a_step, placed: None, next: 0, times }
    }
}

impl<R: Pod> Run for AreaLightRun<'_, R> {
    fn step(&mut self) -> Result<Progress, Error> {
        let start = Instant::now();
        let batches = match self.placed.take() {
            Some(batches) => batches,
            None => {
                let batches = self.gather.batches(&self.records)?;
                self.times.add(&[], "upload", start);
                batches
            }
        };
        let start = Instant::now();
        let end = batches.count().min(self.next + self.batches_a_step);
        let times = self.gather.add(&batches, self.next..end)?;
        // Passes encoded, submitted and waited for.
        self.times.add(&times, "submit", start);
        self.next = end;
        let [done, total] = [end, batches.count()].map(|end| batches.records(end));
        self.placed = Some(batches);
        Ok(Progress { done, total })
    }

    /// A pixel whose sum is negative, which no radiance is, is shown as 0.
    fn resolve(&mut self) -> Result<RadianceImage, Error> {
        let [width, height] = self.frame.resolution();
        let mut pixels = self.gather.radiance()?;
        // Truncated expansions may sum to less than no light. `max` would hide what is not a number.
        for value in pixels.as_flattened_mut().iter_mut().filter(|value| **value < 0.0) {
            *value = 0.0;
        }
        Ok(RadianceImage { width, height, pixels })
    }

    /// All lights from the last step on: before it, what lights share may be missing of any.
    fn counters(&self) -> Vec<(&'static str, u64)> {
        let done = self.placed.as_ref().is_some_and(|batches| self.next == batches.count());
        vec![("lights", if done { self.lights } else { 0 })]
    }

    fn pass_times(&self) -> Vec<PassTime> {
        self.times.list()
    }
}
