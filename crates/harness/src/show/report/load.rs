//! An answer read back from its folder, without the scenes.

use std::collections::BTreeMap;
use std::path::Path;

use clap::ValueEnum;

use crate::error::Failure;
use crate::measurement::cell::{Cell, Outcome};
use crate::measurement::inputs::ReferenceInputs;
use crate::measurement::journal;
use crate::measurement::provenance::Provenance;
use crate::measurement::reference::SceneReference;
use crate::measurement::scene_cells::SceneCells;
use crate::question::experiment::{self, Experiment, Profile};
use crate::question::plan::Turn;
use crate::question::references::Reference;
use crate::registry::Methods;

/// What `manylights run` left in a folder.
pub(crate) struct Loaded {
    /// The question, in the profile of the last cell.
    pub(crate) experiment: Experiment,
    /// Cells and references of each scene, in the order in which they ran.
    pub(crate) scenes: Vec<SceneCells>,
    /// Where the cells were made: that of one on the adapter, where there is one.
    pub(crate) machine: Provenance,
}

/// Reads `experiment.toml`, `cells.jsonl` and the pictures of `directory`.
///
/// # Errors
/// One line where one of them is missing or does not belong to the others.
pub(crate) fn load(directory: &Path, methods: Methods) -> Result<Loaded, Failure> {
    let file = directory.join("experiment.toml");
    let refuse = |reason: &str| {
        Failure::input(format!(
            "{}: {reason}: first manylights run {}",
            directory.display(),
            file.display()
        ))
    };
    let journal::Contents { cells, problems } = journal::read(&directory.join("cells.jsonl"))?;
    for problem in problems {
        eprintln!("{problem}; left out");
    }
    let last = cells.last().ok_or_else(|| refuse("there are no cells in cells.jsonl"))?;
    let experiment = profile_of(last, &file, methods)?
        .ok_or_else(|| refuse("the last cell is of another experiment or profile"))?;
    let mut scenes: Vec<(String, BTreeMap<Key<'_>, &Cell>)> = Vec::new();
    for cell in &cells {
        let Some(turn) = turn_of(cell, &experiment) else { continue };
        let name = cell.inputs.view();
        let index = scenes.iter().position(|(scene, _)| *scene == name).unwrap_or_else(|| {
            scenes.push((name, BTreeMap::new()));
            scenes.len() - 1
        });
        let machine = cell.provenance.machine.as_str();
        // The later cell counts: that of a newer build.
        scenes[index].1.insert((turn.repetition, turn.seed, turn.variant, machine), cell);
    }
    let on_adapter = cells.iter().rfind(|cell| cell.provenance.adapter.is_some());
    let machine = on_adapter.unwrap_or(last).provenance.clone();
    let scenes = scenes
        .into_iter()
        .map(|(name, cells)| scene_cells(&experiment, name, &cells, directory))
        .collect::<Result<_, _>>()?;
    Ok(Loaded { experiment, scenes, machine })
}

/// Repetition, seed, variant, machine: the order of a run.
type Key<'c> = (u32, u64, usize, &'c str);

/// The experiment in the profile that asks for `cell`.
fn profile_of(cell: &Cell, file: &Path, methods: Methods) -> Result<Option<Experiment>, Failure> {
    let mut refused = None;
    for &profile in Profile::value_variants() {
        match experiment::read(file, profile, methods) {
            Ok(experiment) if turn_of(cell, &experiment).is_some() => return Ok(Some(experiment)),
            Ok(_) => refused = Some(Ok(None)),
            Err(reason) => refused = refused.or(Some(Err(Failure::input(reason)))),
        }
    }
    refused.unwrap_or(Ok(None))
}

/// Which turn of an experiment a cell is; `None` where it is of another one.
fn turn_of(cell: &Cell, experiment: &Experiment) -> Option<Turn> {
    let (inputs, scale) = (&cell.inputs, &experiment.scale);
    let variant = experiment.variants.iter().position(|variant| {
        variant.method.id() == inputs.method
            && variant.given() == inputs.parameters
            && variant.budget == inputs.budget
            && variant.bounded == inputs.bounded
    })?;
    let referred = experiment.references.iter().all(|reference| {
        let asked = ReferenceInputs::new(reference, scale.reference_samples);
        inputs.references.get(&reference.name).is_some_and(|made| made.serves(&asked))
    });
    let asked = inputs.resolution == scale.resolution
        && inputs.transport == experiment.transport.to_string()
        && experiment.cameras().contains(&inputs.camera.as_deref())
        && scale.seeds.contains(&inputs.seed)
        && inputs.repetition < scale.repetitions;
    (referred && asked).then_some(Turn {
        variant,
        seed: inputs.seed,
        repetition: inputs.repetition,
    })
}

fn scene_cells(
    experiment: &Experiment,
    scene: String,
    cells: &BTreeMap<Key<'_>, &Cell>,
    directory: &Path,
) -> Result<SceneCells, Failure> {
    let done = cells.values().find_map(|cell| match &cell.outcome {
        Outcome::Done(done) => Some(done),
        _ => None,
    });
    let inputs = &cells.values().next().expect("a scene is there for a cell").inputs;
    let reference = |reference: &Reference| {
        let comparison = done.and_then(|done| done.errors.get(&reference.name));
        SceneReference::read(reference, experiment, inputs, comparison, directory)
    };
    let turn = |(&(repetition, seed, variant, _), &cell): (&Key<'_>, &&Cell)| {
        (Turn { variant, seed, repetition }, cell.clone())
    };
    Ok(SceneCells {
        exposure: inputs.exposure,
        references: experiment.references.iter().map(reference).collect::<Result<_, _>>()?,
        cells: cells.iter().map(turn).collect(),
        camera: inputs.camera.clone(),
        scene,
    })
}
