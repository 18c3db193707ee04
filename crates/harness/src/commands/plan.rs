//! `manylights plan`.

use serde_json::json;

use crate::commands::run;
use crate::error::Failure;
use crate::output::{print_json, say};
use crate::question::experiment;
use crate::question::jobs;
use crate::question::profiles::Profile;
use crate::registry::Methods;
use clap::Args;
use std::path::PathBuf;

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

/// Lists the jobs of an experiment, for `run --cell` on other machines.
///
/// # Errors
/// One line for bad input.
pub(crate) fn run(arguments: &PlanArguments, methods: Methods) -> Result<(), Failure> {
    let experiment = experiment::read(&arguments.experiment, arguments.profile, methods);
    let experiment = experiment.map_err(Failure::input)?;
    let scenes = run::load(&experiment, arguments.assets.as_deref())?;
    let jobs = jobs::of_experiment(&experiment, &scenes)?;
    let cells = experiment.scale.seeds.len() * experiment.scale.repetitions as usize;
    if !arguments.json {
        for job in &jobs {
            say(format_args!("{} {} ({cells} runs)", &job.key[..16], job.label));
        }
        return Ok(());
    }
    let line = |job: &jobs::Job| {
        let variant = &experiment.variants[job.variant];
        json!({
            "key": job.key,
            "scene": scenes[job.scene].name,
            "camera": experiment.cameras()[job.camera],
            "method": variant.method.id(),
            "label": job.label,
            "budget": variant.budget,
            "bounded": variant.bounded,
            "runs": cells,
        })
    };
    print_json(&jobs.iter().map(line).collect())
}
