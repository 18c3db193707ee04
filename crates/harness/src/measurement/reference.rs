//! References of a scene, with the noise that is left in them.

use std::path::{Path, PathBuf};

use manylights_metrics::{RadianceImage, compare_display, compare_linear};
use manylights_path_tracer as path_tracer;
use manylights_scene::Visibility;
use manylights_scene::{Camera, Scene};

use crate::error::Failure;
use crate::measurement::cell::{Cell, Comparison, Outcome};
use crate::measurement::pictures::image_path;
use crate::output::say;
use crate::progress::Progress;
use crate::question::plan::Turn;

/// The same two pictures have the same error but for how another processor rounds sums.
const SAME: f64 = 1e-9;

/// A converged picture, as far as its samples go.
pub(crate) struct SceneReference {
    /// Of the last segment.
    pub(crate) visibility: Visibility,
    /// The mean of all samples.
    pub(crate) image: RadianceImage,
    /// Samples a pixel.
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
            say(note);
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

    /// What [`Self::write`] kept, for the cells of a scene that were compared with it.
    ///
    /// # Errors
    /// One line where the picture cannot be read, or is not that one.
    pub(crate) fn read(
        visibility: Visibility,
        cells: &[(Turn, Cell)],
        out: &Path,
    ) -> Result<Self, Failure> {
        let name = visibility.to_string();
        let (_, Cell { inputs, .. }) = cells.first().expect("a scene is there for a cell");
        let compared = cells.iter().find_map(|(turn, cell)| match &cell.outcome {
            Outcome::Done(done) if turn.repetition == 0 => Some((cell, done.errors.get(&name)?)),
            _ => None,
        });
        let path = path(out, &inputs.view(), visibility);
        let floor = |floor: fn(&Comparison) -> f64| compared.map_or(0.0, |(_, to)| floor(to));
        let reference = Self {
            visibility,
            image: RadianceImage::read_exr(&path).map_err(Failure::input)?,
            samples: inputs.references.get(&name).copied().unwrap_or(0),
            linear_floor: floor(|comparison| comparison.linear_floor),
            display_floor: floor(|comparison| comparison.display_floor),
            exposure: inputs.exposure,
        };
        if let Some((cell, comparison)) = compared {
            let picture = image_path(out, &inputs.view(), &cell.key).with_extension("exr");
            let picture = RadianceImage::read_exr(&picture).map_err(Failure::input)?;
            let again = reference.compare(&picture).map_err(Failure::input)?.display.rmse;
            if (again - comparison.display.rmse).abs() > SAME * comparison.display.rmse {
                return Err(Failure::input(format!(
                    "{}: not the reference that the cells were compared with: run them again",
                    path.display()
                )));
            }
        }
        Ok(reference)
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
