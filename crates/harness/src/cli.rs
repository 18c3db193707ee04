//! The command line: a contract that other tools call.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::{Args, CommandFactory, Parser, Subcommand};
use manylights_method::{Transport, Visibility};

use crate::commands;
use crate::error::{Failure, one_line};
use crate::experiment::Profile;
use crate::settings;

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
    List(ListArguments),
    /// Renders one picture
    #[command(after_help = RENDER_EXAMPLES)]
    Render(RenderArguments),
    /// Prints the errors of a picture against a reference
    Metrics(MetricsArguments),
    /// Runs an experiment and writes tables, curves and pictures
    #[command(after_help = RUN_EXAMPLES)]
    Run(RunArguments),
    /// Writes report.html, a page that needs no network, from the results in a folder
    Report(ReportArguments),
    /// Lists the jobs of an experiment, for `run --cell` on other machines
    Plan(PlanArguments),
    /// Brings the results of several folders into one and writes its answer
    Merge(MergeArguments),
    /// Compares a fresh quick run with a committed baseline
    #[command(after_help = CHECK_EXAMPLES)]
    Check(CheckArguments),
    /// Prints results in the format of a benchmark tracker
    Export(ExportArguments),
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

/// What `list` shows.
#[derive(Clone, Copy, clap::ValueEnum)]
pub(crate) enum Listed {
    Methods,
    Scenes,
    Experiments,
}

#[derive(Args)]
pub(crate) struct ListArguments {
    /// What to list
    pub(crate) what: Listed,
    /// As JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
}

/// Where things are on this machine.
#[derive(Args)]
pub(crate) struct Machine {
    /// Adapter whose name contains this
    #[arg(long, value_name = "NAME", env = "WGPU_ADAPTER_NAME")]
    pub(crate) adapter: Option<String>,
    /// Folder of the scene files' glTF assets
    #[arg(long, value_name = "DIR", env = "MANYLIGHTS_ASSETS")]
    pub(crate) assets: Option<PathBuf>,
}

#[derive(Args)]
pub(crate) struct RenderArguments {
    /// Built-in scene, scenes/NAME.toml, or a .toml, .glb or .gltf file
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) scene: String,
    /// Method (see `list methods`)
    #[arg(long, value_name = "ID")]
    pub(crate) method: String,
    /// Sets a parameter of the method
    #[arg(long, value_name = "KEY=VALUE", value_parser = settings::split)]
    pub(crate) set: Vec<(String, String)>,
    /// Light paths: direct, indirect-1 (or another number of bounces), all
    #[arg(long, default_value = "indirect-1", value_name = "PATHS")]
    pub(crate) transport: Transport,
    /// Of the last segment of indirect-1: traced, ignored [default: what the method computes]
    #[arg(long, value_name = "VISIBILITY")]
    pub(crate) visibility: Option<Visibility>,
    /// Size of the picture
    #[arg(long, default_value = "512x512", value_name = "WxH", value_parser = settings::resolution)]
    pub(crate) resolution: [u32; 2],
    /// Camera of the scene [default: its first]
    #[arg(long, value_name = "NAME")]
    pub(crate) camera: Option<String>,
    /// Same seed, same picture
    #[arg(long, default_value_t = 1, value_name = "N", allow_negative_numbers = true)]
    pub(crate) seed: u64,
    /// Radiance; a PNG at the scene's exposure is written beside it
    #[arg(short, long, value_name = "OUT.exr")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) machine: Machine,
}

#[derive(Args)]
pub(crate) struct MetricsArguments {
    /// Picture to judge
    pub(crate) image: PathBuf,
    /// What it should be
    pub(crate) reference: PathBuf,
    /// Exposure of the display-referred errors
    #[arg(long, default_value_t = 1.0, value_name = "FACTOR")]
    pub(crate) exposure: f32,
    /// As JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct RunArguments {
    /// Experiment file
    pub(crate) experiment: PathBuf,
    /// How large
    #[arg(long, value_enum, default_value = "standard")]
    pub(crate) profile: Profile,
    /// Folder of the results [default: that of the experiment file]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Runs the cells of one line of `plan` alone
    #[arg(long, value_name = "KEY")]
    pub(crate) cell: Option<String>,
    /// Folder of references [default: manylights/references in the user's cache folder]
    #[arg(long, value_name = "DIR", env = "MANYLIGHTS_CACHE")]
    pub(crate) cache: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) machine: Machine,
}

#[derive(Args)]
pub(crate) struct ReportArguments {
    /// Folder of the results, with the experiment file that `run` put there
    #[arg(value_name = "DIR")]
    pub(crate) directory: PathBuf,
}

#[derive(Args)]
pub(crate) struct PlanArguments {
    /// Experiment file
    pub(crate) experiment: PathBuf,
    /// How large
    #[arg(long, value_enum, default_value = "standard")]
    pub(crate) profile: Profile,
    /// Folder of the scene files' glTF assets
    #[arg(long, value_name = "DIR", env = "MANYLIGHTS_ASSETS")]
    pub(crate) assets: Option<PathBuf>,
    /// As JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct MergeArguments {
    /// Folders of results of one experiment
    #[arg(required = true)]
    pub(crate) directories: Vec<PathBuf>,
    /// Folder of the merged results
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
}

#[derive(Args)]
pub(crate) struct CheckArguments {
    /// Folder of the baseline: its experiment.toml and cells.jsonl
    #[arg(long, value_name = "DIR", default_value = "results/check")]
    pub(crate) baseline: PathBuf,
    /// Makes what comes out the new baseline
    #[arg(long)]
    pub(crate) bless: bool,
    /// What moved, as JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) machine: Machine,
}

/// A service that tracks benchmarks.
#[derive(Clone, Copy, clap::ValueEnum)]
pub(crate) enum Tracker {
    /// Bencher Metric Format
    Bencher,
    /// customSmallerIsBetter
    GithubActionBenchmark,
}

#[derive(Args)]
pub(crate) struct ExportArguments {
    /// Folder of results
    pub(crate) directory: PathBuf,
    /// Of which tracker
    #[arg(long, value_enum)]
    pub(crate) format: Tracker,
}

/// Runs the program. Help and version go to standard output, as everywhere.
///
/// # Errors
/// One line and an exit status; see [`Failure`].
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Result<(), Failure> {
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
        Command::List(arguments) => commands::list::run(&arguments),
        Command::Render(arguments) => commands::render::run(&arguments),
        Command::Metrics(arguments) => commands::metrics::run(&arguments),
        Command::Run(arguments) => commands::run::run(&arguments),
        Command::Report(arguments) => commands::report::run(&arguments),
        Command::Plan(arguments) => commands::plan::run(&arguments),
        Command::Merge(arguments) => commands::merge::run(&arguments),
        Command::Check(arguments) => commands::check::run(&arguments),
        Command::Export(arguments) => commands::export::run(&arguments),
        Command::Completions { shell } => {
            commands::completions::run(shell, &mut Cli::command());
            Ok(())
        }
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
