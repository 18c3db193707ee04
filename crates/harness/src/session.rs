//! Runs the cells of an experiment, scene by scene.

use std::path::{Path, PathBuf};

use manylights_gpu::Gpu;
use manylights_method::{Error, Processor};
use manylights_path_tracer as path_tracer;
use manylights_scene::Scene;

use crate::cell::{Cell, Done, Inputs, Outcome, image_sha256};
use crate::error::{Failure, one_line};
use crate::experiment::{Experiment, REFERENCE_SEED};
use crate::journal::Journal;
use crate::measure::{self, Measured};
use crate::plan::{Turn, Variant, interleaved};
use crate::progress::Progress;
use crate::provenance::Provenance;
use crate::reference::SceneReference;
use crate::stage::Stage;

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

/// One scene in the making.
struct SceneRun<'s, 'a> {
    session: &'s mut Session<'a>,
    stage: Stage<'s>,
    content: String,
    references: &'s [SceneReference],
}

impl Session<'_> {
    /// Renders the references of a scene and those of its cells that are not in the journal.
    ///
    /// # Errors
    /// One line where the scene cannot be rendered or a file cannot be written. Cells that fail are
    /// recorded as such and do not stop the others.
    pub(crate) fn scene(&mut self, scene: &Scene) -> Result<SceneCells, Failure> {
        let experiment = self.experiment;
        let gpu = self.gpu.clone();
        let stage = Stage::new(scene, None, experiment.scale.resolution, gpu.as_ref())?;
        let references = self.references(scene, &stage)?;
        let scale = &experiment.scale;
        let turns = interleaved(experiment.variants.len(), &scale.seeds, scale.repetitions);
        let content = path_tracer::content_hash(scene, stage.camera);
        let mut run = SceneRun { session: self, stage, content, references: &references };
        let cells = run.turns(&turns)?;
        Ok(SceneCells { scene: scene.name.clone(), exposure: scene.exposure, references, cells })
    }

    fn references(
        &self,
        scene: &Scene,
        stage: &Stage<'_>,
    ) -> Result<Vec<SceneReference>, Failure> {
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

impl SceneRun<'_, '_> {
    fn turns(&mut self, turns: &[Turn]) -> Result<Vec<(Turn, Cell)>, Failure> {
        let mut progress = Progress::new(&self.stage.scene.name);
        let experiment = self.session.experiment;
        let mut warm = vec![false; experiment.variants.len()];
        let mut cells: Vec<(Turn, Cell)> = Vec::with_capacity(turns.len());
        for (done, &turn) in turns.iter().enumerate() {
            progress.set(done as u64, turns.len() as u64);
            let variant = &experiment.variants[turn.variant];
            let inputs = self.inputs(variant, turn);
            let provenance = self.provenance(variant).clone();
            let key = inputs.key(&provenance);
            if let Some(cell) = self.finished(&key, turn) {
                cells.push((turn, cell));
                continue;
            }
            if !std::mem::replace(&mut warm[turn.variant], true) {
                self.warm_up(variant, turn);
            }
            let outcome = self.outcome(variant, turn, &key, &cells)?;
            let cell = Cell { key, inputs, outcome, provenance };
            self.session.journal.append(&cell)?;
            progress.line(&self.summary(turn, &cell));
            cells.push((turn, cell));
        }
        Ok(cells)
    }

    fn inputs(&self, variant: &Variant, turn: Turn) -> Inputs {
        let experiment = self.session.experiment;
        Inputs {
            scene: self.stage.scene.name.clone(),
            scene_content: self.content.clone(),
            method: variant.method.id().to_owned(),
            parameters: variant.parameters.iter().map(|(k, v)| (k.to_owned(), v)).collect(),
            seed: turn.seed,
            repetition: turn.repetition,
            transport: experiment.transport.to_string(),
            resolution: self.stage.resolution,
            exposure: self.stage.scene.exposure,
            references: self
                .references
                .iter()
                .map(|reference| (reference.visibility.to_string(), reference.samples))
                .collect(),
        }
    }

    fn provenance(&self, variant: &Variant) -> &Provenance {
        match variant.method.processor() {
            Processor::Cpu => &self.session.on_cpu,
            Processor::Gpu => &self.session.on_gpu,
        }
    }

    /// A cell of the journal that need not run again: it did not fail, and its picture, if it had
    /// one, is still there.
    fn finished(&self, key: &str, turn: Turn) -> Option<Cell> {
        let cell = self.session.journal.get(key)?;
        let good = match cell.outcome {
            Outcome::Done(_) if turn.repetition == 0 => {
                self.image_path(key).with_extension("exr").exists()
            }
            Outcome::Done(_) | Outcome::Declined { .. } => true,
            Outcome::Failed { .. } => false,
        };
        good.then(|| cell.clone())
    }

    fn image_path(&self, key: &str) -> PathBuf {
        image_path(self.session.out, &self.stage.scene.name, key)
    }

    /// Drivers compile at the first dispatch: that one is outside the clock.
    fn warm_up(&self, variant: &Variant, turn: Turn) {
        if variant.method.processor() == Processor::Gpu {
            // What fails here fails again by the clock, where it is recorded.
            let _ = self.measure(variant, turn);
        }
    }

    fn measure(&self, variant: &Variant, turn: Turn) -> Result<Measured, Error> {
        let frame = self.stage.frame(self.session.experiment.transport, turn.seed);
        measure::measure(variant.method, &frame, None, &variant.parameters, &mut |_| {})
    }

    fn outcome(
        &self,
        variant: &Variant,
        turn: Turn,
        key: &str,
        earlier: &[(Turn, Cell)],
    ) -> Result<Outcome, Failure> {
        let measured = match self.measure(variant, turn) {
            Ok(measured) => measured,
            Err(Error::Declined(reason)) => {
                return Ok(Outcome::Declined { reason: one_line(&reason) });
            }
            Err(Error::Failed(reason)) => return Ok(Outcome::Failed { reason: one_line(&reason) }),
        };
        if turn.repetition == 0 {
            self.write_image(&measured, key)?;
        }
        Ok(match self.done(measured) {
            Ok(done) if differs(&done, turn, earlier) => Outcome::Failed {
                reason: "the picture differs from that of the first repetition".into(),
            },
            Ok(done) => Outcome::Done(Box::new(done)),
            Err(error) => Outcome::Failed { reason: error.to_string() },
        })
    }

    fn write_image(&self, measured: &Measured, key: &str) -> Result<(), Failure> {
        let path = self.image_path(key);
        let attributes = [("manylights.cell".to_owned(), key.to_owned())];
        measured
            .image
            .write_exr(&path.with_extension("exr"), &attributes)
            .and_then(|()| {
                measured.image.write_png(&path.with_extension("png"), self.stage.scene.exposure)
            })
            .map_err(Failure::input)
    }

    fn done(&self, measured: Measured) -> Result<Done, manylights_metrics::Error> {
        let errors = self
            .references
            .iter()
            .map(|reference| {
                Ok((reference.visibility.to_string(), reference.compare(&measured.image)?))
            })
            .collect::<Result<_, manylights_metrics::Error>>()?;
        Ok(Done {
            visibility: measure::visibility(measured.transport).map(|v| v.to_string()),
            prepare_seconds: measured.prepare_seconds,
            step_seconds: measured.step_seconds,
            pass_seconds: measured.pass_seconds,
            counters: measured.counters,
            image_sha256: image_sha256(&measured.image),
            errors,
        })
    }

    fn summary(&self, turn: Turn, cell: &Cell) -> String {
        let variant = self.session.experiment.variants[turn.variant].label();
        let what = match &cell.outcome {
            Outcome::Done(done) => {
                let errors: Vec<_> = done
                    .errors
                    .iter()
                    .map(|(reference, e)| format!("{reference} {:.4}", e.display.rmse))
                    .collect();
                format!("{:.4} s, RMSE (sRGB) {}", done.step_seconds, errors.join(", "))
            }
            Outcome::Declined { reason } => format!("declined: {reason}"),
            Outcome::Failed { reason } => format!("FAILED: {reason}"),
        };
        format!(
            "{} {variant} seed {} run {}: {what}",
            self.stage.scene.name,
            turn.seed,
            turn.repetition + 1
        )
    }
}

/// The picture of a cell, without extension. The name is the key's: settings may be many.
pub(crate) fn image_path(out: &Path, scene: &str, key: &str) -> PathBuf {
    out.join("cells").join(format!("{scene}-{}", &key[..16]))
}

/// Whether a repetition gave other bits than the first run of the same cell.
fn differs(done: &Done, turn: Turn, earlier: &[(Turn, Cell)]) -> bool {
    let first = Turn { repetition: 0, ..turn };
    earlier.iter().any(|(turn, cell)| {
        *turn == first
            && matches!(&cell.outcome, Outcome::Done(other) if other.image_sha256 != done.image_sha256)
    })
}
