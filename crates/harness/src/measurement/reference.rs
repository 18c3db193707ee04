//! References of a scene, with the noise that is left in them.

use std::path::{Path, PathBuf};

use manylights_metrics::{RadianceImage, compare_display, compare_linear};
use manylights_path_tracer as path_tracer;
use manylights_scene::Visibility;
use manylights_scene::{Camera, Scene};

use crate::error::Failure;
use crate::measurement::cell::Comparison;
use crate::measurement::inputs::Inputs;
use crate::progress::Progress;

/// A converged picture, as far as its samples go.
pub(crate) struct SceneReference {
    /// Of the last segment.
    pub(crate) visibility: Visibility,
    /// The mean of all samples.
    pub(crate) image: RadianceImage,
    /// Samples a pixel: at least what was asked for.
    pub(crate) samples: u32,
    /// RMSE of radiance that noise alone causes.
    linear_floor: f64,
    /// RMSE of sRGB values that noise alone causes.
    pub(crate) display_floor: f64,
    exposure: f32,
}

impl SceneReference {
    /// Renders the reference or takes it, as far as it got, from `cache`.
    ///
    /// # Errors
    /// One line where the scene cannot be rendered or the reference is black.
    pub(crate) fn render(
        scene: &Scene,
        camera: &Camera,
        settings: &path_tracer::Settings,
        visibility: Visibility,
        cache: &Path,
    ) -> Result<Self, Failure> {
        let label = format!("{} reference ({visibility}, {} spp)", scene.name, settings.samples);
        let mut progress = Progress::new(&label);
        let reference = path_tracer::render(scene, camera, settings, Some(cache), &mut |at| {
            progress.set(at.done, at.total);
        })
        .map_err(|error| at_scene(scene, error))?;
        drop(progress);
        for note in &reference.notes {
            eprintln!("{note}");
        }
        let [a, b] = &reference.halves;
        // Halves of n/2 samples differ by √2 times their own noise, which is √2 times that of their
        // mean: half the difference is the noise of the mean.
        let display = compare_display(a, b, scene.exposure).map_err(|e| at_scene(scene, e))?;
        // Nothing can be compared with a black reference: better said before the methods run.
        compare_linear(&reference.image, &reference.image).map_err(|e| at_scene(scene, e))?;
        Ok(Self {
            visibility,
            samples: reference.samples,
            linear_floor: reference.noise_floor,
            display_floor: display.rmse / 2.0,
            exposure: scene.exposure,
            image: reference.image,
        })
    }

    /// Keeps the picture beside those of the cells of `out`, for reports.
    ///
    /// # Errors
    /// One line where the file cannot be written.
    pub(crate) fn write(&self, view: &str, out: &Path) -> Result<(), Failure> {
        let samples = ("manylights.samples".to_owned(), self.samples.to_string());
        let path = path(out, view, self.visibility);
        self.image.write_exr(&path, &[samples]).map_err(Failure::input)
    }

    /// What [`Self::write`] kept, with the noise that a cell of these inputs was told of.
    ///
    /// # Errors
    /// One line where the picture cannot be read.
    pub(crate) fn read(
        visibility: Visibility,
        inputs: &Inputs,
        comparison: Option<&Comparison>,
        out: &Path,
    ) -> Result<Self, Failure> {
        let path = path(out, &inputs.view(), visibility);
        Ok(Self {
            visibility,
            image: RadianceImage::read_exr(&path).map_err(Failure::input)?,
            samples: inputs.references.get(&visibility.to_string()).copied().unwrap_or(0),
            linear_floor: comparison.map_or(0.0, |comparison| comparison.linear_floor),
            display_floor: comparison.map_or(0.0, |comparison| comparison.display_floor),
            exposure: inputs.exposure,
        })
    }

    /// Errors of a picture against this reference.
    ///
    /// # Errors
    /// Where pixels of the picture are not finite.
    pub(crate) fn compare(
        &self,
        image: &RadianceImage,
    ) -> Result<Comparison, manylights_metrics::Error> {
        Ok(Comparison {
            linear: compare_linear(image, &self.image)?,
            display: compare_display(image, &self.image, self.exposure)?,
            linear_floor: self.linear_floor,
            display_floor: self.display_floor,
        })
    }
}

/// The picture of a reference among those of the cells.
fn path(out: &Path, view: &str, visibility: Visibility) -> PathBuf {
    out.join("cells").join(format!("{view}-reference-{visibility}.exr"))
}

fn at_scene(scene: &Scene, error: impl std::fmt::Display) -> Failure {
    Failure::input(format!("reference of {}: {error}", scene.name))
}
