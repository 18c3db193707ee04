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
//! Both variances are added, with degrees of freedom after Welch and Satterthwaite.

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
    /// From independent parts of its variance, each with its degrees of freedom.
    pub(crate) fn new(value: f64, parts: &[(f64, f64)]) -> Self {
        let variance: f64 = parts.iter().map(|(variance, _)| variance).sum();
        if variance == 0.0 {
            return Self { value, half: 0.0 };
        }
        // Welch and Satterthwaite.
        let weight: f64 = parts.iter().map(|(variance, degrees)| variance.powi(2) / degrees).sum();
        Self { value, half: student_95(variance.powi(2) / weight) * variance.sqrt() }
    }

    /// Whether it may be zero.
    pub(crate) fn holds_zero(&self) -> bool {
        self.value.abs() <= self.half
    }

    /// Of a square, as roots: the value, and both ends of the interval.
    pub(crate) fn roots(&self) -> [f64; 3] {
        let Self { value, half } = *self;
        [value, value - half, value + half].map(|square| square.max(0.0).sqrt())
    }
}

impl Sample {
    /// The squared error without the noise of the reference; `None` where nothing is known of its chance.
    pub(crate) fn squared_error(&self) -> Option<Estimate> {
        let errors: Vec<_> = self.seeds.iter().map(Known::from).collect();
        let Estimate { value, half } = estimate(&errors, self.is_random, self.floor > 0.0)?;
        Some(Estimate { value: value - self.floor.powi(2), half })
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

    /// Twice the covariance of a picture with the noise of the reference, as a variance of its squared error with
    /// its degrees of freedom; none of a reference without noise. `None` where it is not known.
    pub(crate) fn reference_variance(&self) -> Option<(f64, f64)> {
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

fn estimate(errors: &[Known], is_random: bool, is_noisy: bool) -> Option<Estimate> {
    let value = mean(errors.iter().map(|error| error.squared));
    let reference = reference_variance(errors, is_noisy)?;
    let count = errors.len() as f64;
    let parts = match errors {
        [] => return None,
        _ if !is_random => vec![reference],
        // Their spread holds the noise of the reference already.
        [Known { parts, .. }] => vec![spread_of_sum(parts)?],
        _ => {
            let seeds: Vec<_> = errors.iter().map(|error| error.squared).collect();
            vec![(variance(&seeds) / count, count - 1.0), reference]
        }
    };
    Some(Estimate::new(value, &parts))
}

/// Of the sum of a difference over tiles, and its degrees of freedom.
fn spread_of_sum(parts: &[f64]) -> Option<(f64, f64)> {
    let count = parts.len() as f64;
    (parts.len() > 1).then(|| (count * variance(parts), count - 1.0))
}

/// What the reference's noise adds to the variance of a mean over seeds, and its degrees of freedom.
fn reference_variance(errors: &[Known], is_noisy: bool) -> Option<(f64, f64)> {
    if !is_noisy {
        return Some((0.0, 1.0));
    }
    let tiles = errors.first()?.imbalance.len();
    if tiles == 0 || errors.iter().any(|error| error.imbalance.len() != tiles) {
        return None;
    }
    let of_tile = |tile: usize| mean(errors.iter().map(|error| error.imbalance[tile])).powi(2);
    Some(((0..tiles).map(of_tile).sum(), tiles as f64))
}
