//! Radiance of pixels from a grid of coefficients, on the adapter.

use manylights_gpu::{Buffer, Error, Gpu, Pass, PassTime, Resource, workgroups};

use crate::shader::{LANES, Shader};
use crate::sorted::Sorted;
use crate::view::View;
use crate::{Pixels, Settings};

/// Radiance of pixels from a grid of coefficients, on the adapter.
pub struct Reading {
    gpu: Gpu,
    way: Way,
}

enum Way {
    Plain { pass: Pass, workgroups: [u32; 3], outside: Buffer },
    Sorted(Sorted),
}

impl Reading {
    /// Of `coefficients` as [`Settings::vectors`] has them.
    ///
    /// # Errors
    /// Where the adapter refuses a kernel or a buffer.
    pub fn new(
        gpu: &Gpu,
        settings: &Settings,
        coefficients: &Buffer,
        pixels: &Pixels<'_>,
    ) -> Result<Self, Error> {
        let view = gpu.uniform("view", &View::new(&settings.grid, pixels))?;
        let way = if settings.is_sorted() {
            Way::Sorted(Sorted::new(gpu, settings, [&view, coefficients], pixels)?)
        } else {
            let outside = gpu.zeroed("pixels outside", 4)?;
            let kernel = Shader::read(settings)?.compile(gpu)?;
            let Pixels { surfaces, results, tables, count, .. } = *pixels;
            let own = [&view, surfaces, results, &outside, coefficients];
            let resources: Vec<_> = own.into_iter().chain(tables).map(Resource::Buffer).collect();
            let pass = gpu.pass("read", &kernel, &resources)?;
            Way::Plain { pass, workgroups: workgroups(count, LANES), outside }
        };
        Ok(Self { gpu: gpu.clone(), way })
    }

    /// Adds what all pixels reflect of the grid, and waits.
    ///
    /// # Errors
    /// Where the device gave up, or refuses a buffer.
    pub fn add(&mut self) -> Result<Vec<PassTime>, Error> {
        match &mut self.way {
            Way::Plain { pass, workgroups, .. } => self.gpu.run(&[pass.over(*workgroups)]),
            Way::Sorted(sorted) => sorted.add(&self.gpu),
        }
    }

    /// Says that the surfaces of the pixels have changed: they are sorted again.
    pub fn move_surfaces(&mut self) {
        if let Way::Sorted(sorted) = &mut self.way {
            sorted.forget_order();
        }
    }

    /// How often a pixel was read whose point is outside of the grid: the nearest point of the grid stands for it.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn outside(&self) -> Result<u32, Error> {
        match &self.way {
            Way::Plain { outside, .. } => Ok(self.gpu.read::<u32>(outside)?[0]),
            Way::Sorted(sorted) => Ok(sorted.outside()),
        }
    }
}
