//! `sheet-SCENE.png`: references, methods, crops and errors side by side.

mod tiles;

use std::io::Cursor;
use std::path::Path;

use image::imageops::{self, FilterType};
use image::{ImageFormat, Rgb, RgbImage};
use manylights_metrics::{RadianceImage, false_color};

use crate::answer::error_scale::error_scale;
use crate::answer::rows::SceneAnswer;
use crate::error::Failure;
use crate::measurement::pictures::image_path;
use crate::measurement::reference::SceneReference;
use crate::measurement::scene_cells::SceneCells;
use crate::question::experiment::Experiment;
use crate::show::numbers::short;
use tiles::{Rectangle, Tile, compose, draw_frame};

/// Small pictures are enlarged by whole factors until captions fit.
const MIN_TILE: u32 = 400;

/// The picture of a method.
struct MethodPicture {
    label: String,
    image: RadianceImage,
    /// RMSE of sRGB values against each reference.
    rmse: Vec<f64>,
}

/// The sheet of a scene: the methods in the first row, each at the last of its settings in the
/// experiment; then, for each crop, a row of the same rectangle of the first reference and of all
/// methods, framed as in the full pictures; then, for each reference, a row that starts with it and
/// shows the errors against it.
///
/// # Errors
/// One line where the picture of a cell cannot be read.
pub(crate) fn png(
    experiment: &Experiment,
    cells: &SceneCells,
    answer: &SceneAnswer,
    out: &Path,
) -> Result<Vec<u8>, Failure> {
    let entries = entries(experiment, cells, answer, out)?;
    let images: Vec<_> = entries.iter().map(|entry| &entry.image).collect();
    let scale = error_scale(&images, &cells.references);
    let &RadianceImage { width, height, .. } = cells.references[0].image();
    let crops: Vec<Rectangle> = experiment
        .crops
        .iter()
        .filter(|crop| crop.scene == cells.scene)
        .map(|crop| crop.pixels([width, height]))
        .collect();
    let mut rows = vec![pictures(cells, &entries, &crops, scale)];
    rows.extend((0..crops.len()).map(|nth| enlarged_crops(cells, &entries, &crops, nth)));
    for (index, reference) in cells.references.iter().enumerate() {
        rows.push(errors(cells, &entries, index, reference, scale));
    }
    let mut bytes = Cursor::new(Vec::new());
    compose(&rows)
        .write_to(&mut bytes, ImageFormat::Png)
        .map_err(|error| Failure::Failed(format!("sheet of {}: {error}", cells.scene)))?;
    Ok(bytes.into_inner())
}

fn entries(
    experiment: &Experiment,
    cells: &SceneCells,
    answer: &SceneAnswer,
    out: &Path,
) -> Result<Vec<MethodPicture>, Failure> {
    let variants = &experiment.variants;
    let mut entries = Vec::new();
    for row in &answer.rows {
        let variant = &variants[row.variant];
        let last = variants.iter().rposition(|other| other.series() == variant.series());
        let (Some(medians), true) = (row.medians(), last == Some(row.variant)) else { continue };
        let path = image_path(out, &cells.scene, &medians.key).with_extension("exr");
        let image = RadianceImage::read_exr(&path).map_err(Failure::input)?;
        let rmse =
            |reference: &SceneReference| medians.samples[&reference.name].mean_squared().sqrt();
        let rmse = cells.references.iter().map(rmse).collect();
        entries.push(MethodPicture { label: variant.label(), image, rmse });
    }
    Ok(entries)
}

fn shown(image: &RadianceImage, exposure: f32) -> RgbImage {
    to_bytes(&image.display(exposure), zoom(image.width))
}

