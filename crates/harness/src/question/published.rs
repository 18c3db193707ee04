//! Numbers that a paper published, set beside ours.

use std::collections::BTreeMap;

use manylights_metrics::{METRICS, MetricInfo};
use serde::Deserialize;

use crate::names;
use crate::question::plan::{Budget, Variant};
use crate::question::references::Reference;
use crate::question::sweep;
use crate::registry::Methods;

/// A published number, found among the variants of an experiment.
#[derive(Debug)]
pub(crate) struct Published {
    /// Paper and table.
    pub(crate) source: String,
    /// Name of the scene of ours that stands for the paper's.
    pub(crate) scene: String,
    /// Index into the experiment's variants.
    pub(crate) variant: usize,
    /// What is compared.
    pub(crate) quantity: Quantity,
    /// What the paper prints.
    pub(crate) value: f64,
}

/// What a published number measures.
#[derive(Debug)]
pub(crate) enum Quantity {
    /// An error of sRGB values against the reference of this name.
    Error(&'static MetricInfo, String),
    /// Time as a multiple of the baseline's: what of a paper's times holds on another machine.
    TimeRatio,
}

impl Quantity {
    const TIME_RATIO: &'static str = "time_ratio";

    /// As the experiment file says it: metric and reference.
    pub(crate) fn names(&self) -> [String; 2] {
        match self {
            Self::Error(metric, reference) => [metric.id.to_owned(), reference.clone()],
            Self::TimeRatio => [Self::TIME_RATIO.to_owned(), String::new()],
        }
    }
}

/// `[[published]]` of an experiment file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PublishedEntry {
    source: String,
    scene: String,
    method: sweep::MethodEntry,
    /// Of errors.
    reference: Option<String>,
    /// By metric.
    values: BTreeMap<String, f64>,
}

impl PublishedEntry {
    /// Finds what the numbers are compared with.
    ///
    /// # Errors
    /// One line where the experiment has no such variant, reference or metric.
    pub(crate) fn resolve(
        &self,
        methods: Methods,
        variants: &[Variant],
        times: &[Budget],
        references: &[Reference],
    ) -> Result<Vec<Published>, String> {
        let at = |reason: String| format!("published ({}): {reason}", self.source);
        let [wanted] = &self.method.variants(methods, times).map_err(at)?[..] else {
            return Err(at("parameters and times must be single values".into()));
        };
        let variant = variants.iter().position(|variant| variant == wanted);
        let variant =
            variant.ok_or_else(|| at(format!("`{}` is not among the methods", wanted.label())))?;
        if let Some((metric, value)) = self.values.iter().find(|(_, value)| !value.is_finite()) {
            return Err(at(format!("`{metric}` = {value}: must be finite")));
        }
        let number = |(metric, &value): (&String, &f64)| {
            let quantity = self.quantity(metric, references).map_err(at)?;
            let (source, scene) = (self.source.clone(), self.scene.clone());
            Ok(Published { source, scene, variant, quantity, value })
        };
        self.values.iter().map(number).collect()
    }

    fn quantity(&self, metric: &str, references: &[Reference]) -> Result<Quantity, String> {
        if metric == Quantity::TIME_RATIO {
            return Ok(Quantity::TimeRatio);
        }
        let ids = METRICS.iter().map(|metric| metric.id).chain([Quantity::TIME_RATIO]);
        let known = METRICS.iter().find(|known| known.id == metric);
        let known = known.ok_or_else(|| names::unknown("metric", metric, ids))?;
        let reference = self.reference.as_deref().ok_or("an error needs a `reference`")?;
        if !references.iter().any(|known| known.name == reference) {
            return Err(format!("`{reference}` is not among the references"));
        }
        Ok(Quantity::Error(known, reference.to_owned()))
    }
}
