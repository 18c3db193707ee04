//! The spheres of a picture that a grid holds.

use std::time::Instant;

use glam::Vec3;
use manylights_area_lights::{AreaGather, AreaLightFrame};
use manylights_gpu::Buffer;
use manylights_interpolation::{
    self as interpolation, GridCoefficients, GridPart, Interpolation, Pixels, Reach, Reading,
    project,
};
use manylights_method::{Error, PassTime, PassTimes};
use manylights_reflectance::ReceiverKinds;

use crate::{Settings, SphereLight, linked_projection};

/// Coefficients of the spheres that are far from the grid's vertices, on the adapter, and the others.
pub(crate) struct LightGrid {
    how: Interpolation,
    coefficients: GridCoefficients,
    /// Lights that the grid does not hold.
    pub(crate) near: Vec<SphereLight>,
    times: PassTimes,
}

impl LightGrid {
    pub(crate) fn new(
        frame: &AreaLightFrame<'_>,
        settings: &Settings,
        how: Interpolation,
    ) -> Result<Self, Error> {
        let mut times = PassTimes::default();
        let (coefficients, near) = projected(frame, settings, how, &mut times)?;
        Ok(Self { how, coefficients, near, times })
    }

    /// The grid of another view.
    pub(crate) fn project(
        &mut self,
        frame: &AreaLightFrame<'_>,
        settings: &Settings,
    ) -> Result<(), Error> {
        let projected = projected(frame, settings, self.how, &mut self.times)?;
        (self.coefficients, self.near) = projected;
        Ok(())
    }

    pub(crate) fn pass_times(&self) -> Vec<PassTime> {
        self.times.list()
    }

    /// What a picture of so many lights reads of it.
    pub(crate) fn part(
        &self,
        gather: &AreaGather,
        ((surfaces, count), camera): ((&Buffer, u32), Vec3),
        kinds: ReceiverKinds,
        tables: &[Buffer],
        lights: usize,
    ) -> Result<GridPart, Error> {
        let GridCoefficients { grid, bands, ref buffer, .. } = self.coefficients;
        let Interpolation { scheme, order, .. } = self.how;
        let settings = interpolation::Settings { grid, scheme, bands, kinds, order };
        let pixels = Pixels { surfaces, count, camera, tables, results: gather.results() };
        let reading = Reading::new(gather.gpu(), &settings, buffer, &pixels)?;
        Ok(GridPart::new(reading, lights, self.near.len()))
    }
}

fn projected(
    frame: &AreaLightFrame<'_>,
    settings: &Settings,
    how: Interpolation,
    times: &mut PassTimes,
) -> Result<(GridCoefficients, Vec<SphereLight>), Error> {
    let start = Instant::now();
    let gpu = frame.on_gpu.gpu();
    let grid = how.grid(gpu, frame.scene, (frame.on_gpu.surfaces(), frame.pixels))?;
    let reach = Reach::new(&grid);
    let spheres = frame.lights.iter().filter_map(SphereLight::of);
    let (near, far): (Vec<_>, Vec<_>) = spheres
        .partition(|light| reach.meets_sphere(light.center.as_dvec3(), f64::from(light.radius)));
    let shader = linked_projection(settings, how.scheme.reads_gradients(), how.loops)?;
    let (coefficients, passes) = project(gpu, grid, &shader, &far)?;
    times.add(&passes, "prepare grid", start);
    Ok((coefficients, near))
}
