//! References of a scene, with the noise that is left in them.

mod files;

use std::path::Path;

use manylights_method::Run;
use manylights_metrics::{RadianceImage, compare_display, compare_linear, display_rmse};
use manylights_path_tracer as path_tracer;
use manylights_scene::{Scene, Visibility};

use crate::error::Failure;
use crate::measurement::cell::Comparison;
use crate::measurement::measure;
use crate::measurement::stage::Stage;
use crate::measurement::tiles::Tiles;
use crate::output::say;
use crate::progress::ProgressBar;
use crate::question::experiment::Experiment;
use crate::question::plan::Variant;
use crate::question::profiles::REFERENCE_SEED;
use crate::question::references::{Reference, Source};

/// What the pictures of a scene are compared with: the picture of the path tracer, converged as far as
/// its samples go, or those of another method, one for each seed.
pub(crate) struct SceneReference {
    /// Of the experiment.
    pub(crate) name: String,
    /// Who made it, with which parameters.
    pub(crate) caption: String,
    pictures: Pictures,
    /// Independent halves of it as sRGB values, where it was traced and not read.
    display_halves: Option<[RadianceImage; 2]>,
    /// RMSE of radiance that noise alone causes.
    linear_floor: f64,
    /// RMSE of sRGB values that noise alone causes. A method that is the reference has none: its
    /// picture is what is asked for, noise and all.
    pub(crate) display_floor: f64,
    exposure: f32,
}

enum Pictures {
    /// Whatever the seed of what is compared with it.
    One(RadianceImage),
    /// By seed, in the experiment's order; there is one.
    Seeds(Vec<(u64, RadianceImage)>),
}

impl SceneReference {
    /// Renders the reference or takes it, as far as it got, from `cache`.
    ///
    /// # Errors
    /// One line where the scene cannot be rendered or the reference is black.
    pub(crate) fn render(
        reference: &Reference,
        experiment: &Experiment,
        stage: &Stage<'_>,
        cache: &Path,
    ) -> Result<Self, Failure> {
        let made = match &reference.source {
            Source::Paths(visibility) => {
                Self::trace(reference, *visibility, experiment, stage, cache)?
            }
            Source::Method(variant) => Self::by_method(reference, variant, experiment, stage)?,
        };
        // Nothing can be compared with a black reference: better said before the methods run.
        for image in made.images() {
            compare_linear(image, image).map_err(|error| at_scene(stage.scene, error))?;
        }
        Ok(made)
    }

    fn trace(
        reference: &Reference,
        visibility: Visibility,
        experiment: &Experiment,
        stage: &Stage<'_>,
        cache: &Path,
    ) -> Result<Self, Failure> {
        let scene = stage.scene;
        let settings = path_tracer::Settings {
            transport: stage.frame(visibility, REFERENCE_SEED).transport,
            resolution: stage.resolution,
            seed: REFERENCE_SEED,
            samples: experiment.scale.reference_samples,
        };
        let label = format!("{} reference ({visibility}, {} spp)", scene.name, settings.samples);
        let mut progress = ProgressBar::new(&label);
        let traced = path_tracer::render(scene, stage.camera, &settings, Some(cache), &mut |at| {
            progress.set(at.done, at.total);
        })
        .map_err(|error| at_scene(scene, error))?;
        drop(progress);
        for note in &traced.notes {
            say(note);
        }
        let [a, b] = traced.halves.map(|half| stage.completed(half));
        // Halves of n/2 samples differ by √2 times their own noise, which is √2 times that of their
        // mean: half the difference is the noise of the mean.
        let display = compare_display(&a, &b, scene.exposure).map_err(|e| at_scene(scene, e))?;
        Ok(Self {
            name: reference.name.clone(),
            caption: samples_caption(traced.samples),
            pictures: Pictures::One(stage.completed(traced.image)),
            linear_floor: traced.noise_floor,
            display_floor: display.rmse / 2.0,
            display_halves: Some([a, b].map(|half| half.display(scene.exposure))),
            exposure: scene.exposure,
        })
    }

