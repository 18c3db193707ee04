//! Experiments, budgets, tables, plots and the command line `manylights`.
//!
//! An experiment file ([`cli`] `run`) becomes variants (method × parameters), each of which runs on
//! each scene by the clock, is compared with the path-traced references and written down as one cell
//! of `cells.jsonl`. Tables, curves and sheets are made of the cells alone. Infrastructure never
//! names a method: [`registry::METHODS`] is the only list.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod answer;
pub mod cli;
mod commands;
mod error;
mod measurement;
mod names;
mod output;
mod progress;
mod question;
pub mod registry;
mod show;

pub use error::Failure;
