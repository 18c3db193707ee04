//! Coefficients in a third of their bytes.

use manylights_gpu::{Binding, Buffer, Error, Gpu, PassTime, Resource, link};
use manylights_harmonics::count;

use crate::GridCoefficients;
use crate::packed_layout::PackedLayout;

/// Lanes of a workgroup, a vertex each.
const LANES: u32 = 64;

/// The coefficients as [`Storage::Packed`](crate::Storage::Packed) keeps them, and the time of the pass. Of each vertex
/// vectors of 16 bytes:
/// - the scales of red, green and blue, in single precision: L_00, which no coefficient of a light exceeds by more than
///   √(2l + 1), or where it is small for want of bands or of sign, 1/256 of the largest coefficient;
/// - with gradients a scale for each band, four a vector: the largest derivative by a cell of all its orders and
///   channels;
/// - with gradients a vector for each coefficient: red, green and blue over their scales in half precision, blue's
///   first two derivatives over the band's scale in 8 bits each; red's three and blue's third; green's three;
/// - without, a vector for two coefficients, red, green, blue and nothing each.
///
/// # Errors
/// Where the adapter refuses the kernel or the buffer, or the device gave up.
pub fn pack(gpu: &Gpu, coefficients: &GridCoefficients) -> Result<(Buffer, Vec<PassTime>), Error> {
    let GridCoefficients { ref grid, bands, gradients, ref buffer } = *coefficients;
    let size = count(bands);
    let PackedLayout { header, vectors } = PackedLayout::new(bands, gradients);
    let layout = format!(
        "const LANES = {LANES}u;\nconst BANDS = {bands}u;\nconst COUNT = {size}u;\n\
         const HEADER = {header}u;\nconst VECTORS = {vectors}u;\n"
    );
    let entry = include_str!("shaders/pack.wesl");
    let wgsl = link("pack", entry, &[("layout", &*layout)], &[("gradients", gradients)])?;
    let kernel = gpu.kernel("pack", &wgsl, &[Binding::Storage, Binding::StorageMut])?;
    let packed = gpu.zeroed("packed coefficients", (16 * vectors * grid.count()) as u64)?;
    let pass = gpu.pass("pack", &kernel, &[buffer, &packed].map(Resource::Buffer))?;
    let times = gpu.run(&[pass.over([(grid.count() as u32).div_ceil(LANES), 1, 1])])?;
    Ok((packed, times))
}
