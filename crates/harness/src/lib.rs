//! Experiments, budgets, tables, plots and the command line `manylights`.
//!
//! An experiment file ([`cli`] `run`) becomes variants (method × parameters), each of which runs on
//! each scene by the clock, is compared with the path-traced references and written down as one cell
//! of `cells.jsonl`. Tables, curves and sheets are made of the cells alone. Infrastructure never
//! names a method: [`registry::METHODS`] is the only list.

mod answer;
mod answer_files;
mod bias;
mod cell;
pub mod cli;
mod columns;
mod commands;
mod crops;
mod curves;
mod equal_time;
mod error;
mod error_scale;
mod experiment;
mod jobs;
mod journal;
mod layers;
mod lettering;
mod measure;
mod names;
mod numbers;
mod output;
mod plan;
mod progress;
mod provenance;
mod published;
mod reference;
pub mod registry;
mod regression;
mod report;
mod scene_run;
mod series;
mod session;
mod settings;
mod sheet;
mod stage;
mod statistics;
mod style;
mod sweep;
mod table;
mod time_budget;

pub use error::Failure;
