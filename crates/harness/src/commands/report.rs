//! `manylights report`.

use crate::answer::error_column::ErrorColumn;
use crate::error::Failure;
use crate::registry::Methods;
use crate::show::answer_files;
use crate::show::report::{self, Loaded};
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct ReportArguments {
    /// Folder of the results, with the experiment file that `run` put there
    #[arg(value_name = "DIR")]
    pub(crate) directory: PathBuf,
    /// Error of the curves, by its column in table.csv, as display_flip [default: RMSE of sRGB values
    /// without the noise of the reference]
    #[arg(long, value_name = "NAME")]
    pub(crate) metric: Option<ErrorColumn>,
}

/// Writes the answer of a folder again, from its cells and pictures alone: tables, curves, sheets and
/// the page.
///
/// # Errors
/// One line where the folder does not hold the results of an experiment.
pub(crate) fn run(arguments: &ReportArguments, methods: Methods) -> Result<(), Failure> {
    let directory = &arguments.directory;
    let Loaded { experiment, scenes } = report::load(directory, methods)?;
    let command = report::command(&directory.join("experiment.toml"), &experiment, None);
    answer_files::write(&experiment, &scenes, command, arguments.metric, directory)?;
    Ok(())
}
