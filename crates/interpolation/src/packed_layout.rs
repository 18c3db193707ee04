//! How many vectors a vertex takes where it is packed.

use manylights_harmonics::count;

/// Of a vertex, vectors of 16 bytes ([`pack`](crate::pack) says what is in them).
pub(crate) struct PackedLayout {
    /// Those with scales: of each channel's values, and of each band's gradients, four a vector.
    pub(crate) header: usize,
    /// All.
    pub(crate) vectors: usize,
}

impl PackedLayout {
    pub(crate) fn new(bands: usize, gradients: bool) -> Self {
        let (header, coefficients) = match gradients {
            true => (1 + bands.div_ceil(4), count(bands)),
            false => (1, count(bands).div_ceil(2)),
        };
        Self { header, vectors: header + coefficients }
    }
}
