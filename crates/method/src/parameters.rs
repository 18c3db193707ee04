//! Parameters of methods: declared once, checked once, read by name.

use std::collections::BTreeMap;
use std::fmt;

use crate::Error;

/// The kind of a parameter, with its default and what it may be.
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
    /// One of some words.
    Choice {
        /// Where nothing is set, one of `words`.
        default: &'static str,
        /// All of them. Where numbers once stood for the words, they were the places in this list.
        words: &'static [ChoiceWord],
    },
}

/// One of the words that a [`ParameterKind::Choice`] may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChoiceWord {
    /// As it is written: lower case and digits, or the number of an equation.
    pub word: &'static str,
    /// What it chooses, in a line, with its source.
    pub help: &'static str,
}

/// A parameter as `list methods` shows it. The same name means the same in every method that has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterInfo {
    /// The key of `--set KEY=VALUE`.
    pub name: &'static str,
    /// What its name was once: who still uses that is told the new one.
    pub formerly: Option<&'static str>,
    /// What it does, with its unit.
    pub help: &'static str,
    /// Kind, default, range or words.
    pub kind: ParameterKind,
    /// As written, the value at which the method does what it did before it had the parameter: results
    /// from before hold for it. `None` of parameters that were there from the start.
    pub introduced: Option<&'static str>,
}

/// What a parameter is set to.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub enum ParameterValue {
    /// Of a [`ParameterKind::Count`] or [`ParameterKind::Real`].
    Number(f64),
    /// Of a [`ParameterKind::Choice`].
    Word(&'static str),
}

/// As `--set` takes it.
impl fmt::Display for ParameterValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(f),
            Self::Word(word) => word.fmt(f),
        }
    }
}

/// Checked values for all parameters of one method.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub struct Parameters {
    values: BTreeMap<&'static str, ParameterValue>,
}

impl Parameters {
    /// Nothing set.
    pub fn defaults(infos: &'static [ParameterInfo]) -> Self {
        Self { values: infos.iter().map(|info| (info.name, info.kind.default())).collect() }
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
                return Err(unknown(infos, key));
            };
            values.insert(info.name, info.parse(text)?);
        }
        Ok(Self { values })
    }

    /// The same values but for one number.
    ///
    /// # Panics
    /// Where the method did not declare `name`.
    pub fn with_number(&self, name: &str, number: f64) -> Self {
        let mut changed = self.clone();
        *changed.values.get_mut(name).expect("a declared parameter") =
            ParameterValue::Number(number);
        changed
    }

    /// The value of a `Real`, or of a `Count` that need not be told from one.
    ///
    /// # Panics
    /// Where the method did not declare `name` as a number.
    pub fn real(&self, name: &str) -> f64 {
        match self.values[name] {
            ParameterValue::Number(number) => number,
            ParameterValue::Word(word) => panic!("`{name}` is the word `{word}`, not a number"),
        }
    }

    /// The value of a `Count`.
    ///
    /// # Panics
    /// Where the method did not declare `name` as a number.
    pub fn count(&self, name: &str) -> u64 {
        self.real(name) as u64
    }

    /// What the word of a `Choice` means, by a list of all words and meanings.
    ///
    /// # Panics
    /// Where the method did not declare `name` as a choice, or the list lacks its word.
    pub fn choice<T: Copy>(&self, name: &str, meanings: &[(&str, T)]) -> T {
        let value = self.values[name];
        let meant = meanings
            .iter()
            .find(|(word, _)| matches!(value, ParameterValue::Word(w) if w == *word));
        meant.unwrap_or_else(|| panic!("`{name}` = `{value}` has no meaning")).1
    }

    /// Names and values, in the order of the names.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, ParameterValue)> + '_ {
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

fn unknown(infos: &[ParameterInfo], key: &str) -> String {
    match infos.iter().find(|info| info.formerly == Some(key)) {
        Some(info) => format!("parameter `{key}` is now called `{}`", info.name),
        None => {
            let known: Vec<_> = infos.iter().map(|info| info.name).collect();
            format!("unknown parameter `{key}`: known are {}", known.join(", "))
        }
    }
}

impl ParameterInfo {
    /// Whether a result at this value is one from before the parameter was introduced.
    pub fn is_as_before(&self, value: ParameterValue) -> bool {
        self.introduced.is_some_and(|text| self.parse(text) == Ok(value))
    }

