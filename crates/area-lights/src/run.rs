//! A picture in the making.

use std::time::Instant;

use manylights_gpu::{Buffer, GpuFrame};
use manylights_harmonics::even_count;
use manylights_interpolation::{LightGrid, Pixels, Reading};
use manylights_method::{CounterInfo, Error, PassTime, PassTimes, Progress, Run};
use manylights_metrics::RadianceImage;
use manylights_reflectance::{Materials, ReceiverKinds};

use crate::estimator::Gathering;
use crate::frame::AreaLightFrame;
use crate::gather::{AreaGather, LightBatches, LightRecords};

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

const LIGHTS: CounterInfo = CounterInfo { name: "lights", help: "that were gathered" };
const NEAR_LIGHTS: CounterInfo = CounterInfo {
    name: "near_lights",
    help: "met at each pixel, since they are within two cells of the grid",
};
const SMOOTHED_LIGHTS: CounterInfo = CounterInfo {
    name: "smoothed_lights",
    help: "held by the grid as discs, since they are within two cells of it",
};
const PIXELS_OUTSIDE: CounterInfo =
    CounterInfo { name: "pixels_outside", help: "of the grid, for which its nearest point stands" };

/// What every run counts.
pub(crate) const COUNTERS: [CounterInfo; 1] = [LIGHTS];

/// What runs may count whose lights a grid may hold.
pub(crate) const GRID_COUNTERS: [CounterInfo; 4] =
    [LIGHTS, NEAR_LIGHTS, SMOOTHED_LIGHTS, PIXELS_OUTSIDE];

/// A grid is read first, where there is one. Then what the shader reads of the other lights is laid out and gathered
/// batch by batch.
pub(crate) struct AreaLightRun<'a> {
    frame: &'a GpuFrame,
    gather: AreaGather,
    records: Box<dyn LightRecords>,
    lights: u64,
    batches_a_step: usize,
    placed: Option<LightBatches>,
    next: usize,
    grid: Option<GridPart>,
    times: PassTimes,
}

/// What a grid holds of a picture.
struct GridPart {
    reading: Reading,
    /// Lights that it does not hold.
    near: u64,
    /// Near ones that it holds, where it does.
    smoothed: Option<usize>,
    is_read: bool,
    outside: u32,
}

impl<'a> AreaLightRun<'a> {
    /// Of what a grid holds, and of the lights that `gathering` has.
    pub(crate) fn new(
        frame: &AreaLightFrame<'a>,
        tables: &[Buffer],
        gathering: Gathering,
        grid: Option<&LightGrid>,
    ) -> Result<Self, Error> {
        let Gathering { shader, records, operations } = gathering;
        let AreaLightFrame { scene, eye, on_gpu, pixels, ref lights } = *frame;
        let (gpu, surfaces) = (on_gpu.gpu(), on_gpu.surfaces());
        let gather = AreaGather::new(gpu, (surfaces, pixels), eye, &shader, tables.to_vec())?;
        let grid = grid.map(|grid| -> Result<_, Error> {
            let kinds = Materials::of_scene(scene).kinds();
            let results = gather.results();
            let pixels = Pixels { surfaces, count: pixels, camera: eye, tables, results };
            let reading = grid.reading(gpu, kinds, &pixels)?;
            let near = grid.near().len() as u64;
            let smoothed = grid.smoothed();
            Ok(GridPart { reading, near, smoothed, is_read: false, outside: 0 })
        });
        let a_batch = u64::from(pixels) * (gather.capacity() * operations) as u64;
        Ok(Self {
            frame: on_gpu,
            batches_a_step: (OPERATIONS_A_STEP / a_batch.max(1)).max(1) as usize,
            gather,
            records,
            lights: lights.len() as u64,
            placed: None,
            next: 0,
            grid: grid.transpose()?,
            times: PassTimes::default(),
        })
    }

    /// Adds the next batches.
    fn gather(&mut self) -> Result<Progress, Error> {
        let start = Instant::now();
        let batches = match self.placed.take() {
            Some(batches) => batches,
            None => {
                let batches = self.records.batches(&self.gather)?;
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
}

impl GridPart {
    fn read(&mut self, times: &mut PassTimes) -> Result<(), Error> {
        let start = Instant::now();
        let passes = self.reading.add()?;
        self.outside = self.reading.outside()?;
        times.add(&passes, "submit reading", start);
        self.is_read = true;
        Ok(())
    }
}

impl Run for AreaLightRun<'_> {
    fn step(&mut self) -> Result<Progress, Error> {
        let Some(grid) = &mut self.grid else { return self.gather() };
        if !grid.is_read {
            grid.read(&mut self.times)?;
            // Without near lights the end: a gather takes the time of every pixel's lobe.
            return Ok(Progress { done: 1, total: 1 + grid.near });
        }
        let Progress { done, total } = self.gather()?;
        Ok(Progress { done: 1 + done, total: 1 + total })
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
        let gathered = self.placed.as_ref().is_some_and(|batches| self.next == batches.count());
        let done = match &self.grid {
            None => gathered,
            Some(grid) => grid.is_read && (gathered || grid.near == 0),
        };
        let lights = (LIGHTS.name, if done { self.lights } else { 0 });
        let Some(grid) = &self.grid else { return vec![lights] };
        let near = match grid.smoothed {
            Some(smoothed) => (SMOOTHED_LIGHTS.name, smoothed as u64),
            None => (NEAR_LIGHTS.name, grid.near),
        };
        vec![lights, near, (PIXELS_OUTSIDE.name, grid.outside.into())]
    }

    fn pass_times(&self) -> Vec<PassTime> {
        self.times.list()
    }
}
