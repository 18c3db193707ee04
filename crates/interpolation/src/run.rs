//! A picture of lights that a grid holds and of lights near it.

use std::time::Instant;

use manylights_method::{CounterInfo, Error, PassTime, PassTimes, Progress, Run};
use manylights_metrics::RadianceImage;

use crate::Reading;

/// What such runs count beside the lights.
pub const COUNTERS: [CounterInfo; 2] = [
    CounterInfo {
        name: "near_lights",
        help: "met at each pixel, since they are within two cells of the grid",
    },
    CounterInfo { name: "pixels_outside", help: "of the grid, for which its nearest point stands" },
];

/// The lights near the grid gathered, then the grid read.
pub struct InterpolatedRun<'a> {
    /// Whose first counter is the number of lights.
    gather: Box<dyn Run + 'a>,
    grid: Option<GridPart>,
}

/// What a grid holds of a picture.
pub struct GridPart {
    reading: Reading,
    lights: usize,
    /// Of those that are gathered.
    near: usize,
    is_read: bool,
    outside: u32,
    times: PassTimes,
}

impl GridPart {
    /// Of so many lights, `near` of which are gathered; what is read is added to the gather's results.
    pub fn new(reading: Reading, lights: usize, near: usize) -> Self {
        let times = PassTimes::default();
        Self { reading, lights, near, is_read: false, outside: 0, times }
    }

    fn read(&mut self) -> Result<(), Error> {
        let start = Instant::now();
        let times = self.reading.add()?;
        self.outside = self.reading.outside()?;
        self.times.add(&times, "submit reading", start);
        self.is_read = true;
        Ok(())
    }
}

impl<'a> InterpolatedRun<'a> {
    /// Of a gather of the lights near a grid, or of all where there is none.
    pub fn new(gather: Box<dyn Run + 'a>, grid: Option<GridPart>) -> Self {
        Self { gather, grid }
    }
}

impl Run for InterpolatedRun<'_> {
    fn step(&mut self) -> Result<Progress, Error> {
        let Some(grid) = &mut self.grid else { return self.gather.step() };
        if !grid.is_read {
            grid.read()?;
            return Ok(Progress { done: 1, total: 1 + grid.near as u64 });
        }
        // Only where there are such lights: without, a gather takes the time of every pixel's lobe.
        let Progress { done, total } = self.gather.step()?;
        Ok(Progress { done: 1 + done, total: 1 + total })
    }

    fn resolve(&mut self) -> Result<RadianceImage, Error> {
        self.gather.resolve()
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        let mut counters = self.gather.counters();
        let (near, outside) = match &self.grid {
            None => (0, 0),
            Some(GridPart { lights, near, is_read, outside, .. }) => {
                let is_done = *is_read && counters[0].1 == *near as u64;
                counters[0].1 = if is_done { *lights as u64 } else { 0 };
                (*near as u64, u64::from(*outside))
            }
        };
        counters.extend([(COUNTERS[0].name, near), (COUNTERS[1].name, outside)]);
        counters
    }

    fn pass_times(&self) -> Vec<PassTime> {
        let mut times = self.gather.pass_times();
        times.extend(self.grid.iter().flat_map(|grid| grid.times.list()));
        times
    }
}
