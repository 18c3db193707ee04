//! A picture in the making.

use std::time::Instant;

use bytemuck::Pod;
use manylights_gpu::GpuFrame;
use manylights_method::{Error, PassTime, PassTimes, Progress, Run};
use manylights_metrics::RadianceImage;

use crate::gather::{AreaGather, LightBatches};

/// Products of coefficients in one submission, light by pixel, where a batch has fewer; a batch is never
/// cut. About a second on a slow processor, far below any watchdog on a fast one.
const PRODUCTS_A_STEP: u64 = 1 << 31;

/// Lights are laid out in the first step, then gathered batch by batch.
pub struct AreaLightRun<'a, L> {
    frame: &'a GpuFrame,
    gather: AreaGather,
    lights: Vec<L>,
    batches_a_step: usize,
    placed: Option<LightBatches>,
    next: usize,
    times: PassTimes,
}

impl<'a, L: Pod> AreaLightRun<'a, L> {
    /// `products` of coefficients are what a pixel and a light take, about.
    pub fn new(frame: &'a GpuFrame, gather: AreaGather, lights: Vec<L>, products: usize) -> Self {
        let [width, height] = frame.resolution().map(u64::from);
        let products_a_batch = width * height * (gather.capacity() * products) as u64;
        let batches_a_step = (PRODUCTS_A_STEP / products_a_batch.max(1)).max(1) as usize;
        let times = PassTimes::default();
        Self { frame, gather, lights, batches_a_step, placed: None, next: 0, times }
    }
}

impl<L: Pod> Run for AreaLightRun<'_, L> {
    fn step(&mut self) -> Result<Progress, Error> {
        let start = Instant::now();
        let batches = match self.placed.take() {
            Some(batches) => batches,
            None => {
                let batches = self.gather.batches(&self.lights)?;
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
        let [done, total] = [end, batches.count()].map(|end| batches.lights(end));
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

    fn counters(&self) -> Vec<(&'static str, u64)> {
        let done = self.placed.as_ref().map_or(0, |batches| batches.lights(self.next));
        vec![("lights", done)]
    }

    fn pass_times(&self) -> Vec<PassTime> {
        self.times.list()
    }
}
