//! The lights of a picture that a grid holds, and those that it does not.

use std::time::Instant;

use manylights_gpu::{Buffer, Error, Gpu, PassTime};
use manylights_method::PassTimes;
use manylights_reflectance::ReceiverKinds;
use manylights_scene::{AreaLight, Scene};

use crate::{
    Grid, GridCoefficients, Interpolation, Near, Pixels, Reach, Reading, Settings, Storage, pack,
};

/// Coefficients of the lights that are far from the vertices of a grid, on the adapter, and the others.
pub struct LightGrid {
    how: Interpolation,
    /// As `how` stores them.
    coefficients: GridCoefficients,
    near: Vec<AreaLight>,
    smoothed: usize,
    times: PassTimes,
}

/// A picture to be baked for.
pub struct Lit<'a> {
    /// The adapter.
    pub gpu: &'a Gpu,
    /// What is lit.
    pub scene: &'a Scene,
    /// What pixels see, the first so many of them.
    pub surfaces: (&'a Buffer, u32),
    /// By what.
    pub lights: &'a [AreaLight],
}

/// What a grid holds.
pub struct Held<'a> {
    /// As they are.
    pub far: &'a [AreaLight],
    /// Smoothed.
    pub near: &'a [AreaLight],
}

impl LightGrid {
    /// `project` makes coefficients of lights at the vertices of a grid.
    ///
    /// # Errors
    /// Those of `project`, and where the device gave up.
    pub fn new(
        how: Interpolation,
        lit: &Lit<'_>,
        project: impl Fn(Grid<f32>, &Held<'_>) -> Result<(GridCoefficients, Vec<PassTime>), Error>,
    ) -> Result<Self, Error> {
        let start = Instant::now();
        let grid = how.grid(lit.gpu, lit.scene, lit.surfaces)?;
        let reach = Reach::new(&grid);
        let (near, far): (Vec<_>, Vec<_>) =
            lit.lights.iter().copied().partition(|light| reach.meets(light));
        let (near, smoothed) = match how.near {
            Near::Apart => (near, Vec::new()),
            Near::Smoothed => (Vec::new(), near),
        };
        let (mut coefficients, mut passes) = project(grid, &Held { far: &far, near: &smoothed })?;
        if how.storage == Storage::Packed {
            let (packed, pass) = pack(lit.gpu, &coefficients)?;
            coefficients.buffer = packed;
            passes.extend(pass);
        }
        let mut times = PassTimes::default();
        times.add(&passes, "prepare grid", start);
        Ok(Self { how, coefficients, near, smoothed: smoothed.len(), times })
    }

    /// Lights that must be met at each pixel.
    pub fn near(&self) -> &[AreaLight] {
        &self.near
    }

    /// Near lights that the grid holds smoothed; `None` where it holds none of them.
    pub fn smoothed(&self) -> Option<usize> {
        (self.how.near == Near::Smoothed).then_some(self.smoothed)
    }

    /// The time of each pass.
    pub fn pass_times(&self) -> Vec<PassTime> {
        self.times.list()
    }

    /// Takes over the time that this grid's forerunner took.
    pub fn follow(&mut self, before: &Self) {
        self.times.merge(&before.times);
    }

    /// What a picture reads of it.
    ///
    /// # Errors
    /// Where the adapter refuses a kernel or a buffer.
    pub fn reading(
        &self,
        gpu: &Gpu,
        kinds: ReceiverKinds,
        pixels: &Pixels<'_>,
    ) -> Result<Reading, Error> {
        let GridCoefficients { grid, bands, ref buffer, .. } = self.coefficients;
        let Interpolation { scheme, order, storage, .. } = self.how;
        let settings = Settings { grid, scheme, bands, kinds, order, storage };
        Reading::new(gpu, &settings, buffer, pixels)
    }
}
