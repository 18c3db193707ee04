//! Errors by the names of their columns in `table.csv`.

use std::fmt;
use std::str::FromStr;

use manylights_metrics::{METRICS, MetricInfo};

use crate::measurement::cell::Comparison;
use crate::names;

/// A metric of radiance or of what is shown.
#[derive(Clone, Copy)]
pub(crate) struct ErrorColumn {
    metric: &'static MetricInfo,
    linear: bool,
}

impl ErrorColumn {
    /// In the order of the table.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        let columns = [true, false].into_iter();
        let columns = columns.flat_map(|linear| METRICS.iter().map(move |metric| (metric, linear)));
        let columns = columns.map(|(metric, linear)| Self { metric, linear });
        columns.filter(|column| !(column.linear && column.metric.display_alone))
    }

    /// Its value, where it is known.
    pub(crate) fn of(self, comparison: &Comparison) -> Option<f64> {
        let errors = if self.linear { &comparison.linear } else { &comparison.display };
        (self.metric.value)(errors)
    }

    /// For axes.
    pub(crate) fn title(self) -> String {
        let values = if self.linear { "radiance" } else { "sRGB values" };
        format!("{} of {values}", self.metric.title)
    }
}

impl fmt::Display for ErrorColumn {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let space = if self.linear { "linear" } else { "display" };
        write!(formatter, "{space}_{}", self.metric.id)
    }
}

impl FromStr for ErrorColumn {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let found = Self::all().find(|column| column.to_string() == name);
        found.ok_or_else(|| {
            let known: Vec<String> = Self::all().map(|column| column.to_string()).collect();
            names::unknown("metric", name, known.iter().map(String::as_str))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_is_found_by_its_name_and_no_other_is() {
        let names: Vec<String> = ErrorColumn::all().map(|column| column.to_string()).collect();
        assert_eq!(names.len(), 2 * METRICS.len() - 1, "FLIP is of what is shown alone");
        for name in &names {
            assert_eq!(name.parse::<ErrorColumn>().expect("known").to_string(), *name);
        }
        let refused = |name: &str| name.parse::<ErrorColumn>().err().expect("unknown");
        assert!(refused("display_filp").contains("did you mean `display_flip`"));
        assert!(refused("linear_flip").contains("unknown metric"));
    }
}
