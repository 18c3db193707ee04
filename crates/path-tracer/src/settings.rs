use manylights_paths::SLICE;
use manylights_scene::Transport;

/// What to render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Which light paths count.
    pub transport: Transport,
    /// Width, height in pixels.
    pub resolution: [u32; 2],
    /// Same seed, same picture, bit for bit, whatever the number of threads.
    pub seed: u64,
    /// Samples a pixel, rounded up to two or more whole slices of [`SLICE`].
    pub samples: u32,
}

impl Settings {
    /// Samples a pixel that a reference has where so many are asked for: two or more whole slices.
    pub fn whole_samples(asked: u32) -> u32 {
        asked.div_ceil(SLICE).max(2).saturating_mul(SLICE)
    }

    pub(crate) fn slices(&self) -> u32 {
        Self::whole_samples(self.samples) / SLICE
    }
}
