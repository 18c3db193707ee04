//! Radiance of pixels from a grid of coefficients, on the adapter.

use manylights_gpu::{Buffer, Error, Gpu, Pass, PassTime, Resource, workgroups};

use crate::shader::{LANES, Shader};
use crate::sorted::Sorted;
use crate::view::View;
use crate::{Order, Pixels, Settings};

/// Radiance of pixels from a grid of coefficients, on the adapter.
pub struct Reading {
    gpu: Gpu,
    /// Where pixels are not sorted, and where their cells have too few of them for that.
    plain: Plain,
    sorted: Option<Sorted>,
}

struct Plain {
    pass: Pass,
    workgroups: [u32; 3],
    outside: Buffer,
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
        let sorted = settings.is_sorted();
        let sorted = sorted.then(|| Sorted::new(gpu, settings, [&view, coefficients], pixels));
        let plain = Plain::new(gpu, settings, [&view, coefficients], pixels)?;
        Ok(Self { gpu: gpu.clone(), plain, sorted: sorted.transpose()? })
    }

    /// Adds what all pixels reflect of the grid, and waits.
    ///
    /// # Errors
    /// Where the device gave up, or refuses a buffer.
    pub fn add(&mut self) -> Result<Vec<PassTime>, Error> {
        let mut times = Vec::new();
        if let Some(sorted) = &mut self.sorted {
            let (sorting, is_read) = sorted.add(&self.gpu)?;
            times = sorting;
            if is_read {
                return Ok(times);
            }
        }
        let Plain { pass, workgroups, .. } = &self.plain;
        times.extend(self.gpu.run(&[pass.over(*workgroups)])?);
        Ok(times)
    }

    /// Says that the surfaces of the pixels have changed: they are sorted again.
    pub fn move_surfaces(&mut self) {
        if let Some(sorted) = &mut self.sorted {
            sorted.forget_order();
        }
    }

    /// How often a pixel was read whose point is outside of the grid by more than a thousandth of a cell: the nearest
    /// point of the grid stands for it.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn outside(&self) -> Result<u32, Error> {
        let sorted = self.sorted.as_ref().map_or(0, Sorted::outside);
        Ok(sorted + self.gpu.read::<u32>(&self.plain.outside)?[0])
    }
}

impl Plain {
    fn new(
        gpu: &Gpu,
        settings: &Settings,
        [view, coefficients]: [&Buffer; 2],
        pixels: &Pixels<'_>,
    ) -> Result<Self, Error> {
        let outside = gpu.zeroed("pixels outside", 4)?;
        let settings = Settings { order: Order::Plain, ..*settings };
        let kernel = Shader::read(&settings)?.compile(gpu)?;
        let Pixels { surfaces, results, tables, count, .. } = *pixels;
        let own = [view, surfaces, results, &outside, coefficients];
        let resources: Vec<_> = own.into_iter().chain(tables).map(Resource::Buffer).collect();
        let pass = gpu.pass("read", &kernel, &resources)?;
        Ok(Self { pass, workgroups: workgroups(count, LANES), outside })
    }
}
