//! Sweeps: from lists of values to variants.

use manylights_scene::Visibility;
use serde::Deserialize;

use crate::question::plan::{Budget, Variant};
use crate::question::settings;
use crate::registry;

/// A method of an experiment file, with one value or a list of them for each parameter.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Entry {
    id: String,
    #[serde(default)]
    parameters: toml::Table,
    visibility: Option<Seen>,
    #[serde(default)]
    budget: Kind,
}

/// One visibility of the last segment or several.
#[derive(Deserialize)]
#[serde(untagged, expecting = "visibility is \"traced\", \"ignored\" or a list of them")]
enum Seen {
    One(String),
    Each(Vec<String>),
}

/// What bounds the work of a method.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    /// The parameters as written.
    #[default]
    Count,
    /// The times of the profile, one after the other.
    Time,
}

impl Entry {
    /// One variant for each combination of the values; where time is the budget, one for each of
    /// these and each of `times`.
    ///
    /// # Errors
    /// One line for an unknown method or parameter (the nearest is named) or a value out of range.
    pub(crate) fn variants(&self, times: &[Budget]) -> Result<Vec<Variant>, String> {
        let method = registry::method(&self.id)?;
        let budgets = self.budgets(method.cost().parameter, times)?;
        let grid = self.grid()?;
        if grid.is_empty() {
            return Err(format!("methods: `{}` has a parameter without values", self.id));
        }
        let is_list = |name: &str| matches!(self.parameters.get(name), Some(toml::Value::Array(_)));
        let names = method.parameters().iter().map(|info| info.name);
        let swept = names.into_iter().find(|name| is_list(name));
        let swept = swept.unwrap_or(method.cost().parameter);
        let mut variants = Vec::new();
        for visibility in self.visibilities(method.visibility())? {
            for row in &grid {
                let pairs = row.iter().map(|(key, text)| (*key, text.as_str()));
                let parameters = settings::parameters(method, pairs)?;
                variants.extend(budgets.iter().map(|&budget| {
                    let parameters = parameters.clone();
                    Variant { method, parameters, swept, visibility, budget }
                }));
            }
        }
        Ok(variants)
    }

    fn visibilities(&self, own: Visibility) -> Result<Vec<Visibility>, String> {
        let texts = match &self.visibility {
            None => return Ok(vec![own]),
            Some(Seen::One(text)) => std::slice::from_ref(text),
            Some(Seen::Each(texts)) if texts.is_empty() => {
                return Err(format!("methods: `{}` has no visibility", self.id));
            }
            Some(Seen::Each(texts)) => texts,
        };
        texts.iter().map(|text| text.parse()).collect()
    }

    fn budgets<'b>(&self, cost: &str, times: &'b [Budget]) -> Result<&'b [Budget], String> {
        match self.budget {
            Kind::Count => Ok(&[Budget::Count]),
            Kind::Time if times.is_empty() => {
                Err(format!("methods: `{}` has a time budget, but the profile no `times`", self.id))
            }
            Kind::Time if self.parameters.contains_key(cost) => Err(format!(
                "methods: `{}` has a time budget, which sets `{cost}`: leave it out",
                self.id
            )),
            Kind::Time => Ok(times),
        }
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
                    extended.push([row, &[(key.as_str(), text(key, value)?)][..]].concat());
                }
            }
            grid = extended;
        }
        Ok(grid)
    }
}

fn text(key: &str, value: &toml::Value) -> Result<String, String> {
    match value {
        toml::Value::String(word) => Ok(word.clone()),
        toml::Value::Integer(number) => Ok(number.to_string()),
        toml::Value::Float(number) => Ok(number.to_string()),
        other => Err(format!("parameter `{key}` = `{other}`: must be a number, a word or a list")),
    }
}
