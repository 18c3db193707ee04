//! Windows that damp the ringing of a truncated expansion (thesis 2.45, whose labels are permuted:
//! its formula (1) is Hann, (2) Lanczos, (3) Hamming).

use crate::Real;

/// A weight for each band, falling from 1 at l = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Window {
    /// (1 + cos(π l/w))/2.
    Hann,
    /// sin(π l/w)/(π l/w), Lanczos' sigma factors.
    Lanczos,
    /// 0.54 + 0.46 cos(π l/w).
    Hamming,
    /// (sin(π l/w)/(π l/w))⁴, of [`crate::dering`] (Sloan 2017).
    SincFourth,
}

impl Window {
    /// Every window.
    pub const ALL: [Self; 4] = [Self::Hann, Self::Lanczos, Self::Hamming, Self::SincFourth];

    /// The weight of band `l` under a window of `width` w > 0 (in bands, not only whole ones). Bands
    /// from w on are cut: beyond it the formulas rise or change sign.
    pub fn weight<R: Real>(self, l: usize, width: R) -> R {
        let ratio = R::of(l as f64) / width;
        if ratio >= R::one() {
            return R::zero();
        }
        let angle = R::PI() * ratio;
        match self {
            Self::Hann => R::of(0.5) + R::of(0.5) * angle.cos(),
            Self::Hamming => R::of(0.54) + R::of(0.46) * angle.cos(),
            Self::Lanczos | Self::SincFourth if l == 0 => R::one(),
            Self::Lanczos => angle.sin() / angle,
            Self::SincFourth => (angle.sin() / angle).powi(4),
        }
    }

    /// The weights of all bands: scales to give to [`crate::convolution::convolve`].
    pub fn weights<R: Real>(self, width: R, weights: &mut [R]) {
        for (l, weight) in weights.iter_mut().enumerate() {
            *weight = self.weight(l, width);
        }
    }
}
