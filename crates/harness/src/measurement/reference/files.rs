//! References among the pictures of the cells.

use std::path::{Path, PathBuf};

use manylights_metrics::RadianceImage;

use super::{Pictures, SceneReference, samples_caption};
use crate::error::Failure;
use crate::measurement::cell::Comparison;
use crate::measurement::inputs::{Inputs, ReferenceInputs};
use crate::question::experiment::Experiment;
use crate::question::references::{Reference, Source};

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

    /// What [`Self::write`] kept, with the noise that a cell of these inputs was told of.
    ///
    /// # Errors
    /// One line where a picture cannot be read.
    pub(crate) fn read(
        reference: &Reference,
        experiment: &Experiment,
        inputs: &Inputs,
        comparison: Option<&Comparison>,
        out: &Path,
    ) -> Result<Self, Failure> {
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
        Ok(Self {
            name: reference.name.clone(),
            caption,
            inputs: made,
            pictures,
            linear_floor: comparison.map_or(0.0, |comparison| comparison.linear_floor),
            display_floor: comparison.map_or(0.0, |comparison| comparison.display_floor),
            exposure: inputs.exposure,
        })
    }
}

/// The picture of a reference among those of the cells. No name has a dot.
fn path(out: &Path, view: &str, name: &str, seed: Option<u64>) -> PathBuf {
    let seed = seed.map_or_else(String::new, |seed| format!(".seed-{seed}"));
    out.join("cells").join(format!("{view}-reference-{name}{seed}.exr"))
}
