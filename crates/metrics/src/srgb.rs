//! Display-referred colour: exposure, clamp and the sRGB curve (IEC 61966-2-1).

use crate::RadianceImage;

impl RadianceImage {
    /// The picture as a display shows it: `srgb(clamp(exposure · radiance, 0, 1))` per component,
    /// values in `[0, 1]`, with the encoding curve of IEC 61966-2-1. `exposure` is a linear factor
    /// in m²·sr·W⁻¹.
    ///
    /// A component that is not finite becomes NaN, so that an infinite one cannot pass for white.
    pub fn display(&self, exposure: f32) -> Self {
        let encode = |c: f32| {
            if c.is_finite() { curve(f64::from(exposure) * f64::from(c)) as f32 } else { f32::NAN }
        };
        let pixels = self.pixels.iter().map(|pixel| pixel.map(encode)).collect();
        Self { pixels, ..*self }
    }
}

/// The sRGB encoding of a linear value, clamped to `[0, 1]`. In f64: f32 `powf` would cost digits of
/// errors that are small.
fn curve(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// The linear value, in `[0, 1]`, that an sRGB value in `[0, 1]` encodes.
pub(crate) fn linear(encoded: f64) -> f64 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}
