//! An answer read back from its folder, without the scenes.

use std::collections::BTreeMap;
use std::path::Path;

use clap::ValueEnum;

use crate::error::Failure;
use crate::measurement::cell::Cell;
use crate::measurement::inputs::{Inputs, ReferenceInputs, Seen};
use crate::measurement::lines;
use crate::measurement::reference::SceneReference;
use crate::measurement::scene_cells::SceneCells;
use crate::output::say;
use crate::question::experiment::{self, Experiment};
use crate::question::plan::Turn;
use crate::question::profiles::Profile;
use crate::registry::Methods;

/// What `manylights run` left in a folder.
pub(crate) struct Loaded {
    /// The question, in the profile of the last cell.
    pub(crate) experiment: Experiment,
    /// Cells and references of each scene, in the order in which they ran.
    pub(crate) scenes: Vec<SceneCells>,
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
    let cells = lines::read(&directory.join("cells.jsonl"))?.told("left out");
    let last = cells.last().ok_or_else(|| refuse("there are no cells in cells.jsonl"))?;
    let experiment = profile_of(last, &file, methods)?
        .ok_or_else(|| refuse("the last cell is of another experiment or profile"))?;
    let (mut scenes, foreign) = scenes(&experiment, &cells)
        .map_err(|reason| Failure::input(format!("{}: {reason}", directory.display())))?;
    if foreign > 0 {
        let place = directory.display();
        say(format_args!("{place}: {foreign} cells of other questions or profiles are left out"));
    }
    for scene in &mut scenes {
        let read =
            |reference| SceneReference::read(reference, &experiment, &scene.cells, directory);
        scene.references = experiment.references.iter().map(read).collect::<Result<_, _>>()?;
    }
    Ok(Loaded { experiment, scenes })
}

/// The cells of an experiment scene by scene, in the order of a run, still without references; and how
/// many belong to none of its turns.
///
/// # Errors
/// One line where two cells answer the same, or a scene changed between them.
fn scenes(experiment: &Experiment, cells: &[Cell]) -> Result<(Vec<SceneCells>, usize), String> {
    let mut scenes: Vec<(String, BTreeMap<Key<'_>, &Cell>)> = Vec::new();
    let mut foreign = 0;
    for cell in cells {
        let Some(turn) = turn_of(cell, experiment) else {
            foreign += 1;
            continue;
        };
        let name = cell.inputs.view();
        let index = scenes.iter().position(|(scene, _)| *scene == name).unwrap_or_else(|| {
            scenes.push((name, BTreeMap::new()));
            scenes.len() - 1
        });
        let machine = cell.provenance.machine.as_str();
        let key = (turn.repetition, turn.seed, turn.variant, machine);
        // The later cell counts: that of a newer build, or that of a key which ran again.
        if let Some(earlier) = scenes[index].1.insert(key, cell)
            && earlier.key != cell.key
            && earlier.provenance.program == cell.provenance.program
        {
            return Err(format!(
                "cells.jsonl has two cells of one run, {} seed {} run {} on {machine}: {} and {}: \
                 remove one of the lines",
                cell.inputs.label(),
                turn.seed,
                turn.repetition + 1,
                earlier.key,
                cell.key
            ));
        }
    }
    // Not in the order of the lines: those of merged folders have another one.
    let cameras = experiment.cameras();
    scenes.sort_by_key(|(_, cells)| {
        let Inputs { scene, camera, .. } = first(cells);
        let scene = experiment.scenes.iter().position(|entry| is_named(entry, scene));
        let camera = cameras.iter().position(|known| *known == camera.as_deref());
        (scene.unwrap_or(usize::MAX), camera)
    });
    let scenes = scenes.into_iter().map(|(view, cells)| scene_cells(view, &cells));
    Ok((scenes.collect::<Result<_, _>>()?, foreign))
}

/// Whether an entry of `scenes`, a name or a file, may be the scene of this name.
fn is_named(entry: &str, name: &str) -> bool {
    entry == name || Path::new(entry).file_stem().is_some_and(|stem| stem == name)
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
    let inputs = &cell.inputs;
    let Inputs { scene, scene_content, exposure, seed, repetition, .. } = inputs;
    let seen = Seen {
        scene,
        camera: inputs.camera.as_deref(),
        content: scene_content,
        exposure: *exposure,
    };
    let (seed, repetition) = (*seed, *repetition);
    let identity = inputs.identity();
    let variant = experiment.variants.iter().position(|variant| {
        let asked = Inputs::new(experiment, variant, seen);
        let references = inputs.references.clone();
        variant.method.id() == inputs.method
            && Inputs { seed, repetition, references, ..asked }.identity() == identity
    })?;
    // Before versions were counted, a cache decided: it gave what was asked for, or better.
    let uncounted = cell.versions.is_empty();
    let good = experiment.references.iter().all(|reference| {
        let asked = ReferenceInputs::new(reference, experiment.scale.reference_samples);
        let made = inputs.references.get(&reference.name);
        made.is_some_and(|made| *made == asked || (uncounted && made.serves(&asked)))
    });
    let asked = experiment.scale.seeds.contains(&seed)
        && experiment.cameras().contains(&inputs.camera.as_deref())
        && repetition < experiment.scale.repetitions
        && experiment.exposures.get(scene).is_none_or(|wanted| wanted == exposure);
    let referred = good && inputs.references.len() == experiment.references.len();
    (asked && referred).then_some(Turn { variant, seed, repetition })
}

fn first<'c>(cells: &BTreeMap<Key<'_>, &'c Cell>) -> &'c Inputs {
    &cells.values().next().expect("a scene is there for a cell").inputs
}

fn scene_cells(view: String, cells: &BTreeMap<Key<'_>, &Cell>) -> Result<SceneCells, String> {
    let first = first(cells);
    let state = |of: &Inputs| (of.scene_content.clone(), of.exposure, of.references.clone());
    if cells.values().any(|cell| state(&cell.inputs) != state(first)) {
        return Err(format!(
            "cells.jsonl has cells of two states of `{view}` or its references: finish the run"
        ));
    }
    let turn = |(&(repetition, seed, variant, _), &cell): (&Key<'_>, &&Cell)| {
        (Turn { variant, seed, repetition }, cell.clone())
    };
    Ok(SceneCells {
        scene: view,
        exposure: first.exposure,
        references: Vec::new(),
        cells: cells.iter().map(turn).collect(),
        camera: first.camera.clone(),
    })
}

#[cfg(test)]
mod tests;
