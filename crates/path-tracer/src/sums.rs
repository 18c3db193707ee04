//! What the slices of a pixel add up to.

use manylights_metrics::RadianceImage;

/// Sums over the slice means of one pixel. Slices are independent, samples within one are not: means
/// and variances come from slices alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Sums {
    /// Over even and over odd slices.
    halves: [[f64; 3]; 2],
    /// Of the squares over all slices.
    squares: [f64; 3],
}

impl Sums {
    pub(crate) fn add(&mut self, slice: u32, mean: [f32; 3]) {
        let half = &mut self.halves[slice as usize % 2];
        for channel in 0..3 {
            let value = f64::from(mean[channel]);
            half[channel] += value;
            self.squares[channel] += value * value;
        }
    }

    /// Mean over `slices` of both halves.
    pub(crate) fn mean(&self, slices: u32) -> [f64; 3] {
        let [even, odd] = self.halves;
        std::array::from_fn(|c| (even[c] + odd[c]) / f64::from(slices.max(1)))
    }

    /// Mean of the even (0) or odd (1) ones among `slices`.
    pub(crate) fn half(&self, half: usize, slices: u32) -> [f64; 3] {
        let count = if half == 0 { slices.div_ceil(2) } else { slices / 2 };
        self.halves[half].map(|sum| sum / f64::from(count.max(1)))
    }

    /// Unbiased estimate of the variance of [`Self::mean`].
    pub(crate) fn variance(&self, slices: u32) -> [f64; 3] {
        let mean = self.mean(slices);
        let n = f64::from(slices);
        std::array::from_fn(|c| {
            let spread = (self.squares[c] / n - mean[c] * mean[c]).max(0.0);
            if slices < 2 { 0.0 } else { spread / (n - 1.0) }
        })
    }
}

/// A picture of one value for each pixel.
pub(crate) fn image(
    [width, height]: [u32; 2],
    pixels: impl Iterator<Item = [f64; 3]>,
) -> RadianceImage {
    let pixels = pixels.map(|pixel| pixel.map(|c| c as f32)).collect();
    RadianceImage { width, height, pixels }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1, 2, 4, 9 have the mean 4 and the squared deviations 9 + 4 + 0 + 25: over 3 for their variance, over
    /// 4 for that of the mean. The halves are 1, 4 and 2, 9.
    #[test]
    fn variance_of_the_mean_of_four_slices() {
        let mut sums = Sums::default();
        for (slice, value) in (0..).zip([1.0, 2.0, 4.0, 9.0]) {
            sums.add(slice, [value, 2.0 * value, 0.0]);
        }
        assert_eq!(sums.mean(4), [4.0, 8.0, 0.0]);
        assert_eq!(sums.half(0, 4), [2.5, 5.0, 0.0]);
        assert_eq!(sums.half(1, 4), [5.5, 11.0, 0.0]);
        let expected = 38.0 / 3.0 / 4.0;
        for (found, expected) in sums.variance(4).into_iter().zip([expected, 4.0 * expected, 0.0]) {
            assert!((found - expected).abs() < 1e-12, "{found}, expected {expected}");
        }
        assert_eq!(Sums::default().variance(1), [0.0; 3]);
    }
}
