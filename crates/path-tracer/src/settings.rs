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
    /// Samples a pixel, rounded up to two or more whole slices of [`SLICE`](crate::SLICE).
    pub samples: u32,
}