    fn by_method(
        reference: &Reference,
        variant: &Variant,
        experiment: &Experiment,
        stage: &Stage<'_>,
    ) -> Result<Self, Failure> {
        let Variant { method, parameters, visibility, .. } = variant;
        let scene = stage.scene;
        let seeds = &experiment.scale.seeds;
        let mut progress =
            ProgressBar::new(&format!("{} reference {}", scene.name, reference.name));
        let mut pictures = Vec::with_capacity(seeds.len());
        for (done, &seed) in (0..).zip(seeds) {
            progress.set(done, seeds.len() as u64);
            let frame = stage.frame(*visibility, seed);
            let all = &mut |_, _: f64, _: &mut dyn Run| Ok(());
            let measured = measure::measure(*method, &frame, parameters, None, all)
                .map_err(|error| of_method(scene, reference, error))?;
            pictures.push((seed, stage.completed(measured.image)));
        }
        Ok(Self {
            name: reference.name.clone(),
            caption: variant.label(),
            pictures: Pictures::Seeds(pictures),
            linear_floor: 0.0,
            display_floor: 0.0,
            display_halves: None,
            exposure: scene.exposure,
        })
    }

    /// Refuses a method that declines the scene, before anything is rendered.
    ///
    /// # Errors
    /// One line with the method's reason.
    pub(crate) fn check(reference: &Reference, stage: &Stage<'_>) -> Result<(), Failure> {
        let Source::Method(variant) = &reference.source else { return Ok(()) };
        let frame = stage.frame(variant.visibility, 0);
        match variant.method.prepare(&frame, &variant.parameters) {
            Ok(_) => Ok(()),
            Err(error) => Err(of_method(stage.scene, reference, error)),
        }
    }

    /// The picture that stands for the reference: of several, that of the experiment's first seed.
    pub(crate) fn image(&self) -> &RadianceImage {
        match &self.pictures {
            Pictures::One(image) => image,
            Pictures::Seeds(pictures) => &pictures[0].1,
        }
    }

    /// What a picture of this seed is compared with.
    pub(crate) fn image_for(&self, seed: u64) -> &RadianceImage {
        match &self.pictures {
            Pictures::One(image) => image,
            Pictures::Seeds(pictures) => {
                let same = pictures.iter().find(|(of, _)| *of == seed);
                &same.expect("there is a picture for each seed of the experiment").1
            }
        }
    }

    fn images(&self) -> impl Iterator<Item = &RadianceImage> {
        let (one, seeds) = match &self.pictures {
            Pictures::One(image) => (Some(image), &[][..]),
            Pictures::Seeds(pictures) => (None, pictures.as_slice()),
        };
        one.into_iter().chain(seeds.iter().map(|(_, image)| image))
    }

    /// Errors of a picture of this seed against this reference.
    ///
    /// # Errors
    /// Where pixels of the picture are not finite.
    pub(crate) fn compare(
        &self,
        image: &RadianceImage,
        seed: u64,
    ) -> Result<Comparison, manylights_metrics::Error> {
        let truth = self.image_for(seed);
        Ok(Comparison {
            linear: compare_linear(image, truth)?,
            display: compare_display(image, truth, self.exposure)?,
            linear_floor: self.linear_floor,
            display_floor: self.display_floor,
            tiles: None,
        })
    }

    /// RMSE of sRGB values of a picture of this seed, alone: what checkpoints need.
    ///
    /// # Errors
    /// As [`Self::compare`].
    pub(crate) fn display_rmse(
        &self,
        image: &RadianceImage,
        seed: u64,
    ) -> Result<f64, manylights_metrics::Error> {
        display_rmse(image, self.image_for(seed), self.exposure)
    }

    /// The squared errors of a picture of this seed by tile.
    pub(crate) fn tiles(&self, image: &RadianceImage, seed: u64) -> Tiles {
        let [image, truth] =
            [image, self.image_for(seed)].map(|image| image.display(self.exposure));
        Tiles::new(&image, &truth, self.display_halves.as_ref())
    }
}

fn samples_caption(samples: u32) -> String {
    format!("{samples} samples")
}

fn at_scene(scene: &Scene, error: impl std::fmt::Display) -> Failure {
    Failure::input(format!("reference of {}: {error}", scene.name))
}

fn of_method(scene: &Scene, reference: &Reference, error: impl std::fmt::Display) -> Failure {
    Failure::input(format!("reference `{}` of {}: {error}", reference.name, scene.name))
}
