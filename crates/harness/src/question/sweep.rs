//! Sweeps: from lists of values to variants.

use manylights_method::{Method, Parameters};
use manylights_scene::Visibility;
use serde::Deserialize;

use crate::question::plan::{Bounded, Budget, Variant};
use crate::question::settings;
use crate::registry::{self, Methods};

/// A method of an experiment file, with one value or a list of them for each parameter.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MethodEntry {
    id: String,
    #[serde(default)]
    parameters: toml::Table,
    visibility: Option<Visibilities>,
    #[serde(default)]
    budget: Kind,
}

/// One visibility of the last segment or several.
#[derive(Deserialize)]
#[serde(untagged, expecting = "visibility is \"traced\", \"ignored\" or a list of them")]
enum Visibilities {
    One(String),
    Each(Vec<String>),
}

/// What bounds the work of a method.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Kind {
    /// The parameters as written.
    #[default]
    Count,
    /// The times of the profile, one after the other, each for one frame.
    Time,
    /// The same, each for the bake.
    BuildTime,
    /// The same, each for both.
    TotalTime,
}

impl Kind {
    fn bounded(self) -> Option<Bounded> {
        match self {
            Self::Count => None,
            Self::Time => Some(Bounded::Time),
            Self::BuildTime => Some(Bounded::BuildTime),
            Self::TotalTime => Some(Bounded::TotalTime),
        }
    }
}

impl MethodEntry {
    /// One variant for each combination of the values; where time is the budget, one for each of
    /// these and each of `times`.
    ///
    /// # Errors
    /// One line for an unknown method or parameter (the nearest is named) or a value out of range.
    pub(crate) fn variants(
        &self,
        methods: Methods,
        times: &[Budget],
    ) -> Result<Vec<Variant>, String> {
        let place = registry::place(methods, &self.id)?;
        let method = methods[place];
        let budgets = self.budgets(method, times)?;
        let grid = self.grid()?;
        if grid.is_empty() {
            return Err(format!("methods: `{}` has a parameter without values", self.id));
        }
        let is_list = |name: &str| matches!(self.parameters.get(name), Some(toml::Value::Array(_)));
        let names = method.parameters().iter().map(|info| info.name);
        let swept = names.into_iter().find(|name| is_list(name));
        let swept = swept.or(method.cost().map(|cost| cost.parameter));
        // Where nothing is searched no time is bounded: such a variant is one without a budget.
        let bounded = self.budget.bounded().filter(|_| method.cost().is_some()).unwrap_or_default();
        let mut variants = Vec::new();
        for visibility in self.visibilities(method.visibility())? {
            for row in &grid {
                let pairs = row.iter().map(|(key, text)| (*key, text.as_str()));
                let parameters = settings::parameters(method, pairs)?;
                variants.extend(budgets.iter().map(|&budget| {
                    let parameters = parameters.clone();
                    Variant { method, place, parameters, swept, visibility, budget, bounded }
                }));
            }
        }
        Ok(variants)
    }

    /// The one variant of an entry without lists, and without a budget where its method has a cost.
    ///
    /// # Errors
    /// As [`Self::variants`], and for an entry that stands for several.
    pub(crate) fn single(&self, methods: Methods) -> Result<Variant, String> {
        let method = methods[registry::place(methods, &self.id)?];
        if let Some(bounded) = self.budget.bounded().filter(|_| method.cost().is_some()) {
            let (id, word) = (&self.id, bounded.word());
            return Err(format!("`{id}` has a {word} budget: set its parameters instead"));
        }
        match <[Variant; 1]>::try_from(self.variants(methods, &[])?) {
            Ok([variant]) => Ok(variant),
            Err(_) => Err("parameters and visibility must be single values".into()),
        }
    }

    fn visibilities(&self, own: Visibility) -> Result<Vec<Visibility>, String> {
        let texts = match &self.visibility {
            None => return Ok(vec![own]),
            Some(Visibilities::One(text)) => std::slice::from_ref(text),
            Some(Visibilities::Each(texts)) if texts.is_empty() => {
                return Err(format!("methods: `{}` has no visibility", self.id));
            }
            Some(Visibilities::Each(texts)) => texts,
        };
        texts.iter().map(|text| text.parse()).collect()
    }

    fn budgets<'b>(
        &self,
        method: &dyn Method,
        times: &'b [Budget],
    ) -> Result<&'b [Budget], String> {
        let Some(bounded) = self.budget.bounded() else { return Ok(&[Budget::Count]) };
        let (id, word) = (&self.id, bounded.word());
        let refuse = |reason: String| Err(format!("methods: `{id}` has a {word} budget, {reason}"));
        let defaults = Parameters::defaults(method.parameters());
        let builds = || method.baking().is_some_and(|baking| baking.depends_on(&defaults).amount);
        // Without an amount of work there is nothing to search: one run tells its time.
        let Some(cost) = method.cost().map(|cost| cost.parameter) else {
            return Ok(&[Budget::Count]);
        };
        if times.is_empty() {
            return refuse("but the profile no `times`".into());
        }
        if self.parameters.contains_key(cost) {
            return refuse(format!("which sets `{cost}`: leave it out"));
        }
        if bounded == Bounded::BuildTime && !builds() {
            return refuse(format!("but bakes nothing that grows with `{cost}`: use time"));
        }
        Ok(times)
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
