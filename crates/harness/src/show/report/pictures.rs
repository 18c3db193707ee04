//! Which pictures of a scene the page carries.

use std::path::Path;

use manylights_metrics::RadianceImage;

use super::pixels;
use crate::answer::error_scale::error_scale;
use crate::answer::rows::SceneAnswer;
use crate::error::Failure;
use crate::measurement::reference::SceneReference;
use crate::measurement::scene_cells::{SceneCells, image_path};
use crate::question::experiment::Experiment;

/// Characters of base64 that the pictures of one page may take: a phone still opens it.
const BUDGET: usize = 32 << 20;

/// A picture of the page.
pub(super) enum Picture<'a> {
    /// What the others are compared with.
    Reference(&'a SceneReference),
    /// Index into the rows of the answer; the first seed.
    Row(usize, RadianceImage),
}

impl Picture<'_> {
    fn image(&self) -> &RadianceImage {
        match self {
            Self::Reference(reference) => reference.image(),
            Self::Row(_, image) => image,
        }
    }
}

/// The pictures of a scene: references, then variants in the order of the experiment.
pub(super) struct Pictures<'a> {
    /// In the order of the keys 1, 2, …
    pub(super) list: Vec<Picture<'a>>,
    /// Of stored values to radiance.
    pub(super) factor: f32,
    /// One scale for the errors of all of them, that of the sheet: W·m⁻²·sr⁻¹.
    pub(super) error_scale: f32,
    /// Variants whose picture the budget leaves out.
    pub(super) left_out: usize,
}

impl<'a> Pictures<'a> {
    /// Takes all variants where `scenes` like this one fit into the budget, else the last of each
    /// series, as sheets do.
    ///
    /// # Errors
    /// One line where a picture cannot be read.
    pub(super) fn read(
        experiment: &Experiment,
        cells: &'a SceneCells,
        answer: &SceneAnswer,
        scenes: usize,
        out: &Path,
    ) -> Result<Self, Failure> {
        let references = &cells.references;
        let variants = &experiment.variants;
        let rows = answer.rows.iter().enumerate();
        let mut done: Vec<_> =
            rows.filter_map(|(index, row)| Some((index, row.variant, row.medians()?))).collect();
        let all = done.len();
        let ends_series = |variant: usize| {
            let series = variants[variant].series();
            variants[variant + 1..].iter().all(|later| later.series() != series)
        };
        let count = scenes * (references.len() + all);
        if count * pixels::length(references[0].image()) > BUDGET {
            done.retain(|&(_, variant, _)| ends_series(variant));
        }
        let mut list: Vec<_> = references.iter().map(Picture::Reference).collect();
        for &(index, _, medians) in &done {
            let path = image_path(out, &cells.scene, &medians.key).with_extension("exr");
            let image = RadianceImage::read_exr(&path).map_err(Failure::input)?;
            list.push(Picture::Row(index, image));
        }
        let ends = list[references.len()..].iter().zip(&done);
        let ends: Vec<_> = ends
            .filter(|(_, (_, variant, _))| ends_series(*variant))
            .map(|(picture, _)| picture.image())
            .collect();
        let error_scale = error_scale(&ends, references);
        let factor = pixels::factor(cells.exposure);
        Ok(Self { error_scale, factor, left_out: all - done.len(), list })
    }

    /// Width, height in pixels.
    pub(super) fn resolution(&self) -> [u32; 2] {
        let image = self.list[0].image();
        [image.width, image.height]
    }

    /// Each picture as text.
    pub(super) fn encoded(&self) -> impl Iterator<Item = String> {
        self.list.iter().map(|picture| pixels::encode(picture.image(), self.factor))
    }
}
