//! What is read, and how.

use manylights_harmonics::count;
use manylights_reflectance::ReceiverKinds;

use crate::packed_layout::PackedLayout;
use crate::{Grid, Scheme};

/// Guaranteed bytes of a uniform binding.
const UNIFORM_BYTES: usize = 1 << 16;

/// What is read, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Where the vertices are, in the world.
    pub grid: Grid<f32>,
    /// Between them.
    pub scheme: Scheme,
    /// Of the light and of the lobes.
    pub bands: usize,
    /// The lobes that pixels have.
    pub kinds: ReceiverKinds,
    /// In which pixels are read.
    pub order: Order,
    /// Of the coefficients that are read.
    pub storage: Storage,
}

/// How numbers at the vertices are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Single precision.
    F32,
    /// Values in half precision over a scale, derivatives in 8 bits ([`pack`](crate::pack)): a third of the bytes with
    /// gradients, half without.
    Packed,
}

/// In which pixels are read. The radiance is the same but for the last digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Each by itself, its corners from storage.
    Plain,
    /// Cell by cell, so that all lanes read the same corners, from uniform memory; plain where a cell does not
    /// fit there ([`Settings::is_sorted`]).
    Sorted,
    /// The same, but plain as well where cells have so few pixels that it is faster.
    Chosen,
}

impl Settings {
    /// Of a vertex in single precision, each a `vec4f`, in the frame of the world. With gradients three for each of bands²
    /// coefficients, one a channel: the value, and its three derivatives times the grid's spacing. Without them
    /// one, of red, green, blue and nothing. Vertices are in the order of the grid.
    pub fn vectors(&self) -> usize {
        let each = if self.scheme.reads_gradients() { 3 } else { 1 };
        each * count(self.bands)
    }

    /// Of a vertex as [`Settings::storage`] keeps it, 16 bytes each.
    pub fn stored_vectors(&self) -> usize {
        match self.storage {
            Storage::F32 => self.vectors(),
            Storage::Packed => self.packed().vectors,
        }
    }

    pub(crate) fn packed(&self) -> PackedLayout {
        PackedLayout::new(self.bands, self.scheme.reads_gradients())
    }

    /// Whether pixels are sorted: in single precision up to 13 bands with gradients, else whatever their number.
    pub fn is_sorted(&self) -> bool {
        self.order != Order::Plain && self.block_bytes() <= UNIFORM_BYTES
    }

    /// Of a cell with its eight corners, as uniform memory holds it.
    pub(crate) fn block_bytes(&self) -> usize {
        16 * (1 + 8 * self.stored_vectors())
    }

    /// Of those that are sorted. The more, the more often a number that is loaded is used, and the longer the
    /// kernel, which holds the turns of each one's specular lobe (`results/throughput/interpolation.md`): measured at
    /// 9 bands, beyond which its length is kept.
    pub(crate) fn pixels_a_lane(&self) -> usize {
        let most = if self.kinds.specular { 6 } else { 12 };
        (most * count(9) / count(self.bands)).clamp(1, most)
    }

    /// How many places in the order of sorted pixels, where there may be a pixel or not, there may be for ten pixels:
    /// plain reading takes so many times their time for a glossy pixel, from 5 to 9 bands 3.4 to 4.8 with gradients
    /// and 2.1 to 3.2 without (`results/throughput/interpolation.md`).
    pub(crate) fn places_of_ten_pixels(&self) -> u64 {
        let bands = self.bands as u64;
        match self.order {
            Order::Chosen if self.scheme.reads_gradients() => 17 + 7 * bands / 2,
            Order::Chosen => 8 + 5 * bands / 2,
            Order::Plain | Order::Sorted => u64::MAX,
        }
    }
}
