//! One channel of a picture before the observer, and separable filters on it.

/// Of the observer whom the paper assumes: 0.7 m before a display that has 3840 pixels in 0.7 m.
pub(super) const PIXELS_PER_DEGREE: f64 = 3840.0 * std::f64::consts::PI / 180.0;

/// Weights of a filter along one axis: an odd number, the middle one of the pixel itself.
pub(super) struct Taps(Vec<f64>);

impl Taps {
    /// `weight` of distances in pixels up to `radius`.
    pub(super) fn new(radius: usize, weight: impl Fn(f64) -> f64) -> Self {
        let distances = (0..=2 * radius).map(|index| index as f64 - radius as f64);
        Self(distances.map(weight).collect())
    }

    /// Scaled so that weights above zero have a sum of 1, and those below zero of −1, where there are any.
    pub(super) fn normalized(self) -> Self {
        let sum = |sign: f64| self.0.iter().map(|&weight| (sign * weight).max(0.0)).sum::<f64>();
        let (above, below) = (sum(1.0), sum(-1.0));
        let scaled = |&weight: &f64| {
            if weight > 0.0 { weight / above } else { weight / below.max(f64::MIN_POSITIVE) }
        };
        Self(self.0.iter().map(scaled).collect())
    }

    /// Of all weights.
    pub(super) fn sum(&self) -> f64 {
        self.0.iter().sum()
    }
}

/// Values row by row.
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) values: Vec<f64>,
}

impl Plane {
    /// The picture goes on beyond its edges as it ends there.
    pub(super) fn filtered_across(&self, taps: &Taps) -> Self {
        let radius = taps.0.len() / 2;
        let mut values = vec![0.0; self.values.len()];
        let mut padded = vec![0.0; self.width + 2 * radius];
        let rows = self.values.chunks_exact(self.width);
        for (row, sums) in rows.zip(values.chunks_exact_mut(self.width)) {
            padded[..radius].fill(row[0]);
            padded[radius..radius + self.width].copy_from_slice(row);
            padded[radius + self.width..].fill(row[self.width - 1]);
            for (start, &weight) in taps.0.iter().enumerate() {
                add(sums, &padded[start..start + self.width], weight);
            }
        }
        Self { values, ..*self }
    }

    /// As [`Self::filtered_across`].
    pub(super) fn filtered_down(&self, taps: &Taps) -> Self {
        let radius = taps.0.len() / 2;
        let last = self.values.len() / self.width - 1;
        let mut values = vec![0.0; self.values.len()];
        for (y, sums) in values.chunks_exact_mut(self.width).enumerate() {
            for (step, &weight) in taps.0.iter().enumerate() {
                let from = (y + step).saturating_sub(radius).min(last) * self.width;
                add(sums, &self.values[from..from + self.width], weight);
            }
        }
        Self { values, ..*self }
    }
}

fn add(sums: &mut [f64], values: &[f64], weight: f64) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += weight * value;
    }
}
