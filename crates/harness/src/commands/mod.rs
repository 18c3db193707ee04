//! One module a command.

pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod export;
pub(crate) mod list;
mod machine;
pub(crate) mod merge;
pub(crate) mod metrics;
pub(crate) mod plan;
pub(crate) mod render;
pub(crate) mod report;
pub(crate) mod run;
