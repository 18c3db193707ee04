//! The command line: a contract that other tools call.

use std::ffi::OsString;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};

use crate::commands;
use crate::error::{Failure, one_line};
use crate::registry::Methods;

#[derive(Parser)]
#[command(
    name = "manylights",
    version,
    about = "Compares many-light global-illumination methods with a path-traced reference"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Lists methods, scenes or experiments
    List(commands::list::ListArguments),
    /// Renders one picture
    #[command(after_help = RENDER_EXAMPLES)]
    Render(commands::render::RenderArguments),
    /// Prints the errors of a picture against a reference
    Metrics(commands::metrics::MetricsArguments),
    /// Runs an experiment and writes tables, curves and pictures
    #[command(after_help = RUN_EXAMPLES)]
    Run(commands::run::RunArguments),
    /// Writes report.html, a page that needs no network, from the results in a folder
    Report(commands::report::ReportArguments),
    /// Lists the jobs of an experiment, for `run --cell` on other machines
    Plan(commands::plan::PlanArguments),
    /// Brings the results of several folders into one and writes its answer
    Merge(commands::merge::MergeArguments),
    /// Compares a fresh quick run with a committed baseline
    #[command(after_help = CHECK_EXAMPLES)]
    Check(commands::check::CheckArguments),
    /// Prints results in the format of a benchmark tracker
    Export(commands::export::ExportArguments),
    /// Prints the completions of a shell
    Completions {
        /// Which shell
        shell: clap_complete::Shell,
    },
}

const RENDER_EXAMPLES: &str = "\
Examples:
  manylights render --scene cornell --method vpl --set lights=4096 -o cornell.exr
  manylights render --scene hall.glb --method reference --transport all -o truth.exr";

const RUN_EXAMPLES: &str = "\
Examples:
  manylights run results/first-light/experiment.toml --profile quick
  manylights run results/equal-time/experiment.toml --profile standard --out results/mine";

const CHECK_EXAMPLES: &str = "\
Examples:
  manylights check                                 # exit status 1 and a table where something moved
  manylights check --baseline results/check --bless # what moved was meant to";

/// Runs the program with these methods to choose from. Help and version go to standard output, as
/// everywhere.
///
/// # Errors
/// One line and an exit status; see [`Failure`].
pub fn run(arguments: impl IntoIterator<Item = OsString>, methods: Methods) -> Result<(), Failure> {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error)
            if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) =>
        {
            // In colour on a terminal, unless NO_COLOR says otherwise. A closed pipe is no error.
            let _ = error.print();
            return Ok(());
        }
        Err(error) => return Err(Failure::BadInput(mend(&error))),
    };
    match cli.command {
        Command::List(arguments) => commands::list::run(&arguments, methods),
        Command::Render(arguments) => commands::render::run(&arguments, methods),
        Command::Metrics(arguments) => commands::metrics::run(&arguments),
        Command::Run(arguments) => commands::run::run(&arguments, methods),
        Command::Report(arguments) => commands::report::run(&arguments, methods),
        Command::Plan(arguments) => commands::plan::run(&arguments, methods),
        Command::Merge(arguments) => commands::merge::run(&arguments, methods),
        Command::Check(arguments) => commands::check::run(&arguments, methods),
        Command::Export(arguments) => commands::export::run(&arguments),
        Command::Completions { shell } => commands::completions::run(shell, &mut Cli::command()),
    }
}

/// clap explains in paragraphs; the contract wants a line. Usage is left to `--help`.
fn mend(error: &clap::Error) -> String {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        let commands = Cli::command();
        let names: Vec<_> = commands.get_subcommands().map(clap::Command::get_name).collect();
        return format!("a command is missing: {}; see manylights --help", names.join(", "));
    }
    let text = error.to_string();
    let explanation = text.split("\n\nUsage:").next().unwrap_or(&text);
    let explanation = explanation.split("\n\nFor more information").next().unwrap_or(explanation);
    let line = one_line(explanation);
    format!("{}; see manylights --help", line.strip_prefix("error: ").unwrap_or(&line))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
