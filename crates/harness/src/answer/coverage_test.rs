//! Intervals in a simulation whose truth is known: of a hundred, about five must miss it.

use manylights_metrics::RadianceImage;

use crate::answer::bias::split;
use crate::answer::significance::{Estimate, Sample, SeedError};
use crate::measurement::tiles::Tiles;

const SIDE: u32 = 16;
const TRIALS: u64 = 600;

/// Normal numbers: Box and Muller's of SplitMix64's bits.
struct Chance(u64);

impl Chance {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// A method: what it is off at a pixel, and how it scatters there, by itself and as one with the whole picture.
#[derive(Clone, Copy)]
struct Simulated {
    bias: fn(u32) -> f64,
    grain: f64,
    sway: f64,
}

/// Brighter to the right.
const FIRST: Simulated = Simulated {
    bias: |index| 0.02 + 0.03 * f64::from(index % SIDE) / 16.0,
    grain: 0.05,
    sway: 0.01,
};
/// Off in the upper rows alone.
const SECOND: Simulated =
    Simulated { bias: |index| if index < 64 { 0.09 } else { 0.0 }, grain: 0.04, sway: 0.015 };

impl Simulated {
    fn squared_bias(&self) -> f64 {
        (0..SIDE * SIDE).map(|index| (self.bias)(index).powi(2)).sum::<f64>()
            / f64::from(SIDE * SIDE)
    }

    fn variance(&self) -> f64 {
        self.grain.powi(2) + self.sway.powi(2)
    }

    /// Pictures about 0.5, the truth; both methods sway alike in a seed.
    fn pictures(&self, sways: &[f64], chance: &mut Chance) -> Vec<RadianceImage> {
        let picture = |sway: &f64| {
            image(|index| {
                0.5 + (self.bias)(index) + self.grain * chance.normal() + self.sway * sway
            })
        };
        sways.iter().map(picture).collect()
    }
}

/// All components of a pixel have one value.
fn image(mut value: impl FnMut(u32) -> f64) -> RadianceImage {
    let pixels = (0..SIDE * SIDE).map(|index| [value(index) as f32; 3]).collect();
    RadianceImage { width: SIDE, height: SIDE, pixels }
}

/// The share of trials in which the truth lies in the interval: of both errors, of their difference, of the squared
/// bias and the variance of the first method, of the ratio.
fn coverage(seeds: usize, noise: f64) -> [f64; 6] {
    let mut within = [0.0; 6];
    let mut chance = Chance(seeds as u64);
    for _ in 0..TRIALS {
        let halves: [_; 2] =
            std::array::from_fn(|_| image(|_| 0.5 + 2_f64.sqrt() * noise * chance.normal()));
        let [a, b] = &halves;
        let truth = image(|index| {
            let value = |half: &RadianceImage| f64::from(half.pixels[index as usize][0]);
            (value(a) + value(b)) / 2.0
        });
        let sways: Vec<f64> = (0..seeds).map(|_| chance.normal()).collect();
        let [first, second] = [FIRST, SECOND].map(|method| method.pictures(&sways, &mut chance));
        let sample = |pictures: &[RadianceImage]| {
            let error = |(seed, picture): (u64, &RadianceImage)| {
                let tiles = Tiles::new(picture, &truth, Some(&halves));
                let squared = tiles.squared.iter().copied().map(f64::from).sum();
                SeedError { seed, squared, tiles: Some(tiles) }
            };
            Sample {
                seeds: (0..).zip(pictures).map(error).collect(),
                is_random: true,
                floor: noise,
            }
        };
        let [own, other] = [&first, &second].map(|pictures| sample(pictures));
        let pairs: Vec<_> = first.iter().map(|picture| (picture, &truth)).collect();
        let parts = split(&pairs, noise, own.reference_variance());
        let known = [FIRST, SECOND].map(|method| method.squared_bias() + method.variance());
        let holds = |Estimate { value, half }: Estimate, truth: f64| (value - truth).abs() <= half;
        let holds_root = |sample: &Sample, square: f64| {
            let [lower, upper] = sample.interval().expect("all is known");
            (lower..=upper).contains(&square.sqrt())
        };
        let excess = own.excess_over(&other).expect("all is known");
        let [lower, upper] = own.ratio_to(&other).expect("all is known");
        let held = [
            holds_root(&own, known[0]),
            holds_root(&other, known[1]),
            holds(excess, known[0] - known[1]),
            holds(parts.squared_bias, FIRST.squared_bias()),
            holds(parts.variance, FIRST.variance()),
            (lower..=upper).contains(&(known[0] / known[1]).sqrt()),
        ];
        for (count, held) in within.iter_mut().zip(held) {
            *count += f64::from(u8::from(held));
        }
    }
    within.map(|count| count / TRIALS as f64)
}

#[test]
fn intervals_hold_the_truth_as_often_as_they_say() {
    for (seeds, noise) in [(3, 0.02), (5, 0.04), (8, 0.02)] {
        let shares = coverage(seeds, noise);
        assert!(
            shares.iter().all(|share| (0.92..=0.98).contains(share)),
            "{seeds} seeds beside {noise}: {shares:?}"
        );
    }
}
