//! Sweeps: from lists of values to variants.

use serde::Deserialize;

use crate::plan::Variant;
use crate::{registry, settings};

/// A method of an experiment file, with one value or a list of them for each parameter.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Entry {
    id: String,
    #[serde(default)]
    parameters: toml::Table,
}

impl Entry {
    /// One variant for each combination of the values.
    ///
    /// # Errors
    /// One line for an unknown method or parameter (the nearest is named) or a value out of range.
    pub(crate) fn variants(&self) -> Result<Vec<Variant>, String> {
        let method = registry::method(&self.id)?;
        let grid = self.grid()?;
        if grid.is_empty() {
            return Err(format!("methods: `{}` has a parameter without values", self.id));
        }
        let is_list = |name: &str| matches!(self.parameters.get(name), Some(toml::Value::Array(_)));
        let swept = method.parameters().iter().map(|info| info.name).find(|name| is_list(name));
        grid.iter()
            .map(|row| {
                let pairs = row.iter().map(|(key, text)| (*key, text.as_str()));
                Ok(Variant { method, parameters: settings::parameters(method, pairs)?, swept })
            })
            .collect()
    }

    /// All combinations of the values, as (key, value) rows.
    fn grid(&self) -> Result<Vec<Vec<(&str, String)>>, String> {
        let mut grid = vec![Vec::new()];
        for (key, value) in &self.parameters {
            let values = match value {
                toml::Value::Array(values) => values.as_slice(),
                single => std::slice::from_ref(single),
            };
            let mut extended = Vec::with_capacity(grid.len() * values.len());
            for row in &grid {
                for value in values {
                    extended.push([row, &[(key.as_str(), number(key, value)?)][..]].concat());
                }
            }
            grid = extended;
        }
        Ok(grid)
    }
}

fn number(key: &str, value: &toml::Value) -> Result<String, String> {
    match value {
        toml::Value::Integer(number) => Ok(number.to_string()),
        toml::Value::Float(number) => Ok(number.to_string()),
        other => Err(format!("parameter `{key}` = `{other}`: must be a number or a list of them")),
    }
}
