//! One module a command.

pub(crate) mod list;
pub(crate) mod metrics;
pub(crate) mod render;
pub(crate) mod report;
pub(crate) mod run;
