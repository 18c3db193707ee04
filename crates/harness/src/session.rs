//! A run of an experiment: what its scenes share, and what comes out of each.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use manylights_gpu::Gpu;
use manylights_path_tracer as path_tracer;
use manylights_scene::Scene;

use crate::cell::Cell;
use crate::error::Failure;
use crate::experiment::{Experiment, REFERENCE_SEED};
use crate::journal::Journal;
use crate::plan::{Turn, interleaved};
use crate::provenance::Provenance;
use crate::reference::SceneReference;
use crate::scene_run::SceneRun;
use crate::stage::{self, Stage};
use crate::{measure, output};

/// What all scenes of a run share.
pub(crate) struct Session<'a> {
    /// The question.
    pub(crate) experiment: &'a Experiment,
    /// Where cells are written.
    pub(crate) journal: Journal,
    /// Folder of the results.
    pub(crate) out: &'a Path,
    /// Folder of the references.
    pub(crate) cache: &'a Path,
    /// Where a method needs it.
    pub(crate) gpu: Option<Gpu>,
    /// Of cells on the adapter.
    pub(crate) on_gpu: Provenance,
    /// Of cells on the host.
    pub(crate) on_cpu: Provenance,
}

/// A scene with all its cells.
pub(crate) struct SceneCells {
    /// Its name.
    pub(crate) scene: String,
    /// Its exposure.
    pub(crate) exposure: f32,
    /// In the order of the experiment's references.
    pub(crate) references: Vec<SceneReference>,
    /// In the order in which they ran.
    pub(crate) cells: Vec<(Turn, Cell)>,
}

impl<'a> Session<'a> {
    /// Opens the journal of `out` and, where a method needs it, the adapter.
    ///
    /// # Errors
    /// One line where a folder cannot be written or there is no such adapter.
    pub(crate) fn open(
        experiment: &'a Experiment,
        out: &'a Path,
        cache: &'a Path,
        adapter: Option<&str>,
    ) -> Result<Self, Failure> {
        output::check_directory(&out.join("cells"), "--out")?;
        let journal = Journal::open(out)?;
        let methods = experiment.variants.iter().map(|variant| variant.method);
        let gpu = stage::open_gpu(methods, adapter)?;
        let on_gpu = Provenance::here(gpu.as_ref());
        let on_cpu = Provenance { adapter: None, ..on_gpu.clone() };
        Ok(Self { experiment, journal, out, cache, gpu, on_gpu, on_cpu })
    }

    /// Renders the references of a scene and those cells of some variants that are not in the
    /// journal.
    ///
    /// # Errors
    /// One line where the scene cannot be rendered or a file cannot be written. Cells that fail are
    /// recorded as such and do not stop the others.
    pub(crate) fn scene(
        &mut self,
        scene: &Scene,
        variants: &[usize],
    ) -> Result<SceneCells, Failure> {
        let experiment = self.experiment;
        let gpu = self.gpu.clone();
        let stage = Stage::new(scene, None, experiment.scale.resolution, gpu.as_ref())?;
        let references = self.references(scene, &stage)?;
        for reference in &references {
            reference.write(&scene.name, self.out)?;
        }
        let scale = &experiment.scale;
        let turns = interleaved(variants, &scale.seeds, scale.repetitions);
        let content = path_tracer::content_hash(scene, stage.camera);
        let amounts = vec![None; experiment.variants.len()];
        let mut run = SceneRun {
            session: self,
            stage,
            content,
            references: &references,
            amounts,
            refused: BTreeMap::new(),
            ran: false,
        };
        let mut cells = run.turns(&turns)?;
        run.correct_times(&mut cells)?;
        Ok(SceneCells { scene: scene.name.clone(), exposure: scene.exposure, references, cells })
    }

    /// Drops what older builds left of the same cells, pictures included.
    ///
    /// # Errors
    /// One line where the journal cannot be written.
    pub(crate) fn retire(&mut self, scene: &SceneCells) -> Result<(), Failure> {
        let current: Vec<&Cell> = scene.cells.iter().map(|(_, cell)| cell).collect();
        for key in self.journal.retire(&current)? {
            let path = image_path(self.out, &scene.scene, &key);
            for extension in ["exr", "png", "layers.exr"] {
                // Repetitions have no picture, and one that stays harms nobody.
                let _ = std::fs::remove_file(path.with_extension(extension));
            }
        }
        Ok(())
    }

    fn references(&self, scene: &Scene, stage: &Stage<'_>) -> Result<Vec<SceneReference>, Failure> {
        let experiment = self.experiment;
        let render = |&visibility| {
            let settings = path_tracer::Settings {
                transport: measure::with_visibility(experiment.transport, visibility),
                resolution: experiment.scale.resolution,
                seed: REFERENCE_SEED,
                samples: experiment.scale.reference_samples,
            };
            SceneReference::render(scene, stage.camera, &settings, visibility, self.cache)
        };
        experiment.references.iter().map(render).collect()
    }
}

/// The picture of a cell, without extension. The name is the key's: settings may be many.
pub(crate) fn image_path(out: &Path, scene: &str, key: &str) -> PathBuf {
    out.join("cells").join(format!("{scene}-{}", &key[..16]))
}
