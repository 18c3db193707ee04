//! `cells/SCENE-KEY.layers.exr`: the picture of a variant, first seed, taken apart for viewers such as
//! tev.
//!
//! | transport | `image` | `direct` | `emission` | `indirect` | `error` |
//! |---|---|---|---|---|---|
//! | indirect-K | the sum of the three | path tracer | path tracer | the method's picture | indirect − reference |
//! | direct+indirect-1 | the method's picture | path tracer | absent | image − direct | image − reference |
//! | all | the method's picture | path tracer | path tracer | the rest of the image | image − reference |
//! | direct | the method's picture | the same | absent | absent | image − reference |
//!
//! Emission is what the camera sees directly; the layer is absent where nothing emits, too.
//! The reference is the first of the experiment. All layers are radiance in W·m⁻²·sr⁻¹.

use std::path::Path;

use manylights_metrics::{RadianceImage, write_exr_layers};
use manylights_path_tracer as path_tracer;
use manylights_scene::{Scene, Transport, Visibility};

use crate::answer::rows::{Medians, SceneAnswer};
use crate::error::Failure;
use crate::measurement::pictures::image_path;
use crate::measurement::scene_cells::SceneCells;
use crate::output::say;
use crate::progress::ProgressBar;
use crate::question::experiment::Experiment;
use crate::question::profiles::REFERENCE_SEED;

/// Writes the layers of all variants that have a picture and none yet. Direct light comes from the path tracer and
/// is kept in `cache`, as references are.
///
/// # Errors
/// One line where a picture cannot be read, rendered or written.
pub(crate) fn write(
    experiment: &Experiment,
    scene: &Scene,
    cells: &SceneCells,
    answer: &SceneAnswer,
    [cache, out]: [&Path; 2],
) -> Result<(), Failure> {
    let path = |medians: &Medians| image_path(out, &cells.scene, &medians.key);
    let pictured = answer.rows.iter().filter_map(|row| row.medians());
    let missing: Vec<&Medians> =
        pictured.filter(|medians| !path(medians).with_extension("layers.exr").exists()).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let parts = parts(experiment, scene, cells.camera.as_deref(), cache)?;
    let truth = cells.references[0].image();
    for medians in missing {
        let path = path(medians);
        let image = RadianceImage::read_exr(&path.with_extension("exr")).map_err(Failure::input)?;
        let error = combined(&image, truth, |x, r| x - r);
        let layers = layers(experiment.transport, image, &parts, error);
        let layers: Vec<_> = layers.iter().map(|(name, image)| (*name, image)).collect();
        let attributes = [
            ("manylights.cell".to_owned(), medians.key.clone()),
            ("manylights.transport".to_owned(), experiment.transport.to_string()),
            ("manylights.reference".to_owned(), cells.references[0].name.clone()),
        ];
        write_exr_layers(&path.with_extension("layers.exr"), &layers, &attributes)
            .map_err(Failure::input)?;
    }
    Ok(())
}

/// A layer.
type Layer = (&'static str, RadianceImage);

/// The parts that come from the path tracer.
fn parts(
    experiment: &Experiment,
    scene: &Scene,
    camera: Option<&str>,
    cache: &Path,
) -> Result<Vec<Layer>, Failure> {
    if matches!(experiment.transport, Transport::Direct { .. }) {
        return Ok(Vec::new());
    }
    let mut parts = vec![("direct", render_direct(experiment, scene, camera, cache)?)];
    if scene.emissive_triangles().next().is_some() {
        let camera = scene.camera(camera).map_err(Failure::input)?;
        let resolution = experiment.scale.resolution;
        parts.push(("emission", path_tracer::seen_emission(scene, camera, resolution)));
    }
    Ok(parts)
}

fn layers(
    transport: Transport,
    image: RadianceImage,
    parts: &[Layer],
    error: RadianceImage,
) -> Vec<Layer> {
    let with_parts = |f: fn(f32, f32) -> f32| {
        let start = image.clone();
        parts.iter().fold(start, |sum, (_, part)| combined(&sum, part, f))
    };
    let [whole, rest] = match transport {
        Transport::Direct { .. } => {
            return vec![("image", image.clone()), ("direct", image), ("error", error)];
        }
        Transport::Indirect { .. } => [with_parts(|i, part| i + part), image],
        Transport::DirectAndIndirect { .. } | Transport::All => {
            let rest = with_parts(|x, part| x - part);
            [image, rest]
        }
    };
    let mut layers = vec![("image", whole)];
    layers.extend(parts.iter().cloned());
    layers.extend([("indirect", rest), ("error", error)]);
    layers
}

/// A picture made of two of the same size, component by component.
fn combined(a: &RadianceImage, b: &RadianceImage, f: impl Fn(f32, f32) -> f32) -> RadianceImage {
    let pixel = |(a, b): (&[f32; 3], &[f32; 3])| std::array::from_fn(|k| f(a[k], b[k]));
    RadianceImage { pixels: a.pixels.iter().zip(&b.pixels).map(pixel).collect(), ..*a }
}

fn render_direct(
    experiment: &Experiment,
    scene: &Scene,
    camera: Option<&str>,
    cache: &Path,
) -> Result<RadianceImage, Failure> {
    let at_scene = |error: &dyn std::fmt::Display| {
        Failure::input(format!("direct light of {}: {error}", scene.name))
    };
    let camera = scene.camera(camera).map_err(|error| at_scene(&error))?;
    // Point-like lights are summed exactly: more samples would give the same picture.
    let is_exact = scene.all_area_lights().next().is_none();
    let settings = path_tracer::Settings {
        transport: Transport::Direct { visibility: Visibility::Traced },
        resolution: experiment.scale.resolution,
        seed: REFERENCE_SEED,
        samples: if is_exact { 1 } else { experiment.scale.reference_samples },
    };
    let mut progress = ProgressBar::new(&format!("{} direct light", scene.name));
    let reference = path_tracer::render(scene, camera, &settings, Some(cache), &mut |at| {
        progress.set(at.done, at.total);
    })
    .map_err(|error| at_scene(&error))?;
    for note in &reference.notes {
        say(note);
    }
    Ok(reference.image)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(value: f32) -> RadianceImage {
        RadianceImage { width: 1, height: 1, pixels: vec![[value; 3]] }
    }

    /// Names and values of the layers of a picture of radiance 3 with direct light 1 and, where it
    /// `shines`, emission 0.5.
    fn values(transport: &str, shines: bool) -> Vec<(&'static str, f32)> {
        let transport = transport.parse().expect("a transport");
        let mut parts = vec![("direct", flat(1.0))];
        parts.extend(shines.then(|| ("emission", flat(0.5))));
        let layers = layers(transport, flat(3.0), &parts, flat(-0.5));
        layers.iter().map(|(name, image)| (*name, image.pixels[0][0])).collect()
    }

    #[test]
    fn layers_add_up() {
        let error = ("error", -0.5);
        let [direct, emission] = [("direct", 1.0), ("emission", 0.5)];
        let [image, indirect] = [("image", 4.5), ("indirect", 3.0)];
        assert_eq!(values("indirect-1", true), [image, direct, emission, indirect, error]);
        assert_eq!(values("indirect-1", false), [("image", 4.0), direct, indirect, error]);
        let [image, rest] = [("image", 3.0), ("indirect", 1.5)];
        assert_eq!(values("all", true), [image, direct, emission, rest, error]);
        let both = values("direct+indirect-1", false);
        assert_eq!(both, [image, direct, ("indirect", 2.0), error]);
        assert_eq!(values("direct", false), [image, ("direct", 3.0), error]);
    }
}
