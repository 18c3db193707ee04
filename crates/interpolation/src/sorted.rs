//! Pixels sorted by cell, each cell's corners in uniform memory.

use std::sync::Arc;

use manylights_gpu::{
    Buffer, Error, Gpu, Kernel, Pass, PassTime, Resource, UniformBatches, workgroups,
};

use crate::shader::{LANES, Shader};
use crate::{Pixels, Settings};

/// Blocks of cells that are held at a time.
const BLOCKS_BYTES: usize = 1 << 26;

/// Workgroups in a row, one a cell, that any adapter takes.
const MOST_CELLS: usize = 65_535;

/// What reads pixels cell by cell: their order is found at the first time.
pub(crate) struct Sorted {
    cells: [u32; 3],
    block_bytes: usize,
    pixels_a_group: u32,
    /// As [`Settings::places_of_ten_pixels`].
    places_of_ten_pixels: u64,
    workgroups: [u32; 3],
    count: Arc<Kernel>,
    scatter: Arc<Kernel>,
    assemble: Arc<Kernel>,
    read: Arc<Kernel>,
    view: Buffer,
    coefficients: Buffer,
    surfaces: Buffer,
    results: Buffer,
    tables: Vec<Buffer>,
    /// Of each pixel among those of its cell.
    places: Buffer,
    order: Option<Order>,
    outside: u32,
}

/// The pixels sorted by cell.
enum Order {
    Dense {
        layout: Layout,
        /// Their numbers.
        pixels: Buffer,
        outside: u32,
    },
    /// Cells have too few of them.
    Sparse,
}

/// Where the pixels of cells stand in the order of all.
struct Layout {
    /// Of each cell the first.
    firsts: Vec<u32>,
    /// x, y, z and the first, of each cell that has pixels.
    cells: Vec<[u32; 4]>,
    /// Of the same.
    pixels: Vec<u32>,
    /// Places in all: the pixels of each cell fill whole workgroups.
    length: u64,
}

impl Layout {
    fn new([width, height, _]: [u32; 3], counts: &[u32], pixels_a_group: u32) -> Self {
        let mut layout =
            Self { firsts: Vec::new(), cells: Vec::new(), pixels: Vec::new(), length: 0 };
        for (index, &count) in (0..).zip(counts) {
            layout.firsts.push(layout.length as u32);
            if count == 0 {
                continue;
            }
            let cell = [index % width, index / width % height, index / (width * height)];
            layout.cells.push([cell[0], cell[1], cell[2], layout.length as u32]);
            layout.pixels.push(count);
            layout.length += u64::from(count.next_multiple_of(pixels_a_group));
        }
        layout
    }

    /// Pixels that see something.
    fn seen(&self) -> u64 {
        self.pixels.iter().copied().map(u64::from).sum()
    }
}

impl Sorted {
    pub(crate) fn new(
        gpu: &Gpu,
        settings: &Settings,
        [view, coefficients]: [&Buffer; 2],
        pixels: &Pixels<'_>,
    ) -> Result<Self, Error> {
        let block_bytes = settings.block_bytes();
        let stride = UniformBatches::zeroed(gpu, "cells", block_bytes, 1)?.stride();
        Ok(Self {
            cells: settings.grid.vertices.map(|vertices| vertices as u32 - 1),
            block_bytes,
            pixels_a_group: LANES * settings.pixels_a_lane() as u32,
            places_of_ten_pixels: settings.places_of_ten_pixels(),
            workgroups: workgroups(pixels.count, LANES),
            count: Shader::count(settings)?.compile(gpu)?,
            scatter: Shader::scatter(settings)?.compile(gpu)?,
            assemble: Shader::assemble(settings, stride / 16)?.compile(gpu)?,
            read: Shader::read(settings)?.compile(gpu)?,
            view: view.clone(),
            coefficients: coefficients.clone(),
            surfaces: pixels.surfaces.clone(),
            results: pixels.results.clone(),
            tables: pixels.tables.to_vec(),
            places: gpu.zeroed("places of pixels", 4 * u64::from(pixels.count))?,
            order: None,
            outside: 0,
        })
    }

