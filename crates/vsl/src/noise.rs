//! The numbers that samples are made of: exact in f32 and f64, the same here and in
//! `shaders/sampling.wesl`.
//!
//! A pair of pixel and light has two random numbers ξ, ψ. Its samples are (i + ξ)/n across the lobe or
//! the cone and ψ + i golden angles around it: a shifted rank-1 lattice, so each pair's estimate is
//! unbiased, and errors of neighbours are independent.

/// Golden angle in turns.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// `lowbias32` (Wellons, "Prospecting for Hash Functions").
pub(crate) fn scrambled(value: u32) -> u32 {
    let x = value;
    let x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    let x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// What tells a light's samples from those of another light or seed.
pub(crate) fn light_key(index: usize, seed: u64) -> u32 {
    let seed = scrambled(scrambled((seed >> 32) as u32) ^ seed as u32);
    // The golden ratio keeps pixel 0 and light 0 of seed 0 from cancelling in every picture.
    scrambled(index as u32 ^ seed.wrapping_add(0x9e37_79b9))
}

/// Samples (u in (0, 1), azimuth in radians) of a pair.
pub(crate) fn samples(pixel: usize, light_key: u32, count: u32) -> impl Iterator<Item = [f64; 2]> {
    let x = (scrambled(pixel as u32) ^ light_key).wrapping_mul(0x9e37_79b1);
    let x = x ^ (x >> 16);
    let [across, around] = [x >> 16, x & 0xffff].map(|bits| (f64::from(bits) + 0.5) / 65536.0);
    (0..count).map(move |index| {
        let turns = around - 0.5 + f64::from(index) * GOLDEN;
        [(f64::from(index) + across) / f64::from(count), turns * std::f64::consts::TAU]
    })
}
