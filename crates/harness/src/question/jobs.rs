//! An experiment cut into jobs that any machine can do alone.

use manylights_scene::Scene;

use crate::error::Failure;
use crate::measurement::inputs::{self, Inputs};
use crate::question::experiment::Experiment;

/// A variant on a scene, with all its seeds and repetitions: a median needs one machine.
pub(crate) struct Job {
    /// Hash of what is asked: the same on every machine and in every build.
    pub(crate) key: String,
    /// Index into the scenes.
    pub(crate) scene: usize,
    /// Index into the experiment's cameras.
    pub(crate) camera: usize,
    /// Index into the experiment's variants.
    pub(crate) variant: usize,
    /// Scene and variant, for people.
    pub(crate) label: String,
}

/// All jobs, scene by scene.
///
/// # Errors
/// One line where a scene has no such camera.
pub(crate) fn of_experiment(
    experiment: &Experiment,
    scenes: &[Scene],
) -> Result<Vec<Job>, Failure> {
    let mut jobs = Vec::new();
    for (index, scene) in scenes.iter().enumerate() {
        for (place, name) in experiment.cameras().into_iter().enumerate() {
            let camera = scene.camera(name).map_err(Failure::input)?;
            let content = manylights_scene::content_hash(scene, camera);
            jobs.extend(experiment.variants.iter().enumerate().map(|(number, variant)| Job {
                key: Inputs::new(experiment, scene, name, &content, variant).question(),
                scene: index,
                camera: place,
                variant: number,
                label: format!("{} {}", inputs::view(&scene.name, name), variant.label()),
            }));
        }
    }
    Ok(jobs)
}
