//! One picture in the making: lights are placed in the first step, then gathered batch by batch.

use manylights_gpu::{GpuFrame, lit_maps, radii};
use manylights_method::{Error, PassTime, Progress, Run};
use manylights_metrics::RadianceImage;
use manylights_scene::Scene;

use crate::gather::{Batches, CAPACITY, Gather};
use crate::light_record::SphericalLight;
use crate::{Sampling, Settings};

/// Directions in one submission: about a second on a slow processor, far below any watchdog on a fast
/// one.
const DIRECTIONS_A_STEP: u64 = 1 << 26;

pub(crate) struct VslRun<'a> {
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

/// The lights that a picture uses, and the passes that made them.
///
/// # Errors
/// Where the maps exceed what the adapter holds.
pub fn spherical_lights(
    frame: &GpuFrame,
    scene: &Scene,
    settings: &Settings,
    seed: u64,
) -> Result<(Vec<SphericalLight>, Vec<manylights_gpu::PassTime>), manylights_gpu::Error> {
    let (maps, mut times) = lit_maps(frame, scene, settings.lights, seed)?;
    for time in &mut times {
        time.pass = "distribute";
    }
    let (radii, time) = radii(scene, &maps, settings.radius);
    times.push(time);
    let lights = maps.into_iter().flat_map(|map| map.lights).flatten();
    let sphere = |(light, radius)| SphericalLight { light, radius: settings.scale * radius };
    Ok((lights.zip(radii).map(sphere).collect(), times))
}

impl VslRun<'_> {
    fn place(&mut self) -> Result<Placed, Error> {
        let (lights, times) = spherical_lights(self.frame, self.scene, &self.settings, self.seed)?;
        self.add_times(&times);
        let batches = Batches::new(self.frame.gpu(), &lights, self.seed)?;
        Ok(Placed { batches, next: 0, done: 0, total: lights.len() as u64 })
    }

    fn add_times(&mut self, times: &[manylights_gpu::PassTime]) {
        for &manylights_gpu::PassTime { pass, seconds } in times {
            match self.times.iter_mut().find(|time| time.pass == pass) {
                Some(time) => time.seconds += seconds,
                None => self.times.push(PassTime { pass, seconds }),
            }
        }
    }

    fn batches_a_step(&self) -> usize {
        let [width, height] = self.frame.resolution().map(u64::from);
        let strategies = if self.settings.sampling == Sampling::Both { 2 } else { 1 };
        let directions = CAPACITY as u64 * strategies * u64::from(self.settings.samples);
        (DIRECTIONS_A_STEP / (width * height * directions)).max(1) as usize
    }
}

impl Run for VslRun<'_> {
    fn step(&mut self) -> Result<Progress, Error> {
        let mut placed = match self.placed.take() {
            Some(placed) => placed,
            None => self.place()?,
        };
        let end = (placed.next + self.batches_a_step()).min(placed.batches.len());
        let range = placed.next..end;
        let times = self.gather.add(self.frame.surfaces(), &placed.batches, range.clone())?;
        placed.done += placed.batches.lights(range);
        placed.next = end;
        let progress = Progress { done: placed.done, total: placed.total };
        self.placed = Some(placed);
        self.add_times(&times);
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
