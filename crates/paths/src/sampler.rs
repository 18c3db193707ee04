//! Randomised quasi-Monte Carlo: Owen-scrambled Sobol points, one independent randomisation for each
//! pixel and slice (Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)).
//!
//! A slice holds [`SLICE`] points. Within it the points of one group are stratified in up to four
//! dimensions; groups are decorrelated by shuffled indices ("padding"). Everything is a function of
//! (seed, pixel, slice, group, point): no state, so the order of the work does not matter.

/// Points of one randomisation: samples a pixel in one slice. A power of two.
pub const SLICE: u32 = 16;

const SLICE_BITS: u32 = SLICE.trailing_zeros();

/// The first points of the four-dimensional Sobol sequence, bits reversed for the scrambling, in the
/// order of the reversed bits of their index.
static SOBOL: [[u32; 4]; SLICE as usize] = sobol();

/// Direction numbers of Joe and Kuo 2008: degree, polynomial and initial m of dimensions 2 to 4.
const JOE_KUO: [(usize, u32, [u32; 3]); 3] =
    [(1, 0, [1, 0, 0]), (2, 1, [1, 3, 0]), (3, 1, [1, 3, 1])];

/// The points of one pixel in one slice.
#[derive(Clone, Copy, Debug)]
pub struct Sampler {
    seed: u32,
}

impl Sampler {
    /// The randomisation of a pixel in a slice.
    pub fn new(seed: u64, pixel: u32, slice: u32) -> Self {
        let low = hash(seed as u32 ^ hash(pixel));
        let high = hash((seed >> 32) as u32 ^ hash(slice ^ 0x9e37_79b9));
        Self { seed: hash(low ^ high.rotate_left(16)) }
    }

    /// Point `index` of a group: up to four numbers in [0, 1).
    #[inline]
    pub fn group<const AXES: usize>(&self, group: u32, index: u32) -> [f32; AXES] {
        const { assert!(AXES <= 4, "direction numbers of four axes") };
        let seed = hash(self.seed ^ hash(group ^ 0x85eb_ca6b));
        // In reversed bits; the order of the points in a slice does not matter.
        let shift = 32 - SLICE_BITS;
        let shuffled = permute(index << shift, seed) >> shift;
        let point = &SOBOL[(shuffled % SLICE) as usize];
        let mut axis_seed = seed;
        std::array::from_fn(|axis| {
            axis_seed = hash(axis_seed ^ 0x5bd1_e995);
            unit(permute(point[axis], axis_seed).reverse_bits())
        })
    }

    /// A number in [0, 1) that is independent of all points: for Russian roulette.
    pub fn independent(&self, group: u32, index: u32) -> f32 {
        unit(hash(self.seed ^ hash(group ^ hash(index ^ 0xc2b2_ae35))))
    }
}

/// Numbers in [0, 1) that depend on `index` alone.
pub(crate) fn rotation(index: u32) -> [f32; 2] {
    let first = hash(index ^ 0x2545_f491);
    [unit(first), unit(hash(first ^ 0x9e37_79b9))]
}

/// The upper 24 bits as a number in [0, 1).
fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / (1 << 24) as f32)
}

/// The integer hash "lowbias32" of Wellons 2018.
fn hash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// Laine and Karras' permutation, in which each bit depends on those below it alone, with the
/// constants of Vegdahl 2021. On reversed bits it is a nested uniform (Owen) scrambling.
fn permute(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

const fn sobol() -> [[u32; 4]; SLICE as usize] {
    let mut points = [[0; 4]; SLICE as usize];
    let mut axis = 0;
    while axis < 4 {
        let directions = direction_numbers(axis);
        let mut index = 0;
        while index < SLICE as usize {
            let mut bits = 0;
            let mut bit = 0;
            while bit < SLICE_BITS as usize {
                if index >> bit & 1 == 1 {
                    bits ^= directions[bit];
                }
                bit += 1;
            }
            let position = (index as u32).reverse_bits() >> (32 - SLICE_BITS);
            points[position as usize][axis] = bits.reverse_bits();
            index += 1;
        }
        axis += 1;
    }
    points
}

/// v_k = m_k 2^(32−k) of one axis, by the recurrence of Bratley and Fox 1988 (eq. 2).
const fn direction_numbers(axis: usize) -> [u32; SLICE_BITS as usize] {
    let mut directions = [0; SLICE_BITS as usize];
    let mut k = 0;
    while k < SLICE_BITS as usize {
        directions[k] = if axis == 0 {
            1 << (31 - k)
        } else {
            let (degree, polynomial, initial) = JOE_KUO[axis - 1];
            if k < degree {
                initial[k] << (31 - k)
            } else {
                let mut value = directions[k - degree] ^ (directions[k - degree] >> degree);
                let mut j = 1;
                while j < degree {
                    if polynomial >> (degree - 1 - j) & 1 == 1 {
                        value ^= directions[k - j];
                    }
                    j += 1;
                }
                value
            }
        };
        k += 1;
    }
    directions
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(group: u32) -> Vec<[f32; 4]> {
        let sampler = Sampler::new(3, 17, 5);
        (0..SLICE).map(|index| sampler.group(group, index)).collect()
    }

    #[test]
    fn every_axis_is_stratified() {
        for axis in 0..4 {
            let mut strata: Vec<_> =
                points(1).iter().map(|p| (p[axis] * SLICE as f32) as u32).collect();
            strata.sort_unstable();
            assert_eq!(strata, (0..SLICE).collect::<Vec<_>>(), "axis {axis}");
        }
    }

    /// The first two axes are a (0, 2)-sequence: one point in each elementary rectangle of area
    /// 1/SLICE, whatever its shape.
    #[test]
    fn the_first_plane_is_a_net() {
        for bits in 0..=SLICE_BITS {
            let (columns, rows) = (1 << bits, SLICE >> bits);
            let mut cells: Vec<_> = points(2)
                .iter()
                .map(|p| (p[0] * columns as f32) as u32 * rows + (p[1] * rows as f32) as u32)
                .collect();
            cells.sort_unstable();
            assert_eq!(cells, (0..SLICE).collect::<Vec<_>>(), "{columns} × {rows}");
        }
    }

    /// Over many randomisations, groups and neighbouring pixels are uncorrelated: the correlation of
    /// n independent pairs has a standard deviation of 1/√n; 5 of them allow for the 16 pairs.
    #[test]
    fn groups_and_pixels_are_uncorrelated() {
        let n = 40_000;
        let correlation = |other: &dyn Fn(u32, u32) -> [f32; 4], a: usize, b: usize| {
            let sum: f64 = (0..n)
                .map(|i| {
                    let index = i % SLICE;
                    let x = Sampler::new(1, i / SLICE, 0).group::<4>(0, index)[a] - 0.5;
                    let y = other(i / SLICE, index)[b] - 0.5;
                    f64::from(x * y)
                })
                .sum();
            12.0 * sum / f64::from(n)
        };
        let limit = 5.0 / f64::from(n).sqrt();
        let group = |pixel, index| Sampler::new(1, pixel, 0).group(1, index);
        let pixel = |pixel, index| Sampler::new(1, pixel + 1, 0).group(0, index);
        let slice = |pixel, index| Sampler::new(1, pixel, 1).group(0, index);
        for (a, b) in (0..4).flat_map(|a| (0..4).map(move |b| (a, b))) {
            for other in [&group as &dyn Fn(u32, u32) -> [f32; 4], &pixel, &slice] {
                let correlation = correlation(other, a, b);
                assert!(correlation.abs() < limit, "axes {a}, {b}: {correlation}");
            }
        }
    }
}
