//! How sure an error, and the difference of two, is.
//!
//! The noise of the reference is common to all pictures and adds to each squared error: it is subtracted from each
//! and says nothing of a difference. What moves a difference D of two mean squared errors by chance is
//! - the seeds, which both methods share: D is taken seed by seed and its mean has Student's interval. Where there is
//!   one seed of a method with chance, the tiles of the picture stand for seeds (as if they were independent);
//! - the noise e of the reference, −2 mean((x − y) e) for pictures x and y: its variance is that of half the
//!   difference between D against one half of the reference's samples and against the other, known tile by tile
//!   ([`Tiles`]).
//!
//! Both intervals are added as squares.

use crate::answer::statistics::{mean, student_95, variance};
use crate::measurement::tiles::Tiles;

/// What is known of the error of a method against a reference.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Sample {
    /// Seed by seed, in the experiment's order.
    pub(crate) seeds: Vec<SeedError>,
    /// Whether another seed gives another picture.
    pub(crate) is_random: bool,
    /// Of the reference, as RMSE; zero where another method is the reference.
    pub(crate) floor: f64,
}

/// The error of one picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SeedError {
    pub(crate) seed: u64,
    /// Mean squared error of sRGB values, the noise of the reference included.
    pub(crate) squared: f64,
    /// Unknown in old results.
    pub(crate) tiles: Option<Tiles>,
}

/// A number with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Estimate {
    pub(crate) value: f64,
    /// Half of the interval.
    pub(crate) half: f64,
}

impl Estimate {
    /// From independent parts of its variance, each with its degrees of freedom: their intervals add as squares.
    /// Common degrees of freedom (Welch and Satterthwaite), tried in the simulation of `coverage_test.rs`, hold the
    /// truth too seldom where seeds are few.
    pub(crate) fn new(value: f64, parts: &[(f64, usize)]) -> Self {
        let square = |&(variance, degrees): &(f64, usize)| variance * student_95(degrees).powi(2);
        Self { value, half: parts.iter().map(square).sum::<f64>().sqrt() }
    }

    /// Whether it may be zero.
    pub(crate) fn holds_zero(&self) -> bool {
        self.value.abs() <= self.half
    }

    /// Whether it is, without any chance.
    pub(crate) fn is_zero(&self) -> bool {
        self.value == 0.0 && self.half == 0.0
    }

    /// Of a square, as roots: the value, and both ends of the interval.
    pub(crate) fn roots(&self) -> [f64; 3] {
        let Self { value, half } = *self;
        [value, value - half, value + half].map(|square| square.max(0.0).sqrt())
    }
}

impl Sample {
    /// Both ends of the 95 % interval of the RMSE without the noise of the reference; `None` where nothing is known
    /// of its chance. That of the logarithm of the squared error, which is less skew than the square itself.
    pub(crate) fn interval(&self) -> Option<[f64; 2]> {
        let errors: Vec<_> = self.seeds.iter().map(Known::from).collect();
        let Estimate { value, half } = estimate(&errors, self.is_random, self.floor > 0.0)?;
        let factor = if half > 0.0 { (half / value).exp() } else { 1.0 };
        let ends = [value / factor, value * factor];
        Some(ends.map(|square| (square - self.floor.powi(2)).max(0.0).sqrt()))
    }

    /// The mean of the squared errors over seeds, without the noise of the reference; zero at least.
    pub(crate) fn mean_squared(&self) -> f64 {
        (mean(self.seeds.iter().map(|seed| seed.squared)) - self.floor.powi(2)).max(0.0)
    }

    /// How much larger this squared error is than the other's; `None` where they share no seed, or nothing is
    /// known of their chance.
    pub(crate) fn excess_over(&self, other: &Self) -> Option<Estimate> {
        let pair = |own: &SeedError| {
            let other = other.seeds.iter().find(|other| other.seed == own.seed)?;
            Some(Known::from(own).minus(&Known::from(other)))
        };
        let pairs: Vec<_> = self.seeds.iter().filter_map(pair).collect();
        estimate(&pairs, self.is_random || other.is_random, self.floor > 0.0)
    }

