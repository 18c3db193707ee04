//! A run of an experiment: what its scenes share, and what comes out of each.

use std::path::Path;

use manylights_gpu::Gpu;

use crate::error::Failure;
use crate::measurement::bakes::Bakes;
use crate::measurement::cell::Cell;
use crate::measurement::journal::Journal;
use crate::measurement::provenance::Provenance;
use crate::measurement::scene_cells::{SceneCells, image_path};
use crate::measurement::stage;
use crate::output;
use crate::question::experiment::Experiment;
use crate::question::references::Source;

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
    /// What further frames may reuse.
    pub(crate) bakes: Bakes,
    /// Cells whose amounts of work time budgets repeat, instead of a search.
    pub(crate) replayed: Vec<Cell>,
    /// Of cells on the adapter.
    pub(crate) on_gpu: Provenance,
    /// Of cells on the host.
    pub(crate) on_cpu: Provenance,
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
        let referred =
            experiment.references.iter().filter_map(|reference| match &reference.source {
                Source::Paths(_) => None,
                Source::Method(variant) => Some(variant.method),
            });
        let methods = experiment.variants.iter().map(|variant| variant.method).chain(referred);
        let gpu = stage::open_gpu(methods, adapter)?;
        let on_gpu = Provenance::here(gpu.as_ref());
        let on_cpu = Provenance { adapter: None, ..on_gpu.clone() };
        let (bakes, replayed) = (Bakes::default(), Vec::new());
        Ok(Self { experiment, journal, out, cache, gpu, bakes, replayed, on_gpu, on_cpu })
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
}
