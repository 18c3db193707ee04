//! `cells/SCENE-KEY.layers.exr`: the picture of a variant, first seed, taken apart for viewers such as
//! tev.
//!
//! | transport | `image` | `direct` | `indirect` | `error` |
//! |---|---|---|---|---|
//! | indirect-K | direct + indirect | path tracer | the method's picture | indirect − reference |
//! | all | the method's picture | path tracer | image − direct | image − reference |
//! | direct | the method's picture | the same | absent | image − reference |
//!
//! The reference is the first of the experiment. All layers are radiance in W·m⁻²·sr⁻¹.

use std::path::Path;

use manylights_metrics::{RadianceImage, write_exr_layers};
use manylights_path_tracer as path_tracer;
use manylights_scene::Scene;
use manylights_scene::Transport;

use crate::answer::rows::SceneAnswer;
use crate::error::Failure;
use crate::measurement::scene_cells::{SceneCells, image_path};
use crate::progress::Progress;
use crate::question::experiment::{Experiment, REFERENCE_SEED};

/// Writes the layers of all variants that have a picture. Direct light comes from the path tracer and
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
    let direct = match experiment.transport {
        Transport::Direct => None,
        Transport::All | Transport::Indirect { .. } => {
            Some(render_direct(experiment, scene, cells.camera.as_deref(), cache)?)
        }
    };
    let truth = &cells.references[0].image;
    for medians in answer.rows.iter().filter_map(|row| row.medians()) {
        let path = image_path(out, &cells.scene, &medians.key);
        let image = RadianceImage::read_exr(&path.with_extension("exr")).map_err(Failure::input)?;
        let error = combined(&image, truth, |x, r| x - r);
        let layers = layers(experiment.transport, image, direct.as_ref(), error);
        let layers: Vec<_> = layers.iter().map(|(name, image)| (*name, image)).collect();
        let attributes = [
            ("manylights.cell".to_owned(), medians.key.clone()),
            ("manylights.transport".to_owned(), experiment.transport.to_string()),
            ("manylights.reference".to_owned(), cells.references[0].visibility.to_string()),
        ];
        write_exr_layers(&path.with_extension("layers.exr"), &layers, &attributes)
            .map_err(Failure::input)?;
    }
    Ok(())
}

fn layers(
    transport: Transport,
    image: RadianceImage,
    direct: Option<&RadianceImage>,
    error: RadianceImage,
) -> Vec<(&'static str, RadianceImage)> {
    let error = ("error", error);
    let Some(direct) = direct else {
        return vec![("image", image.clone()), ("direct", image), error];
    };
    let [whole, indirect] = match transport {
        Transport::Indirect { .. } => [combined(&image, direct, |i, d| i + d), image],
        Transport::All | Transport::Direct => {
            let indirect = combined(&image, direct, |x, d| x - d);
            [image, indirect]
        }
    };
    vec![("image", whole), ("direct", direct.clone()), ("indirect", indirect), error]
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
    let is_exact = scene.emissive_triangles().next().is_none();
    let settings = path_tracer::Settings {
        transport: Transport::Direct,
        resolution: experiment.scale.resolution,
        seed: REFERENCE_SEED,
        samples: if is_exact { 1 } else { experiment.scale.reference_samples },
    };
    let mut progress = Progress::new(&format!("{} direct light", scene.name));
    let reference = path_tracer::render(scene, camera, &settings, Some(cache), &mut |at| {
        progress.set(at.done, at.total);
    })
    .map_err(|error| at_scene(&error))?;
    for note in &reference.notes {
        eprintln!("{note}");
    }
    Ok(reference.image)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(value: f32) -> RadianceImage {
        RadianceImage { width: 1, height: 1, pixels: vec![[value; 3]] }
    }

    /// Names and values of the layers of a picture of radiance 3 with direct light 1.
    fn values(transport: &str) -> Vec<(&'static str, f32)> {
        let transport = transport.parse().expect("a transport");
        let direct = (transport != Transport::Direct).then(|| flat(1.0));
        let layers = layers(transport, flat(3.0), direct.as_ref(), flat(-0.5));
        layers.iter().map(|(name, image)| (*name, image.pixels[0][0])).collect()
    }

    #[test]
    fn layers_add_up() {
        assert_eq!(
            values("indirect-1"),
            [("image", 4.0), ("direct", 1.0), ("indirect", 3.0), ("error", -0.5)]
        );
        assert_eq!(
            values("all"),
            [("image", 3.0), ("direct", 1.0), ("indirect", 2.0), ("error", -0.5)]
        );
        assert_eq!(values("direct"), [("image", 3.0), ("direct", 3.0), ("error", -0.5)]);
    }
}
