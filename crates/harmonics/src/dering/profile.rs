//! Zonal functions, by their profile.

use super::weakest;
use crate::Real;
use crate::window::Window;
use crate::zonal;

/// Steps of the golden section: 0.618³² is 2e-7 of a bracket, and a minimum is flat.
const SECTIONS: usize = 32;

/// Search over zonal functions of a number of bands.
#[derive(Clone, Debug)]
pub struct Profile<R> {
    /// Cosines at 4 bands + 1 equidistant angles from 0 to π: eight a period of the last band.
    cosines: Vec<R>,
    values: Vec<R>,
    /// The function under the window at hand.
    damped: Vec<R>,
}

impl<R: Real> Profile<R> {
    /// Tables for `bands` ≥ 1 bands.
    pub fn new(bands: usize) -> Self {
        assert!(bands >= 1, "an expansion has at least one band");
        let cells = 4 * bands;
        let step = std::f64::consts::PI / cells as f64;
        let cosines: Vec<R> = (0..=cells).map(|i| R::of((i as f64 * step).cos())).collect();
        Self { values: cosines.clone(), cosines, damped: vec![R::zero(); bands] }
    }

    /// Writes the weights of the weakest window under which the zonal function of these scales
    /// (see [`zonal`]) is nowhere below −`tolerance`, and gives its strength 1/width in 0 … 1.
    ///
    /// A tolerance, in units of the function, should exceed what rounding does to it: some 1e-6 of
    /// its maximum in f32. `None` if the mean is below −`tolerance` or a number is not finite.
    pub fn search(
        &mut self,
        window: Window,
        scales: &[R],
        tolerance: R,
        weights: &mut [R],
    ) -> Option<R> {
        assert_eq!(scales.len(), self.damped.len(), "one scale a band");
        assert_eq!(weights.len(), self.damped.len(), "one weight a band");
        weakest(window, weights, |weights| {
            for ((damped, &scale), &weight) in self.damped.iter_mut().zip(scales).zip(weights) {
                *damped = scale * weight;
            }
            self.falls_below(-tolerance)
        })
    }

    /// Whether the damped function does. What is not finite counts as below.
    fn falls_below(&mut self, limit: R) -> bool {
        let above = |value: R| value >= limit && value.is_finite();
        for (value, &cosine) in self.values.iter_mut().zip(&self.cosines) {
            *value = zonal::evaluate(&self.damped, cosine);
            if !above(*value) {
                return true;
            }
        }
        let last = self.values.len() - 1;
        (0..=last).any(|i| {
            let [before, after] = [i.saturating_sub(1), (i + 1).min(last)];
            let low = self.values[i] <= self.values[before] && self.values[i] <= self.values[after];
            low && !above(self.lowest([self.cosines[before], self.cosines[after]]))
        })
    }

    /// The minimum between two cosines, by golden section.
    fn lowest(&self, [mut a, mut b]: [R; 2]) -> R {
        let ratio = R::of(0.5 * (5.0_f64.sqrt() - 1.0));
        let value = |x: R| zonal::evaluate(&self.damped, x);
        let (mut c, mut d) = (b - ratio * (b - a), a + ratio * (b - a));
        let (mut at_c, mut at_d) = (value(c), value(d));
        for _ in 0..SECTIONS {
            if at_c < at_d {
                (b, d, at_d) = (d, c, at_c);
                c = b - ratio * (b - a);
                at_c = value(c);
            } else {
                (a, c, at_c) = (c, d, at_d);
                d = a + ratio * (b - a);
                at_d = value(d);
            }
        }
        at_c.min(at_d)
    }
}
