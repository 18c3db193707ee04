//! What is measured: scenes made ready, runs by the clock, cells on disk.

pub(crate) mod bakes;
#[cfg(test)]
mod bakes_test;
pub(crate) mod cell;
pub(crate) mod equal_time;
pub(crate) mod inputs;
pub(crate) mod journal;
pub(crate) mod lines;
pub(crate) mod measure;
pub(crate) mod pictures;
pub(crate) mod provenance;
pub(crate) mod reference;
pub(crate) mod scene_cells;
pub(crate) mod scene_run;
pub(crate) mod session;
pub(crate) mod stage;
pub(crate) mod tiles;
pub(crate) mod time_budget;
pub(crate) mod valid;
mod variant_run;
pub(crate) mod versions;
