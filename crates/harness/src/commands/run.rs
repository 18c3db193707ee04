//! `manylights run`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use manylights_scene::Scene;

use crate::answer::error_column::ErrorColumn;
use crate::answer::rows::{RowResult, SceneAnswer};
use crate::commands::machine::Machine;
use crate::error::Failure;
use crate::measurement::cell::Outcome;
use crate::measurement::inputs;
use crate::measurement::session::Session;
use crate::measurement::stage;
use crate::output;
use crate::question::experiment::{self, Experiment};
use crate::question::jobs;
use crate::question::profiles::Profile;
use crate::registry::Methods;
use crate::show::answer_files;
use crate::show::layers;
use crate::show::report;
use clap::Args;

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
    /// Error of the curves, by its column in table.csv, as display_flip [default: RMSE of sRGB values
    /// without the noise of the reference]
    #[arg(long, value_name = "NAME")]
    pub(crate) metric: Option<ErrorColumn>,
    #[command(flatten)]
    pub(crate) machine: Machine,
}

/// Runs an experiment, or what is left of it, and writes the answer.
///
/// # Errors
/// One line: bad input before anything is rendered; failed cells after everything is written.
pub(crate) fn run(arguments: &RunArguments, methods: Methods) -> Result<(), Failure> {
    let file = &arguments.experiment;
    let experiment = experiment::read(file, arguments.profile, methods).map_err(Failure::input)?;
    let beside = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let out = arguments.out.as_deref().or(beside).unwrap_or(Path::new("."));
    output::check_directory(out, "--out")?;
    let cache = stage::reference_cache(arguments.cache.as_deref())?;
    let scenes = load(&experiment, arguments.machine.assets.as_deref())?;
    keep_inputs(file, &scenes, out)?;
    let mut session =
        Session::open(&experiment, out, &cache, arguments.machine.adapter.as_deref())?;
    keep_experiment(file, out, session.journal.cells().next().is_none())?;
    if let Some(key) = &arguments.cell {
        return job(&mut session, &scenes, key);
    }
    let variants: Vec<usize> = (0..experiment.variants.len()).collect();
    scenes.iter().try_for_each(|scene| session.check_references(scene))?;
    let mut all_cells = Vec::with_capacity(scenes.len());
    for scene in &scenes {
        for camera in 0..experiment.cameras().len() {
            let cells = session.scene(scene, camera, &variants)?;
            session.retire(&cells)?;
            all_cells.push((scene, cells));
        }
    }
    let (scenes, all_cells): (Vec<_>, Vec<_>) = all_cells.into_iter().unzip();
    let command = report::command(file, &experiment, arguments.out.as_deref());
    let answers = answer_files::write(&experiment, &all_cells, command, arguments.metric, out)?;
    for ((scene, cells), answer) in scenes.into_iter().zip(&all_cells).zip(&answers) {
        layers::write(&experiment, scene, cells, answer, [&cache, out])?;
    }
    check(&answers)
}

/// Refuses results that would replace the question or what its scenes are made from.
fn keep_inputs(file: &Path, scenes: &[Scene], out: &Path) -> Result<(), Failure> {
    let mut outputs = answer_files::paths(scenes.iter().map(|scene| scene.name.as_str()), out);
    outputs.push(out.join("cells.jsonl"));
    let kept = out.join("experiment.toml");
    if !output::is_same_file(&kept, file) {
        outputs.push(kept);
    }
    let pictures = out.join("cells").read_dir().into_iter().flatten().flatten();
    outputs.extend(pictures.map(|picture| picture.path()));
    let sources = scenes.iter().flat_map(|scene| &scene.sources).map(PathBuf::as_path);
    output::keep_inputs(outputs, sources.chain([file]), "--out")
}

/// Puts the question beside the answer, for `manylights report`. The answer to another one is not
/// replaced.
fn keep_experiment(file: &Path, out: &Path, empty: bool) -> Result<(), Failure> {
    let kept = out.join("experiment.toml");
    let text = std::fs::read(file).map_err(Failure::input)?;
    match std::fs::read(&kept) {
        Ok(old) if old == text => Ok(()),
        Ok(_) if !empty => Err(Failure::input(format!(
            "{} differs from {}, which has results: choose another --out",
            file.display(),
            kept.display()
        ))),
        _ => output::write(&kept, &text),
    }
}

/// Runs the cells of one line of `plan`.
fn job(session: &mut Session<'_>, scenes: &[Scene], key: &str) -> Result<(), Failure> {
    let jobs = jobs::of_experiment(session.experiment, scenes)?;
    let job = jobs.iter().find(|job| job.key == key).ok_or_else(|| {
        Failure::input(format!("--cell {key}: not a key of this experiment; see manylights plan"))
    })?;
    session.check_references(&scenes[job.scene])?;
    let cells = session.scene(&scenes[job.scene], job.camera, &[job.variant])?;
    session.retire(&cells)?;
    let failed = cells.cells.iter().find_map(|(_, cell)| match &cell.outcome {
        Outcome::Failed { reason } => Some(reason),
        _ => None,
    });
    failed.map_or(Ok(()), |reason| Err(Failure::Failed(format!("{}: {reason}", job.label))))
}

/// The scenes of an experiment, at its exposures.
///
/// # Errors
/// One line where a scene cannot be loaded or is listed twice, and where the experiment says something of
/// one that is not listed.
pub(crate) fn load(experiment: &Experiment, assets: Option<&Path>) -> Result<Vec<Scene>, Failure> {
    let mut names = BTreeSet::new();
    let mut scenes = Vec::with_capacity(experiment.scenes.len());
    for what in &experiment.scenes {
        let mut scene = stage::load(what, assets)?;
        if let Some(&exposure) = experiment.exposures.get(&scene.name) {
            scene.exposure = exposure;
        }
        if !names.insert(scene.name.clone()) {
            return Err(Failure::input(format!("scenes: `{}` is listed twice", scene.name)));
        }
        scenes.push(scene);
    }
    let names: Vec<&str> = scenes.iter().map(|scene| scene.name.as_str()).collect();
    let cameras = experiment.cameras();
    let views: Vec<String> = names
        .iter()
        .flat_map(|name| cameras.iter().map(|camera| inputs::view(name, *camera)))
        .collect();
    experiment.check_scenes(&names, &views).map_err(Failure::input)?;
    Ok(scenes)
}

/// A cell that failed fails the comparison.
fn check(answers: &[SceneAnswer]) -> Result<(), Failure> {
    let rows = answers.iter().flat_map(|answer| answer.rows.iter().map(move |row| (answer, row)));
    let mut failed = rows.filter_map(|(answer, row)| match &row.result {
        RowResult::Failed(reason) => Some(format!("{}: {reason}", answer.scene)),
        _ => None,
    });
    match failed.next() {
        None => Ok(()),
        Some(first) => {
            let others = failed.count();
            Err(Failure::Failed(format!("comparison failed: {first} ({others} more)")))
        }
    }
}
