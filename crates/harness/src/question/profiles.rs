//! How large an experiment is: `[profiles.NAME]` of its file.

use manylights_path_tracer as path_tracer;
use serde::Deserialize;

use crate::question::plan::Budget;
use crate::question::settings;

/// Seed of every reference. No cell may use it: its samples would agree with the reference's.
pub(crate) const REFERENCE_SEED: u64 = 0x7265_6665;

/// Side of the window of SSIM.
const MIN_SIDE: u32 = 11;

/// How large an experiment is.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Scale {
    /// Width, height in pixels.
    pub(crate) resolution: [u32; 2],
    /// Samples a pixel of the references; once checked, those that they have: whole slices.
    pub(crate) reference_samples: u32,
    /// Timed runs of each cell.
    pub(crate) repetitions: u32,
    /// One picture for each.
    pub(crate) seeds: Vec<u64>,
    /// Of methods with a time budget.
    #[serde(default)]
    times: Vec<Time>,
}

/// A time budget as written.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "a time is a number of seconds or \"baseline\"")]
enum Time {
    Seconds(f64),
    Of(String),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Profiles {
    quick: Option<Scale>,
    standard: Option<Scale>,
    paper: Option<Scale>,
}

/// How much an experiment may cost: `[profiles.NAME]` of its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Profile {
    /// Seconds to minutes, on any machine.
    Quick,
    /// The size that conclusions are drawn from.
    Standard,
    /// The size of the published figures.
    Paper,
}

impl Profiles {
    /// Name and scale of a profile, its samples those that references have, so that tables say it.
    ///
    /// # Errors
    /// One line where there is no such profile or a number is wrong.
    pub(crate) fn checked(self, profile: Profile) -> Result<(&'static str, Scale), String> {
        let (name, scale) = match profile {
            Profile::Quick => ("quick", self.quick),
            Profile::Standard => ("standard", self.standard),
            Profile::Paper => ("paper", self.paper),
        };
        let scale = scale.ok_or_else(|| format!("no profile `{name}`: add [profiles.{name}]"))?;
        scale.check().map_err(|reason| format!("profiles.{name}: {reason}"))?;
        let reference_samples = path_tracer::Settings::whole_samples(scale.reference_samples);
        Ok((name, Scale { reference_samples, ..scale }))
    }
}

impl Scale {
    fn check(&self) -> Result<(), String> {
        settings::check_resolution(self.resolution)?;
        if self.resolution.iter().any(|&side| side < MIN_SIDE) {
            return Err("resolution: SSIM needs pictures of 11×11 pixels or more".into());
        }
        if self.repetitions == 0 || self.seeds.is_empty() {
            return Err("at least one repetition and one seed are needed".into());
        }
        distinct("seeds", &self.seeds)?;
        if self.reference_samples < 2 {
            return Err("`reference_samples` must be at least 2: a reference is two halves".into());
        }
        if self.seeds.contains(&REFERENCE_SEED) {
            return Err("a seed is that of the references: choose another".into());
        }
        Ok(())
    }

    /// What methods with a time budget are given.
    ///
    /// # Errors
    /// One line where a time is neither a positive number nor the baseline's, or is listed twice.
    pub(crate) fn times(&self) -> Result<Vec<Budget>, String> {
        let budget = |time: &Time| match time {
            Time::Seconds(seconds) if seconds.is_finite() && *seconds > 0.0 => {
                Ok(Budget::Seconds(*seconds))
            }
            Time::Of(name) if name == "baseline" => Ok(Budget::Baseline),
            _ => Err("times: write positive numbers of seconds or \"baseline\"".to_owned()),
        };
        let times: Vec<_> = self.times.iter().map(budget).collect::<Result<_, _>>()?;
        distinct("times", &times)?;
        Ok(times)
    }
}

/// What is listed twice would count twice: the same seed is no second sample.
pub(crate) fn distinct<T: PartialEq + std::fmt::Debug>(
    list: &str,
    values: &[T],
) -> Result<(), String> {
    let twice = values.iter().enumerate().find(|(index, value)| values[..*index].contains(value));
    let words = |value: &T| format!("{value:?}").trim_matches('"').to_owned();
    twice.map_or(Ok(()), |(_, value)| Err(format!("{list}: `{}` is listed twice", words(value))))
}