    /// How often a pixel outside was read.
    pub(crate) fn outside(&self) -> u32 {
        self.outside
    }

    /// Sorts pixels again the next time.
    pub(crate) fn forget_order(&mut self) {
        self.order = None;
    }

    /// Sorts the pixels where that is to be done, and adds what they reflect. False where nothing was added, since
    /// their cells have so few each that plain reading is faster.
    pub(crate) fn add(&mut self, gpu: &Gpu) -> Result<(Vec<PassTime>, bool), Error> {
        let mut times = Vec::new();
        if self.order.is_none() {
            let (order, sorting) = self.sort(gpu)?;
            self.order = Some(order);
            times = sorting;
        }
        let Some(Order::Dense { layout, pixels, outside }) = &self.order else {
            return Ok((times, false));
        };
        let most = (BLOCKS_BYTES / self.block_bytes).min(MOST_CELLS);
        for (cells, counts) in layout.cells.chunks(most).zip(layout.pixels.chunks(most)) {
            times.extend(self.read(gpu, pixels, cells, counts)?);
        }
        self.outside += outside;
        Ok((times, true))
    }

    fn sort(&self, gpu: &Gpu) -> Result<(Order, Vec<PassTime>), Error> {
        let cells = self.cells.into_iter().product::<u32>() as usize;
        // The pixels of each cell, and those outside.
        let counts = gpu.zeroed("pixels of cells", 4 * (cells as u64 + 1))?;
        let count = self.pass(gpu, "sort", &self.count, &[&self.places, &counts])?;
        let mut times = gpu.run(&[count.over(self.workgroups)])?;
        let counts: Vec<u32> = gpu.read(&counts)?;
        let layout = Layout::new(self.cells, &counts[..cells], self.pixels_a_group);
        if 10 * layout.length > self.places_of_ten_pixels.saturating_mul(layout.seen()) {
            return Ok((Order::Sparse, times));
        }
        let firsts = gpu.storage("first pixels of cells", &layout.firsts)?;
        let pixels = gpu.zeroed("pixels in order", 4 * layout.length)?;
        let scatter = self.pass(gpu, "sort", &self.scatter, &[&self.places, &firsts, &pixels])?;
        times.extend(gpu.run(&[scatter.over(self.workgroups)])?);
        Ok((Order::Dense { layout, pixels, outside: counts[cells] }, times))
    }

    fn pass(
        &self,
        gpu: &Gpu,
        name: &'static str,
        kernel: &Arc<Kernel>,
        own: &[&Buffer],
    ) -> Result<Pass, Error> {
        let resources = [&self.view, &self.surfaces].into_iter().chain(own.iter().copied());
        gpu.pass(name, kernel, &resources.map(Resource::Buffer).collect::<Vec<_>>())
    }

    /// Of these cells with so many pixels each.
    fn read(
        &self,
        gpu: &Gpu,
        order: &Buffer,
        cells: &[[u32; 4]],
        pixels: &[u32],
    ) -> Result<Vec<PassTime>, Error> {
        let blocks = UniformBatches::zeroed(gpu, "cells", self.block_bytes, cells.len())?;
        let of_cells = gpu.storage("cells with pixels", cells)?;
        let own = [&self.view, &self.coefficients, &of_cells, blocks.buffer()];
        let assemble = gpu.pass("assemble", &self.assemble, &own.map(Resource::Buffer))?;
        let own = [&self.view, &self.surfaces, &self.results, order].map(Resource::Buffer);
        let mut resources = own.to_vec();
        resources.push(Resource::Batches(&blocks));
        resources.extend(self.tables.iter().map(Resource::Buffer));
        let read = gpu.pass("read", &self.read, &resources)?;
        let of_cell =
            |(index, &count): (usize, &u32)| (index, workgroups(count, self.pixels_a_group));
        gpu.run(&[
            assemble.over([cells.len() as u32, 1, 1]),
            read.over_batches(pixels.iter().enumerate().map(of_cell)),
        ])
    }
}
