//! `manylights report`.

use crate::answer_files;
use crate::cli::ReportArguments;
use crate::error::Failure;
use crate::report::{self, Loaded, Report};

/// Writes the page of the results in a folder.
///
/// # Errors
/// One line where the folder does not hold the results of an experiment.
pub(crate) fn run(arguments: &ReportArguments) -> Result<(), Failure> {
    let directory = &arguments.directory;
    let Loaded { experiment, scenes, machine } = report::load(directory)?;
    let answers = answer_files::answers(&experiment, &scenes, directory)?;
    let command = report::command(&directory.join("experiment.toml"), &experiment, None);
    Report {
        experiment: &experiment,
        cells: &scenes,
        answers: &answers,
        machine: &machine,
        command,
    }
    .write(directory)
}
