//! What is asked: experiment files, their variants, their jobs.

pub(crate) mod columns;
pub(crate) mod crops;
pub(crate) mod experiment;
pub(crate) mod jobs;
pub(crate) mod plan;
pub(crate) mod profiles;
pub(crate) mod published;
pub(crate) mod recorded_value;
pub(crate) mod references;
pub(crate) mod settings;
pub(crate) mod sweep;