/// The scale of the errors, then the methods.
fn pictures(
    cells: &SceneCells,
    entries: &[MethodPicture],
    crops: &[Rectangle],
    scale: f32,
) -> Vec<Tile> {
    let &RadianceImage { width, height, .. } = cells.references[0].image();
    let key = Tile {
        caption: ["mean |error| of R, G, B".into(), format!("0 .. {scale} W/m2/sr")],
        picture: shown(&bar(width, height, scale), 1.0),
    };
    let methods = entries.iter().map(|entry| {
        let mut picture = shown(&entry.image, cells.exposure);
        let zoom = zoom(width);
        for (nth, rectangle) in crops.iter().enumerate() {
            draw_frame(&mut picture, rectangle.map(|side| side * zoom), nth);
        }
        Tile { caption: wrapped(&entry.label), picture }
    });
    std::iter::once(key).chain(methods).collect()
}

/// The same rectangle of the first reference and of all methods, as wide as a full picture.
fn enlarged_crops(
    cells: &SceneCells,
    entries: &[MethodPicture],
    crops: &[Rectangle],
    nth: usize,
) -> Vec<Tile> {
    let [left, top, width, height] = crops[nth];
    let truth = &cells.references[0];
    let tile = |image: &RadianceImage, second: String| {
        let full = to_bytes(&image.display(cells.exposure), 1);
        let part = imageops::crop_imm(&full, left, top, width, height).to_image();
        let wide = image.width * zoom(image.width);
        let high = (u64::from(wide) * u64::from(height) / u64::from(width)).max(1) as u32;
        let mut picture = imageops::resize(&part, wide, high, FilterType::Nearest);
        draw_frame(&mut picture, [0, 0, wide, high], nth);
        Tile { caption: [format!("crop {}", nth + 1), second], picture }
    };
    let reference = tile(truth.image(), format!("REFERENCE {}", truth.name));
    let methods = entries.iter().map(|entry| tile(&entry.image, entry.label.clone()));
    std::iter::once(reference).chain(methods).collect()
}

/// A reference, then the errors of the methods against it.
fn errors(
    cells: &SceneCells,
    entries: &[MethodPicture],
    index: usize,
    reference: &SceneReference,
    scale: f32,
) -> Vec<Tile> {
    let truth = Tile {
        caption: [format!("REFERENCE {}", reference.name), reference.caption.clone()],
        picture: shown(reference.image(), cells.exposure),
    };
    let errors = entries.iter().map(|entry| Tile {
        caption: [
            format!("error to {}", reference.name),
            format!("sRGB RMSE {}", short(entry.rmse[index])),
        ],
        picture: shown(&false_color(&entry.image, reference.image(), scale), 1.0),
    });
    std::iter::once(truth).chain(errors).collect()
}

/// The colours from 0 on the left to `scale` on the right, in a strip across a white picture.
fn bar(width: u32, height: u32, scale: f32) -> RadianceImage {
    let ramp = RadianceImage {
        width,
        height: 1,
        pixels: (0..width).map(|x| [(x as f32 + 0.5) / width as f32 * scale; 3]).collect(),
    };
    let strip = false_color(&ramp, &RadianceImage::black(width, 1), scale).display(1.0);
    let strip_height = height.div_ceil(12);
    let mut pixels = strip.pixels.repeat(strip_height as usize);
    pixels.resize(width as usize * height as usize, [1.0; 3]);
    RadianceImage { width, height, pixels }
}

fn zoom(width: u32) -> u32 {
    MIN_TILE.div_ceil(width)
}

/// Bytes of a display-referred picture, each pixel repeated.
fn to_bytes(shown: &RadianceImage, zoom: u32) -> RgbImage {
    RgbImage::from_fn(shown.width * zoom, shown.height * zoom, |x, y| {
        let pixel = shown.pixels[(y / zoom * shown.width + x / zoom) as usize];
        Rgb(pixel.map(|value| (255.0 * value).round() as u8))
    })
}

/// A label in two lines, split at a space.
fn wrapped(label: &str) -> [String; 2] {
    match label.split_once(' ') {
        Some((method, parameters)) => [method.to_owned(), parameters.to_owned()],
        None => [label.to_owned(), String::new()],
    }
}