    /// Both ends of the 95 % interval of the ratio of this RMSE to the other's, the noise of the reference subtracted
    /// from each: the jackknife's over the seeds that both have, of the ratio's logarithm, and that of the reference's
    /// noise. `None` where chance has fewer than three seeds, or too little is known or left.
    pub(crate) fn ratio_to(&self, other: &Self) -> Option<[f64; 2]> {
        let other_of = |own: &SeedError| other.seeds.iter().find(|other| other.seed == own.seed);
        let pairs: Vec<[Known; 2]> = self
            .seeds
            .iter()
            .filter_map(|own| Some([Known::from(own), Known::from(other_of(own)?)]))
            .collect();
        let is_random = self.is_random || other.is_random;
        if pairs.is_empty() || is_random && pairs.len() < 3 {
            return None;
        }
        let squares = |but: Option<usize>| {
            let rest = || pairs.iter().enumerate().filter(|(seed, _)| Some(*seed) != but);
            let count = rest().count() as f64;
            [0, 1].map(|side| {
                let sum: f64 = rest().map(|(_, pair)| pair[side].squared).sum();
                sum / count - self.floor.powi(2)
            })
        };
        let logarithm = |[own, other]: [f64; 2]| 0.5 * (own / other).ln();
        let all = squares(None);
        let mut parts = Vec::new();
        if is_random {
            let without = (0..pairs.len()).map(|seed| logarithm(squares(Some(seed))));
            parts.push(jackknife(&without.collect::<Vec<_>>()));
        }
        if self.floor > 0.0 {
            parts.push(relative_reference_variance(&pairs, all)?);
        }
        let Estimate { value, half } = Estimate::new(logarithm(all), &parts);
        let ends = [value - half, value + half].map(f64::exp);
        ends.iter().all(|end| end.is_finite()).then_some(ends)
    }

    /// Twice the covariance of a picture with the noise of the reference, as a variance of its squared error with
    /// its degrees of freedom; none of a reference without noise. `None` where it is not known.
    pub(crate) fn reference_variance(&self) -> Option<(f64, usize)> {
        let errors: Vec<_> = self.seeds.iter().map(Known::from).collect();
        reference_variance(&errors, self.floor > 0.0)
    }
}

/// A squared error, or a difference of two.
struct Known {
    squared: f64,
    /// By tile.
    parts: Vec<f64>,
    imbalance: Vec<f64>,
}

impl From<&SeedError> for Known {
    fn from(error: &SeedError) -> Self {
        let wide = |of: fn(&Tiles) -> &Vec<f32>| {
            let tiles = error.tiles.iter().flat_map(of);
            tiles.map(|&value| f64::from(value)).collect()
        };
        Self {
            squared: error.squared,
            parts: wide(|tiles| &tiles.squared),
            imbalance: wide(|tiles| &tiles.imbalance),
        }
    }
}

impl Known {
    fn minus(&self, other: &Self) -> Self {
        let difference =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>();
        Self {
            squared: self.squared - other.squared,
            parts: difference(&self.parts, &other.parts),
            imbalance: difference(&self.imbalance, &other.imbalance),
        }
    }
}

/// The variance of an estimate from those without each of the seeds, and its degrees of freedom (Efron and Tibshirani,
/// "An Introduction to the Bootstrap", 11).
pub(crate) fn jackknife(without: &[f64]) -> (f64, usize) {
    let count = without.len() as f64;
    ((count - 1.0).powi(2) / count * variance(without), without.len() - 1)
}

/// What the reference's noise adds to the variance of half the logarithm of a ratio of squared errors.
fn relative_reference_variance(pairs: &[[Known; 2]], all: [f64; 2]) -> Option<(f64, usize)> {
    let tiles = pairs[0][0].imbalance.len();
    let is_known = |pair: &[Known; 2]| pair.iter().all(|known| known.imbalance.len() == tiles);
    if tiles == 0 || !pairs.iter().all(is_known) {
        return None;
    }
    let of_tile = |tile: usize| {
        let relative =
            |side: usize| mean(pairs.iter().map(|pair| pair[side].imbalance[tile])) / all[side];
        (0.5 * (relative(0) - relative(1))).powi(2)
    };
    Some(((0..tiles).map(of_tile).sum(), tiles))
}

