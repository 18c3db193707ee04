//! Runs the cells of one scene and camera: warm-up, clock, errors, journal.

use std::collections::BTreeMap;
use std::path::PathBuf;

use manylights_method::{Error, Processor, Run};
use manylights_metrics::RadianceImage;
use manylights_scene::Scene;

use crate::error::Failure;
use crate::measurement::bakes::SceneHashes;
use crate::measurement::cell::{Cell, Checkpoint, Comparison, Done, Outcome, image_sha256};
use crate::measurement::inputs::{self, Inputs, Seen};
use crate::measurement::measure::MeasuredRun;
use crate::measurement::pictures::image_path;
use crate::measurement::provenance::Provenance;
use crate::measurement::reference::SceneReference;
use crate::measurement::scene_cells::SceneCells;
use crate::measurement::session::Session;
use crate::measurement::stage::Stage;
use crate::measurement::versions;
use crate::progress::ProgressBar;
use crate::question::experiment::Experiment;
use crate::question::plan::{Turn, Variant, interleaved};
use crate::question::references::Reference;

/// One scene, seen by one camera, in the making.
pub(crate) struct SceneRun<'s, 'a> {
    /// What all scenes share.
    pub(crate) session: &'s mut Session<'a>,
    /// The scene, ready.
    pub(crate) stage: &'s Stage<'s>,
    /// Index into the experiment's cameras.
    pub(crate) camera: usize,
    /// Scene and camera, for people and files.
    view: String,
    /// Hash of the content of scene and camera.
    content: String,
    /// What bakes may depend on.
    pub(crate) hashes: SceneHashes,
    /// What the pictures are compared with.
    pub(crate) references: &'s [SceneReference],
    /// Of each variant, the value of the cost parameter that its time budget was found to allow.
    pub(crate) amounts: Vec<Option<f64>>,
    /// The variants whose time budgets no amount could be found for, and why.
    pub(crate) refused: BTreeMap<usize, Outcome>,
    /// Whether any cell was not in the journal.
    pub(crate) ran: bool,
}

impl Session<'_> {
    /// Runs those cells of some variants on a scene, seen by one of the experiment's cameras, that are not
    /// in the journal; where there are any, renders the references.
    ///
    /// # Errors
    /// One line where the scene cannot be rendered or a file cannot be written. Cells that fail are
    /// recorded as such and do not stop the others.
    pub(crate) fn scene(
        &mut self,
        scene: &Scene,
        camera: usize,
        variants: &[usize],
    ) -> Result<SceneCells, Failure> {
        let experiment = self.experiment;
        let name = experiment.cameras()[camera];
        let view = inputs::view(&scene.name, name);
        let gpu = self.gpu.clone();
        let Experiment { transport, scale, .. } = experiment;
        let stage = Stage::new(scene, name, *transport, scale.resolution, gpu.as_ref())?;
        let turns = interleaved(variants, &scale.seeds, scale.repetitions);
        let content = manylights_scene::content_hash(scene, stage.camera);
        let hashes = SceneHashes::new(scene);
        self.bakes.keep_for(&hashes, |variant| {
            let Variant { method, parameters, .. } = &experiment.variants[variant];
            method.baking().map(|baking| baking.depends_on(parameters)).unwrap_or_default()
        });
        let amounts = self.replayed_amounts(scene, name);
        let mut run = SceneRun {
            session: self,
            stage: &stage,
            camera,
            view: view.clone(),
            content,
            hashes,
            references: &[],
            amounts,
            refused: BTreeMap::new(),
            ran: false,
        };
        let references = match run.kept_references(&turns) {
            Some(kept) => kept,
            None => {
                let cache = run.session.cache;
                let render =
                    |reference| SceneReference::render(reference, experiment, &stage, cache);
                let rendered: Vec<SceneReference> =
                    experiment.references.iter().map(render).collect::<Result<_, _>>()?;
                rendered.iter().try_for_each(|it| it.write(&view, run.session.out))?;
                rendered
            }
        };
        run.references = &references;
        let mut cells = run.turns(&turns)?;
        run.correct_times(&mut cells)?;
        let camera = name.map(str::to_owned);
        Ok(SceneCells { scene: view, camera, exposure: scene.exposure, references, cells })
    }

    /// Refuses references that cannot be made of a scene, before anything is rendered: methods that
    /// decline it, direct light that is not exact.
    ///
    /// # Errors
    /// One line with the reason.
    pub(crate) fn check_references(&self, scene: &Scene) -> Result<(), Failure> {
        let Experiment { transport, scale, references, .. } = self.experiment;
        let only_paths = references.iter().all(Reference::is_path_traced);
        if only_paths && *transport == transport.estimated() {
            return Ok(());
        }
        for camera in self.experiment.cameras() {
            let gpu = self.gpu.as_ref();
            let stage = Stage::new(scene, camera, *transport, scale.resolution, gpu)?;
            let check = |reference| SceneReference::check(reference, &stage);
            references.iter().try_for_each(check)?;
        }
        Ok(())
    }
}

