//! One picture in the making: lights are placed in the first step, then gathered batch by batch.

use manylights_gpu::{GpuFrame, distribute};
use manylights_method::{Error, PassTime, Progress, Run};
use manylights_metrics::RadianceImage;
use manylights_scene::Scene;

use crate::Settings;
use crate::gather::{Batches, Gather, LAMBERT_CAPACITY};

/// Pairs of light and pixel in one submission: about a second on a slow processor, far below any
/// watchdog on a fast one.
const PAIRS_A_STEP: u64 = 1 << 28;

pub(crate) struct VplRun<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) frame: &'a GpuFrame,
    pub(crate) settings: Settings,
    pub(crate) seed: u64,
    pub(crate) gather: Gather,
    pub(crate) placed: Option<Placed>,
    pub(crate) times: Vec<PassTime>,
}

/// The lights on the adapter and how many batches are summed.
pub(crate) struct Placed {
    batches: Batches,
    next: usize,
    done: u64,
    total: u64,
}

impl VplRun<'_> {
    fn place(&mut self) -> Result<Placed, Error> {
        let (lights, times) = distribute(self.frame, self.scene, self.settings.lights, self.seed)?;
        self.add_times(&times, "distribute");
        let batches = Batches::new(self.frame.gpu(), &lights)?;
        Ok(Placed { batches, next: 0, done: 0, total: lights.len() as u64 })
    }

    /// Adds adapter times under one pass name.
    fn add_times(&mut self, times: &[manylights_gpu::PassTime], pass: &'static str) {
        let seconds: f64 = times.iter().map(|time| time.seconds).sum();
        match self.times.iter_mut().find(|time| time.pass == pass) {
            Some(time) => time.seconds += seconds,
            None => self.times.push(PassTime { pass, seconds }),
        }
    }
}

impl Run for VplRun<'_> {
    fn step(&mut self) -> Result<Progress, Error> {
        let mut placed = match self.placed.take() {
            Some(placed) => placed,
            None => self.place()?,
        };
        let [width, height] = self.frame.resolution().map(u64::from);
        let batches = (PAIRS_A_STEP / (width * height * LAMBERT_CAPACITY as u64)).max(1) as usize;
        let end = (placed.next + batches).min(placed.batches.len());
        let range = placed.next..end;
        let times = self.gather.add(self.frame.surfaces(), &placed.batches, range.clone())?;
        placed.done += placed.batches.lights(range);
        placed.next = end;
        let progress = Progress { done: placed.done, total: placed.total };
        self.placed = Some(placed);
        self.add_times(&times, "gather");
        Ok(progress)
    }

    fn resolve(&mut self) -> Result<RadianceImage, Error> {
        let [width, height] = self.frame.resolution();
        Ok(RadianceImage { width, height, pixels: self.gather.radiance()? })
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        vec![("lights", self.placed.as_ref().map_or(0, |placed| placed.done))]
    }

    fn pass_times(&self) -> Vec<PassTime> {
        self.times.clone()
    }
}
