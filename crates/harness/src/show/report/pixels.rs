//! Pictures as text: half floats in base64.
//!
//! A half has 11 significant bits, so a component is known to one part in 2048: no error map or
//! exposure shows the difference. A pixel takes 6 bytes, 8 characters of base64.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use half::f16;
use manylights_metrics::RadianceImage;

/// Characters that a picture takes.
pub(super) fn length(image: &RadianceImage) -> usize {
    8 * image.pixels.len()
}

/// The power of two that brings radiances which a display shows as mid-grey near 1, far from both ends
/// of the range of halves (6·10⁻⁸ to 65504).
pub(super) fn factor(exposure: f32) -> f32 {
    exposure.log2().round().exp2()
}

/// Base64 of R, G, B, row by row, times `factor`, as little-endian halves. What is too large for a
/// half is its largest number.
pub(super) fn encode(image: &RadianceImage, factor: f32) -> String {
    let half = |component: &f32| {
        let largest = f16::MAX.to_f32();
        f16::from_f32((component * factor).clamp(-largest, largest)).to_le_bytes()
    };
    let bytes: Vec<u8> = image.pixels.iter().flatten().flat_map(half).collect();
    BASE64_STANDARD.encode(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_keep_eleven_bits() {
        let values = [0.0, 1.0, 0.333_3, 1e-6, 1e9, -2.5];
        let image = RadianceImage {
            width: 2,
            height: 1,
            pixels: vec![[values[0], values[1], values[2]], [values[3], values[4], values[5]]],
        };
        let factor = factor(3.0e-2);
        assert_eq!(factor, 1.0 / 32.0);
        let text = encode(&image, factor);
        assert_eq!(text.len(), length(&image));
        let bytes = BASE64_STANDARD.decode(text).expect("base64");
        let halves = bytes.chunks_exact(2).map(|b| f16::from_le_bytes([b[0], b[1]]).to_f32());
        for (half, value) in halves.zip(values) {
            let expected = (value * factor).min(65504.0);
            // Half a unit in the last of 11 bits; 2⁻²⁵ below the normal numbers.
            let bound = expected.abs() / 2048.0 + 2.0_f32.powi(-25);
            assert!((half - expected).abs() <= bound, "{half} for {expected}");
        }
    }
}
