//! Where a grid must lie.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{Binding, Buffer, Error, Gpu, Resource, link};
use manylights_scene::Scene;

use crate::{Bounds, Grid, Interpolation};

/// Workgroups, and lanes of each, that go over all pixels: few, since each lane writes to the same numbers.
const GROUPS: u32 = 64;
const LANES: u32 = 64;

/// Of the largest side: how thick a box is at least, so that a floor has a grid.
const LEAST_SIDE: f32 = 1e-3;

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Told {
    pixels: u32,
    padding: [u32; 3],
}

impl Interpolation {
    /// The grid of a picture, whose first `pixels` of `surfaces` the camera sees.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn grid(
        &self,
        gpu: &Gpu,
        scene: &Scene,
        (surfaces, pixels): (&Buffer, u32),
    ) -> Result<Grid<f32>, Error> {
        let seen = match self.bounds {
            Bounds::View => seen(gpu, surfaces, pixels)?,
            Bounds::Scene => None,
        };
        // Where the camera sees nothing, any grid is right.
        let [least, most] = seen.unwrap_or_else(|| scene.bounds().into());
        let largest = (most - least).max_element();
        let side = if largest > 0.0 { largest } else { 1.0 };
        let missing = (LEAST_SIDE * side - (most - least)).max(Vec3::ZERO);
        let corners = [least - 0.5 * missing, most + 0.5 * missing].map(|corner| corner.to_array());
        Ok(Grid::of_cubes(corners, self.vertices))
    }
}

/// The least and most of what pixels see; `None` where they see nothing.
fn seen(gpu: &Gpu, surfaces: &Buffer, pixels: u32) -> Result<Option<[Vec3; 2]>, Error> {
    let layout = format!("const EXTENT_LANES = {LANES}u;\n");
    let modules = [("layout", &*layout)];
    let wgsl = link("extent", include_str!("shaders/extent.wesl"), &modules, &[])?;
    let bindings = [Binding::Uniform, Binding::Storage, Binding::StorageMut];
    let kernel = gpu.kernel("extent", &wgsl, &bindings)?;
    let told = gpu.uniform("pixels", &Told { pixels, padding: [0; 3] })?;
    let extent = gpu.zeroed("extent", 24)?;
    let pass = gpu.pass("extent", &kernel, &[&told, surfaces, &extent].map(Resource::Buffer))?;
    gpu.run(&[pass.over([GROUPS, 1, 1])])?;
    let ordered: Vec<u32> = gpu.read(&extent)?;
    if ordered[0] == 0 {
        return Ok(None);
    }
    let number = |ordered: u32| match ordered >> 31 {
        1 => f32::from_bits(ordered & 0x7fff_ffff),
        _ => f32::from_bits(!ordered),
    };
    let [most, opposite] =
        [0, 3].map(|first| Vec3::from([0, 1, 2].map(|axis| number(ordered[first + axis]))));
    Ok(Some([-opposite, most]))
}
