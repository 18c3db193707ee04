//! Numbers that a paper published, set beside ours.

use manylights_method::Visibility;
use manylights_metrics::{METRICS, MetricInfo};
use serde::Deserialize;

use crate::names;
use crate::plan::{Budget, Variant};
use crate::sweep;

/// A published number, found among the variants of an experiment.
#[derive(Debug)]
pub(crate) struct Published {
    /// Paper and table.
    pub(crate) source: String,
    /// Name of the scene of ours that stands for the paper's.
    pub(crate) scene: String,
    /// Index into the experiment's variants.
    pub(crate) variant: usize,
    /// Ours is taken against this one.
    pub(crate) reference: Visibility,
    /// Of sRGB values.
    pub(crate) metric: &'static MetricInfo,
    /// What the paper prints.
    pub(crate) value: f64,
}

/// `[[published]]` of an experiment file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Entry {
    source: String,
    scene: String,
    method: sweep::Entry,
    reference: String,
    metric: String,
    value: f64,
}

impl Entry {
    /// Finds what the number is compared with.
    ///
    /// # Errors
    /// One line where the experiment has no such variant, reference or metric.
    pub(crate) fn resolve(
        &self,
        variants: &[Variant],
        times: &[Budget],
        references: &[Visibility],
    ) -> Result<Published, String> {
        let at = |reason: String| format!("published ({}): {reason}", self.source);
        let [wanted] = &self.method.variants(times).map_err(at)?[..] else {
            return Err(at("parameters and times must be single values".into()));
        };
        let variant = variants.iter().position(|variant| variant == wanted);
        let variant =
            variant.ok_or_else(|| at(format!("`{}` is not among the methods", wanted.label())))?;
        let reference = self.reference.parse().map_err(at)?;
        if !references.contains(&reference) {
            return Err(at(format!("`{reference}` is not among the references")));
        }
        let metric = METRICS.iter().find(|metric| metric.id == self.metric);
        let ids = METRICS.iter().map(|metric| metric.id);
        let metric = metric.ok_or_else(|| at(names::unknown("metric", &self.metric, ids)))?;
        let (source, scene, value) = (self.source.clone(), self.scene.clone(), self.value);
        Ok(Published { source, scene, variant, reference, metric, value })
    }
}
