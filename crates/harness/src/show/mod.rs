//! How the answer is shown: tables, curves, sheets, the report.

pub(crate) mod answer_files;
pub(crate) mod changes;
pub(crate) mod curves;
pub(crate) mod layers;
pub(crate) mod lettering;
pub(crate) mod numbers;
pub(crate) mod report;
pub(crate) mod sheet;
pub(crate) mod style;
pub(crate) mod table;
