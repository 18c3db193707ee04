//! Parameters of methods: declared once, checked once, read by name.

use std::collections::BTreeMap;
use std::fmt;

use crate::Error;

/// The kind of a parameter, with its default and its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterKind {
    /// A whole number in `min..=max`.
    Count {
        /// Where nothing is set.
        default: u64,
        /// Smallest.
        min: u64,
        /// Largest.
        max: u64,
    },
    /// A finite number in `min..=max`.
    Real {
        /// Where nothing is set.
        default: f64,
        /// Smallest.
        min: f64,
        /// Largest.
        max: f64,
    },
}

/// A parameter as `list methods` shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterInfo {
    /// The key of `--set KEY=VALUE`.
    pub name: &'static str,
    /// What it does, with its unit.
    pub help: &'static str,
    /// Kind, default, range.
    pub kind: ParameterKind,
    /// As written, the value at which the method does what it did before it had the parameter: results
    /// from before hold for it. `None` of parameters that were there from the start.
    pub introduced: Option<&'static str>,
}

/// Those that several kinds of virtual lights have.
impl ParameterInfo {
    /// The lights of a picture.
    pub const LIGHTS: Self = Self {
        name: "lights",
        help: "cells of the reflective shadow maps, rounded up to whole square maps",
        kind: ParameterKind::Count { default: 400, min: 1, max: 1 << 24 },
        introduced: None,
    };

    /// Where radii come from, of lights that are spheres.
    pub const RADIUS: Self = Self {
        name: "radius",
        help: "0 = ten nearest lights, 1 = r₁ (thesis 5.9), 2 = r₂ (thesis 5.12), 3 = one metre",
        kind: ParameterKind::Count { default: 2, min: 0, max: 3 },
        introduced: None,
    };

    /// Of radii, of lights that are spheres.
    pub const SCALE: Self = Self {
        name: "scale",
        help: "factor on all radii; the thesis advises 1 to 2; 0 = point lights",
        kind: ParameterKind::Real { default: 1.0, min: 0.0, max: 1e6 },
        introduced: None,
    };
}

/// Checked values for all parameters of one method.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub struct Parameters {
    values: BTreeMap<&'static str, f64>,
}

impl Parameters {
    /// Nothing set.
    pub fn defaults(infos: &'static [ParameterInfo]) -> Self {
        Self { values: infos.iter().map(|info| (info.name, info.kind.value())).collect() }
    }

    /// The defaults of `infos` overridden by `settings` (key, value as written).
    ///
    /// # Errors
    /// One line that names the key, what is wrong and what is allowed.
    pub fn new<'s>(
        infos: &'static [ParameterInfo],
        settings: impl IntoIterator<Item = (&'s str, &'s str)>,
    ) -> Result<Self, String> {
        let Self { mut values } = Self::defaults(infos);
        for (key, text) in settings {
            let Some(info) = infos.iter().find(|info| info.name == key) else {
                let known: Vec<_> = infos.iter().map(|info| info.name).collect();
                return Err(format!("unknown parameter `{key}`: known are {}", known.join(", ")));
            };
            values.insert(info.name, info.parse(text)?);
        }
        Ok(Self { values })
    }

    /// The same values but for one `Count`.
    ///
    /// # Panics
    /// Where the method did not declare `name`.
    pub fn with_count(&self, name: &str, value: u64) -> Self {
        let mut changed = self.clone();
        *changed.values.get_mut(name).expect("a declared parameter") = value as f64;
        changed
    }

    /// The value of a `Real`.
    ///
    /// # Panics
    /// Where the method did not declare `name`.
    pub fn real(&self, name: &str) -> f64 {
        self.values[name]
    }

    /// The value of a `Count`.
    ///
    /// # Panics
    /// Where the method did not declare `name`.
    pub fn count(&self, name: &str) -> u64 {
        self.values[name] as u64
    }

    /// Names and values, in the order of the names.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, f64)> + '_ {
        self.values.iter().map(|(&name, &value)| (name, value))
    }
}

/// `name=value` pairs, separated by spaces.
impl fmt::Display for Parameters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let pairs: Vec<_> = self.iter().map(|(name, value)| format!("{name}={value}")).collect();
        f.write_str(&pairs.join(" "))
    }
}

impl ParameterInfo {
    /// Whether a result at this value is one from before the parameter was introduced.
    pub fn is_as_before(&self, value: f64) -> bool {
        self.introduced.is_some_and(|text| self.parse(text) == Ok(value))
    }

    fn parse(&self, text: &str) -> Result<f64, String> {
        let refuse =
            |range: String| Err(format!("parameter `{}` = `{text}`: must be {range}", self.name));
        match self.kind {
            ParameterKind::Count { min, max, .. } => match text.parse::<u64>() {
                Ok(value) if (min..=max).contains(&value) => Ok(value as f64),
                _ => refuse(format!("a whole number from {min} to {max}")),
            },
            ParameterKind::Real { min, max, .. } => match text.parse::<f64>() {
                Ok(value) if (min..=max).contains(&value) => Ok(value),
                _ => refuse(format!("a number from {min} to {max}")),
            },
        }
    }
}

impl ParameterKind {
    fn value(self) -> f64 {
        match self {
            Self::Count { default, .. } => default as f64,
            Self::Real { default, .. } => default,
        }
    }
}

impl From<String> for Error {
    fn from(reason: String) -> Self {
        Self::Failed(reason)
    }
}