impl SceneRun<'_, '_> {
    /// Runs what is not in the journal, in this order, and writes each cell down.
    ///
    /// # Errors
    /// One line where a file cannot be written. A cell that fails is recorded as such.
    pub(crate) fn turns(&mut self, turns: &[Turn]) -> Result<Vec<(Turn, Cell)>, Failure> {
        let mut progress = ProgressBar::new(&self.view);
        let experiment = self.session.experiment;
        let mut warm = vec![false; experiment.variants.len()];
        let mut cells: Vec<(Turn, Cell)> = Vec::with_capacity(turns.len());
        for (done, &turn) in turns.iter().enumerate() {
            progress.set(done as u64, turns.len() as u64);
            let variant = &experiment.variants[turn.variant];
            let inputs = self.inputs(variant, turn);
            let provenance = self.provenance(variant).clone();
            let versions = versions::of(variant.method, &experiment.references);
            let key = inputs.key(&versions, &provenance);
            self.recall_amount(turn.variant, &inputs, &provenance);
            if let Some(cell) = self.finished(&key, turn) {
                cells.push((turn, cell));
                continue;
            }
            if !std::mem::replace(&mut warm[turn.variant], true) {
                self.warm_up(turn);
                self.find_amount(turn);
            }
            self.ran = true;
            let outcome = self.outcome(turn, &key, &cells)?;
            let cell = Cell::new(inputs, outcome, versions, provenance);
            self.session.journal.append(&cell)?;
            progress.line(&self.summary(turn, &cell));
            cells.push((turn, cell));
        }
        Ok(cells)
    }

    /// The references that an earlier run left beside its cells, where nothing is left to run: a finished
    /// experiment renders nothing, whatever became of the cache.
    fn kept_references(&mut self, turns: &[Turn]) -> Option<Vec<SceneReference>> {
        let experiment = self.session.experiment;
        let mut cells = Vec::with_capacity(turns.len());
        for &turn in turns {
            let variant = &experiment.variants[turn.variant];
            let inputs = self.inputs(variant, turn);
            let provenance = self.provenance(variant).clone();
            self.recall_amount(turn.variant, &inputs, &provenance);
            let key =
                inputs.key(&versions::of(variant.method, &experiment.references), &provenance);
            cells.push((turn, self.finished(&key, turn)?));
        }
        let out = self.session.out;
        let kept = |reference| SceneReference::read(reference, experiment, &cells, out).ok();
        experiment.references.iter().map(kept).collect()
    }

    fn inputs(&self, variant: &Variant, turn: Turn) -> Inputs {
        let (experiment, scene) = (self.session.experiment, self.stage.scene);
        let Turn { seed, repetition, .. } = turn;
        let seen = Seen {
            scene: &scene.name,
            camera: experiment.cameras()[self.camera],
            content: &self.content,
            exposure: scene.exposure,
        };
        Inputs { seed, repetition, ..Inputs::new(experiment, variant, seen) }
    }

    fn provenance(&self, variant: &Variant) -> &Provenance {
        match variant.method.processor() {
            Processor::Cpu => &self.session.on_cpu,
            Processor::Gpu => &self.session.on_gpu,
        }
    }

    /// A cell of the journal that need not run again: it did not fail, it did the work that its
    /// variant does now, and its picture, if it had one, is still there.
    fn finished(&self, key: &str, turn: Turn) -> Option<Cell> {
        let cell = self.session.journal.get(key)?;
        let good = match &cell.outcome {
            Outcome::Done(done) => {
                self.amounts[turn.variant].is_none_or(|amount| done.amount == Some(amount))
                    && (turn.repetition > 0 || self.image_path(key).with_extension("exr").exists())
            }
            Outcome::Declined { .. } => true,
            Outcome::Failed { .. } => false,
        };
        good.then(|| cell.clone())
    }

    fn image_path(&self, key: &str) -> PathBuf {
        image_path(self.session.out, &self.view, key)
    }

    /// Drivers compile at the first dispatch: that one is outside the clock.
    fn warm_up(&mut self, turn: Turn) {
        let variant = &self.session.experiment.variants[turn.variant];
        if variant.method.processor() == Processor::Gpu {
            // What fails here fails again by the clock, where it is recorded.
            let _ = self.measure(turn, self.amounts[turn.variant], &mut |_, _, _| Ok(()));
        }
    }

