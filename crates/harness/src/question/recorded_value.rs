//! Values of parameters as results keep them.

use std::fmt;

use manylights_method::ParameterValue;
use serde::{Deserialize, Serialize};

/// The value of a parameter in a file of results, whose words no method need know any more.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum RecordedValue {
    /// Of a count or a real number.
    Number(f64),
    /// Of a choice.
    Word(String),
}

impl From<ParameterValue> for RecordedValue {
    fn from(value: ParameterValue) -> Self {
        match value {
            ParameterValue::Number(number) => Self::Number(number),
            ParameterValue::Word(word) => Self::Word(word.to_owned()),
        }
    }
}

/// As `--set` takes it.
impl fmt::Display for RecordedValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(f),
            Self::Word(word) => word.fmt(f),
        }
    }
}