fn estimate(errors: &[Known], is_random: bool, is_noisy: bool) -> Option<Estimate> {
    let value = mean(errors.iter().map(|error| error.squared));
    let reference = reference_variance(errors, is_noisy);
    let count = errors.len() as f64;
    let parts = match errors {
        [] => return None,
        _ if !is_random => vec![reference?],
        // Their spread holds the noise of the reference already.
        [Known { parts, .. }] => vec![spread_of_sum(parts)?],
        _ => {
            let seeds: Vec<_> = errors.iter().map(|error| error.squared).collect();
            // Old results do not know the reference's part, which is small beside that of seeds.
            let mut parts = vec![(variance(&seeds) / count, errors.len() - 1)];
            parts.extend(reference);
            parts
        }
    };
    Some(Estimate::new(value, &parts))
}

/// Of the sum of a difference over tiles, and its degrees of freedom.
fn spread_of_sum(parts: &[f64]) -> Option<(f64, usize)> {
    let count = parts.len() as f64;
    (parts.len() > 1).then(|| (count * variance(parts), parts.len() - 1))
}

/// What the reference's noise adds to the variance of a mean over seeds, and its degrees of freedom.
fn reference_variance(errors: &[Known], is_noisy: bool) -> Option<(f64, usize)> {
    if !is_noisy {
        return Some((0.0, 1));
    }
    let tiles = errors.first()?.imbalance.len();
    if tiles == 0 || errors.iter().any(|error| error.imbalance.len() != tiles) {
        return None;
    }
    let of_tile = |tile: usize| mean(errors.iter().map(|error| error.imbalance[tile])).powi(2);
    Some(((0..tiles).map(of_tile).sum(), tiles))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pictures of these squared errors, by seed, none of which a tile or half of the reference favours.
    fn sample(squared: &[f64], is_random: bool, floor: f64) -> Sample {
        let error = |(seed, &squared): (u64, &f64)| {
            let tiles =
                Tiles { squared: vec![squared as f32 / 16.0; 16], imbalance: vec![1e-6; 16] };
            SeedError { seed, squared, tiles: Some(tiles) }
        };
        Sample { seeds: (0..).zip(squared).map(error).collect(), is_random, floor }
    }

    #[test]
    fn what_all_pictures_share_says_nothing_of_a_difference() {
        // Far closer to each other than the floor, and both off the reference alike.
        let [a, b] =
            [[0.0101, 0.0121], [0.0100, 0.0120]].map(|squared| sample(&squared, true, 0.09));
        let excess = a.excess_over(&b).expect("two seeds");
        assert!((excess.value - 1e-4).abs() < 1e-9 && !excess.holds_zero(), "{excess:?}");
        assert!((a.mean_squared() - (0.0111 - 0.0081)).abs() < 1e-12);
    }

    #[test]
    fn seeds_that_disagree_are_chance() {
        let [a, b] = [[0.011, 0.012], [0.010, 0.014]].map(|squared| sample(&squared, true, 0.0));
        assert!(a.excess_over(&b).expect("two seeds").holds_zero());
    }

    #[test]
    fn without_chance_the_reference_alone_matters() {
        let [a, b] = [[0.0101], [0.01]].map(|squared| sample(&squared, false, 0.05));
        assert!(!a.excess_over(&b).expect("known").holds_zero());
        // A reference whose halves favour one of them by more than they differ.
        let mut favoured = b.clone();
        let tiles = favoured.seeds[0].tiles.as_mut().expect("has tiles");
        tiles.imbalance = vec![5e-5; 16];
        assert!(a.excess_over(&favoured).expect("known").holds_zero());
        // Of old results the halves are not known, which matters only where there is noise.
        favoured.seeds[0].tiles = None;
        assert_eq!(a.excess_over(&favoured), None);
        let [a, b] = [a, favoured].map(|sample| Sample { floor: 0.0, ..sample });
        assert!(!a.excess_over(&b).expect("no noise").holds_zero());
    }

    #[test]
    fn one_seed_is_judged_by_its_tiles() {
        let even = sample(&[0.01], true, 0.0);
        let mut other = sample(&[0.012], true, 0.0);
        assert!(!other.excess_over(&even).expect("tiles").holds_zero());
        // The same difference, but for the good in one tile alone.
        let tiles = other.seeds[0].tiles.as_mut().expect("has tiles");
        tiles.squared = vec![0.01 / 16.0; 16];
        tiles.squared[3] += 0.002;
        assert!(other.excess_over(&even).expect("tiles").holds_zero());
    }
}