    /// As [`Self::measure`], looked at whenever the work has doubled, where the method is progressive.
    fn measure_with_checkpoints(
        &mut self,
        turn: Turn,
    ) -> Result<(MeasuredRun, Vec<Checkpoint>), Error> {
        let method = self.session.experiment.variants[turn.variant].method;
        let (stage, references) = (self.stage, self.references);
        let mut checkpoints = Vec::new();
        let mut next = 1;
        let mut look = |progress: manylights_method::Progress, step_seconds, run: &mut dyn Run| {
            if method.is_progressive() && progress.done >= next && !progress.finished() {
                next = 2 * progress.done;
                let image = stage.completed(run.resolve()?);
                let rmse = |reference: &SceneReference| {
                    Ok((reference.name.clone(), reference.display_rmse(&image, turn.seed)?))
                };
                let display_rmse: Result<_, manylights_metrics::Error> =
                    references.iter().map(rmse).collect();
                let display_rmse =
                    display_rmse.map_err(|error| Error::Failed(error.to_string()))?;
                checkpoints.push(Checkpoint {
                    amount: progress.done as f64,
                    step_seconds,
                    display_rmse,
                });
            }
            Ok(())
        };
        let measured = self.measure(turn, self.amounts[turn.variant], &mut look)?;
        Ok((measured, checkpoints))
    }

    fn outcome(
        &mut self,
        turn: Turn,
        key: &str,
        earlier: &[(Turn, Cell)],
    ) -> Result<Outcome, Failure> {
        if let Some(refused) = self.refused.get(&turn.variant) {
            return Ok(refused.clone());
        }
        let (measured, checkpoints) = match self.measure_with_checkpoints(turn) {
            Ok(measured) => measured,
            Err(error) => return Ok(Outcome::refused(error)),
        };
        if turn.repetition == 0 {
            self.write_image(&measured, key)?;
        }
        Ok(match self.done(turn, measured, checkpoints) {
            Ok(done) if differs(&done, turn, earlier) => Outcome::Failed {
                reason: "the picture differs from that of the first repetition".into(),
            },
            Ok(done) => Outcome::Done(Box::new(done)),
            Err(error) => Outcome::Failed { reason: error.to_string() },
        })
    }

    fn write_image(&self, measured: &MeasuredRun, key: &str) -> Result<(), Failure> {
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

    fn done(
        &mut self,
        turn: Turn,
        measured: MeasuredRun,
        checkpoints: Vec<Checkpoint>,
    ) -> Result<Done, manylights_metrics::Error> {
        let Variant { method, parameters, visibility, .. } =
            &self.session.experiment.variants[turn.variant];
        let asked = || Some(parameters.real(method.cost()?.parameter));
        let mut errors = compare(self.references, &measured.image, turn.seed)?;
        for reference in self.references.iter().filter(|_| turn.repetition == 0) {
            let comparison = errors.get_mut(&reference.name).expect("all are compared with");
            comparison.tiles = Some(reference.tiles(&measured.image, turn.seed));
        }
        Ok(Done {
            amount: self.amounts[turn.variant].or_else(asked),
            checkpoints,
            visibility: self.stage.transport.visibility().map(|_| visibility.to_string()),
            bake_shared: self.session.bakes.tell(&measured.bake),
            bake_seconds: measured.bake.seconds,
            bake_pass_seconds: measured.bake.pass_seconds,
            bake_counters: measured.bake.counters,
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
                let bake = match (done.bake_seconds, done.bake_shared) {
                    (0.0, _) | (_, true) => String::new(),
                    (seconds, false) => format!("baked in {seconds:.4} s, "),
                };
                format!("{bake}{:.4} s, RMSE (sRGB) {}", done.step_seconds, errors.join(", "))
            }
            Outcome::Declined { reason } => format!("declined: {reason}"),
            Outcome::Failed { reason } => format!("FAILED: {reason}"),
        };
        format!("{} {variant} seed {} run {}: {what}", self.view, turn.seed, turn.repetition + 1)
    }
}

/// Errors of a picture of this seed, by name of the reference.
fn compare(
    references: &[SceneReference],
    image: &RadianceImage,
    seed: u64,
) -> Result<BTreeMap<String, Comparison>, manylights_metrics::Error> {
    let errors =
        |reference: &SceneReference| Ok((reference.name.clone(), reference.compare(image, seed)?));
    references.iter().map(errors).collect()
}

/// Whether a repetition gave other bits than the first run of the same cell.
fn differs(done: &Done, turn: Turn, earlier: &[(Turn, Cell)]) -> bool {
    let first = Turn { repetition: 0, ..turn };
    earlier.iter().any(|(turn, cell)| {
        *turn == first
            && matches!(&cell.outcome, Outcome::Done(other) if other.image_sha256 != done.image_sha256)
    })
}
