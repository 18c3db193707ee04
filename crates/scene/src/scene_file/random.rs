//! Random numbers for light sets: `SplitMix64` (Steele et al. 2014). With `libm`'s functions the same
//! seed gives the same bits on every machine.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

pub(super) struct Random {
    state: u64,
}

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// Uniform in [0, 1).
    pub(super) fn uniform(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        // 53 bits fill an f64.
        (z >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in the unit cube.
    pub(super) fn point(&mut self) -> DVec3 {
        let [x, y, z] = std::array::from_fn(|_| self.uniform());
        DVec3::new(x, y, z)
    }

    /// Uniform among all rotations (Shoemake 1992).
    pub(super) fn rotation(&mut self) -> DQuat {
        let [share, first, second] = self.point().to_array();
        let (sin_first, cos_first) = libm::sincos(TAU * first);
        let (sin_second, cos_second) = libm::sincos(TAU * second);
        let (a, b) = ((1.0 - share).sqrt(), share.sqrt());
        DQuat::from_xyzw(a * sin_first, a * cos_first, b * sin_second, b * cos_second)
    }
}