    fn parse(&self, text: &str) -> Result<ParameterValue, String> {
        let refuse = |range: String| Err(format!("parameter `{}` = `{text}`: {range}", self.name));
        match self.kind {
            ParameterKind::Count { min, max, .. } => match text.parse::<u64>() {
                Ok(value) if (min..=max).contains(&value) => {
                    Ok(ParameterValue::Number(value as f64))
                }
                _ => refuse(format!("must be a whole number from {min} to {max}")),
            },
            ParameterKind::Real { min, max, .. } => match text.parse::<f64>() {
                Ok(value) if (min..=max).contains(&value) => Ok(ParameterValue::Number(value)),
                _ => refuse(format!("must be a number from {min} to {max}")),
            },
            ParameterKind::Choice { words, .. } => {
                if let Some(chosen) = words.iter().find(|known| known.word == text) {
                    return Ok(ParameterValue::Word(chosen.word));
                }
                let all: Vec<_> = words.iter().map(|known| known.word).collect();
                let all = all.join(", ");
                match text.parse::<usize>().ok().and_then(|code| words.get(code)) {
                    Some(new) => refuse(format!("say {}={} (words: {all})", self.name, new.word)),
                    None => refuse(format!("must be one of the words {all}")),
                }
            }
        }
    }
}

impl ParameterKind {
    fn default(self) -> ParameterValue {
        match self {
            Self::Count { default, .. } => ParameterValue::Number(default as f64),
            Self::Real { default, .. } => ParameterValue::Number(default),
            Self::Choice { default, .. } => ParameterValue::Word(default),
        }
    }
}

impl From<String> for Error {
    fn from(reason: String) -> Self {
        Self::Failed(reason)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INFOS: &[ParameterInfo] = &[
        ParameterInfo {
            name: "lights",
            formerly: None,
            introduced: None,
            help: "how many",
            kind: ParameterKind::Count { default: 4, min: 1, max: 9 },
        },
        ParameterInfo {
            name: "attenuation_radius",
            formerly: Some("radius"),
            introduced: None,
            help: "metres",
            kind: ParameterKind::Real { default: 0.5, min: 0.0, max: 2.0 },
        },
        ParameterInfo {
            name: "form",
            formerly: None,
            introduced: None,
            help: "of the lobe",
            kind: ParameterKind::Choice {
                default: "full",
                words: &[
                    ChoiceWord { word: "full", help: "any lobe" },
                    ChoiceWord { word: "zonal", help: "a circular lobe" },
                ],
            },
        },
    ];
    const FORMS: [(&str, u8); 2] = [("full", 10), ("zonal", 20)];

    #[test]
    fn words_and_numbers_are_read_by_name() {
        let defaults = Parameters::defaults(INFOS);
        assert_eq!(defaults.to_string(), "attenuation_radius=0.5 form=full lights=4");
        assert_eq!(defaults.choice("form", &FORMS), 10);
        let set = Parameters::new(INFOS, [("form", "zonal"), ("lights", "7")]).expect("allowed");
        assert_eq!((set.count("lights"), set.choice("form", &FORMS)), (7, 20));
        assert_eq!(set.iter().nth(1), Some(("form", ParameterValue::Word("zonal"))));
    }

    #[test]
    fn the_time_before_a_parameter_is_one_of_its_values() {
        let [lights, _, form] = INFOS else { panic!("three") };
        assert!(!form.is_as_before(ParameterValue::Word("full")), "it was there from the start");
        let form = ParameterInfo { introduced: Some("full"), ..*form };
        assert!(form.is_as_before(ParameterValue::Word("full")));
        assert!(!form.is_as_before(ParameterValue::Word("zonal")));
        let lights = ParameterInfo { introduced: Some("9"), ..*lights };
        assert!(lights.is_as_before(ParameterValue::Number(9.0)));
        assert!(!lights.is_as_before(ParameterValue::Number(4.0)));
    }

    #[test]
    fn what_is_not_allowed_is_answered_with_what_is() {
        for (key, text, said) in [
            ("form", "1", "parameter `form` = `1`: say form=zonal (words: full, zonal)"),
            ("form", "0", "parameter `form` = `0`: say form=full (words: full, zonal)"),
            ("form", "2", "parameter `form` = `2`: must be one of the words full, zonal"),
            ("form", "Zonal", "parameter `form` = `Zonal`: must be one of the words full, zonal"),
            ("form", "", "parameter `form` = ``: must be one of the words full, zonal"),
            ("lights", "0", "parameter `lights` = `0`: must be a whole number from 1 to 9"),
            (
                "attenuation_radius",
                "NaN",
                "parameter `attenuation_radius` = `NaN`: must be a number from 0 to 2",
            ),
            ("radius", "1", "parameter `radius` is now called `attenuation_radius`"),
            ("size", "1", "unknown parameter `size`: known are lights, attenuation_radius, form"),
        ] {
            assert_eq!(Parameters::new(INFOS, [(key, text)]), Err(said.to_owned()));
        }
    }
}
