//! References among the pictures of the cells.

use std::path::{Path, PathBuf};

use manylights_metrics::RadianceImage;

use super::{Pictures, SceneReference, samples_caption};
use crate::error::Failure;
use crate::measurement::cell::{Cell, Comparison, Outcome};
use crate::measurement::inputs::ReferenceInputs;
use crate::measurement::pictures::image_path;
use crate::question::experiment::Experiment;
use crate::question::plan::Turn;
use crate::question::references::{Reference, Source};

/// The same two pictures have the same error but for how another processor rounds sums.
const SAME: f64 = 1e-9;

impl SceneReference {
    /// Keeps the pictures beside those of the cells of `out`, for reports.
    ///
    /// # Errors
    /// One line where a file cannot be written.
    pub(crate) fn write(&self, view: &str, out: &Path) -> Result<(), Failure> {
        let made = ("manylights.reference".to_owned(), self.caption.clone());
        let write = |seed, image: &RadianceImage| {
            let path = path(out, view, &self.name, seed);
            image.write_exr(&path, std::slice::from_ref(&made)).map_err(Failure::input)
        };
        match &self.pictures {
            Pictures::One(image) => write(None, image),
            Pictures::Seeds(pictures) => {
                pictures.iter().try_for_each(|(seed, image)| write(Some(*seed), image))
            }
        }
    }

    /// What [`Self::write`] kept, for the cells of a scene that were compared with it.
    ///
    /// # Errors
    /// One line where a picture cannot be read, or is not that one.
    pub(crate) fn read(
        reference: &Reference,
        experiment: &Experiment,
        cells: &[(Turn, Cell)],
        out: &Path,
    ) -> Result<Self, Failure> {
        let (_, Cell { inputs, .. }) = cells.first().expect("a scene is there for a cell");
        let compared = cells.iter().find_map(|(turn, cell)| match &cell.outcome {
            Outcome::Done(done) if turn.repetition == 0 => {
                Some((cell, done.errors.get(&reference.name)?))
            }
            _ => None,
        });
        let floor = |floor: fn(&Comparison) -> f64| compared.map_or(0.0, |(_, to)| floor(to));
        let read = |seed| {
            let path = path(out, &inputs.view(), &reference.name, seed);
            RadianceImage::read_exr(&path).map_err(Failure::input)
        };
        let made = inputs.references.get(&reference.name).cloned();
        let made = made.unwrap_or_else(|| ReferenceInputs::new(reference, 0));
        let (pictures, caption) = match &reference.source {
            Source::Paths(_) => (Pictures::One(read(None)?), None),
            Source::Method(variant) => {
                let seeds = experiment.scale.seeds.iter();
                let pictures = seeds.map(|&seed| Ok((seed, read(Some(seed))?)));
                let pictures = pictures.collect::<Result<_, Failure>>()?;
                (Pictures::Seeds(pictures), Some(variant.label()))
            }
        };
        let caption = caption.unwrap_or_else(|| match made {
            ReferenceInputs::Samples(samples) => samples_caption(samples),
            ReferenceInputs::Method { .. } => String::new(),
        });
        let kept = Self {
            name: reference.name.clone(),
            caption,
            pictures,
            linear_floor: floor(|comparison| comparison.linear_floor),
            display_floor: floor(|comparison| comparison.display_floor),
            display_halves: None,
            exposure: inputs.exposure,
        };
        if let Some((cell, comparison)) = compared {
            let picture = image_path(out, &inputs.view(), &cell.key).with_extension("exr");
            let picture = RadianceImage::read_exr(&picture).map_err(Failure::input)?;
            let again = kept.display_rmse(&picture, cell.inputs.seed).map_err(Failure::input)?;
            let off = (again - comparison.display.rmse).abs();
            if off > SAME * comparison.display.rmse {
                return Err(Failure::input(format!(
                    "{}: {} is not the reference that the cells were compared with: run them again",
                    out.display(),
                    reference.name
                )));
            }
        }
        Ok(kept)
    }
}

/// The picture of a reference among those of the cells. No name has a dot.
fn path(out: &Path, view: &str, name: &str, seed: Option<u64>) -> PathBuf {
    let seed = seed.map_or_else(String::new, |seed| format!(".seed-{seed}"));
    out.join("cells").join(format!("{view}-reference-{name}{seed}.exr"))
}
