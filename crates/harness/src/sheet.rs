//! `sheet-SCENE.png`: references, methods and their errors side by side.

use std::io::Cursor;
use std::path::Path;

use image::{ImageFormat, Rgb, RgbImage};
use manylights_metrics::{RadianceImage, false_color};

use crate::answer::SceneAnswer;
use crate::error::Failure;
use crate::experiment::Experiment;
use crate::lettering::{self, LINE};
use crate::numbers::short;
use crate::reference::SceneReference;
use crate::session::{SceneCells, image_path};

const GAP: u32 = 10;
/// Small pictures are enlarged by whole factors until captions fit.
const MIN_TILE: u32 = 400;
const INK: Rgb<u8> = Rgb([30, 30, 30]);
const PAPER: Rgb<u8> = Rgb([255, 255, 255]);

/// A picture with two lines of caption above it.
struct Tile {
    caption: [String; 2],
    picture: RgbImage,
}

/// The picture of a method.
struct Entry {
    label: String,
    image: RadianceImage,
    /// RMSE of sRGB values against each reference.
    rmse: Vec<f64>,
}

/// The sheet of a scene: the methods in the first row, each at the last of its settings in the
/// experiment; then, for each reference, a row that starts with it and shows the errors against it.
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
    let scale = scale(&entries, &cells.references);
    let mut rows = vec![pictures(cells, &entries, scale)];
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
) -> Result<Vec<Entry>, Failure> {
    let variants = &experiment.variants;
    let mut entries = Vec::new();
    for (row, variant) in answer.rows.iter().zip(variants) {
        let last = variants.iter().rposition(|other| other.series() == variant.series());
        let (Some(medians), true) = (row.medians(), last == Some(row.variant)) else { continue };
        let path = image_path(out, &cells.scene, &medians.key).with_extension("exr");
        let image = RadianceImage::read_exr(&path).map_err(Failure::input)?;
        let rmse = |reference: &SceneReference| {
            medians.errors[&reference.visibility.to_string()].display.rmse
        };
        let rmse = cells.references.iter().map(rmse).collect();
        entries.push(Entry { label: variant.label(), image, rmse });
    }
    Ok(entries)
}

fn shown(image: &RadianceImage, exposure: f32) -> RgbImage {
    enlarged(&image.display(exposure))
}

/// The scale of the errors, then the methods.
fn pictures(cells: &SceneCells, entries: &[Entry], scale: f32) -> Vec<Tile> {
    let RadianceImage { width, height, .. } = cells.references[0].image;
    let key = Tile {
        caption: ["mean |error| of R, G, B".into(), format!("0 .. {scale} W/m2/sr")],
        picture: shown(&bar(width, height, scale), 1.0),
    };
    let methods = entries.iter().map(|entry| Tile {
        caption: wrapped(&entry.label),
        picture: shown(&entry.image, cells.exposure),
    });
    std::iter::once(key).chain(methods).collect()
}

/// A reference, then the errors of the methods against it.
fn errors(
    cells: &SceneCells,
    entries: &[Entry],
    index: usize,
    reference: &SceneReference,
    scale: f32,
) -> Vec<Tile> {
    let truth = Tile {
        caption: [
            format!("REFERENCE {}", reference.visibility),
            format!("{} samples", reference.samples),
        ],
        picture: shown(&reference.image, cells.exposure),
    };
    let errors = entries.iter().map(|entry| Tile {
        caption: [
            format!("error to {}", reference.visibility),
            format!("sRGB RMSE {}", short(entry.rmse[index])),
        ],
        picture: shown(&false_color(&entry.image, &reference.image, scale), 1.0),
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

/// One scale for the whole sheet: the 99th percentile of the mean absolute error over the components,
/// rounded up to 1, 2 or 5 times a power of ten, so that fireflies do not hide the rest.
fn scale(entries: &[Entry], references: &[SceneReference]) -> f32 {
    let mut errors: Vec<f32> = Vec::new();
    for entry in entries {
        for reference in references {
            let pairs = entry.image.pixels.iter().zip(&reference.image.pixels);
            errors
                .extend(pairs.map(|(a, b)| (0..3).map(|k| (a[k] - b[k]).abs()).sum::<f32>() / 3.0));
        }
    }
    errors.sort_by(f32::total_cmp);
    let percentile = errors.get(errors.len() * 99 / 100).copied().unwrap_or(0.0);
    round_up(if percentile > 0.0 { percentile } else { 1.0 })
}

fn round_up(value: f32) -> f32 {
    // In f64, so that the nearest f32 is that of the decimal number and prints as such.
    let power = 10_f64.powf(f64::from(value).log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| (step * power) as f32);
    steps.into_iter().find(|&step| step >= value).unwrap_or(value)
}

fn zoom(width: u32) -> u32 {
    MIN_TILE.div_ceil(width)
}

/// Bytes of a display-referred picture, each pixel repeated.
fn enlarged(shown: &RadianceImage) -> RgbImage {
    let zoom = zoom(shown.width);
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

fn compose(rows: &[Vec<Tile>]) -> RgbImage {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0) as u32;
    let (width, height) = rows[0][0].picture.dimensions();
    let (step_x, step_y) = (width + GAP, height + 2 * LINE + GAP);
    let size = (columns * step_x + GAP, rows.len() as u32 * step_y + GAP);
    let mut sheet = RgbImage::from_pixel(size.0, size.1, PAPER);
    for (row, tiles) in (0..).zip(rows) {
        for (column, tile) in (0..).zip(tiles) {
            let (x, y) = (GAP + column * step_x, GAP + row * step_y);
            for (line, text) in (0..).zip(&tile.caption) {
                let end = text.char_indices().nth(lettering::fitting(width));
                let text = &text[..end.map_or(text.len(), |(at, _)| at)];
                lettering::write(&mut sheet, x, y + line * LINE, text, INK);
            }
            image::imageops::replace(&mut sheet, &tile.picture, x.into(), (y + 2 * LINE).into());
        }
    }
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_round() {
        for (value, round) in
            [(0.11, "0.2"), (0.2, "0.2"), (0.003, "0.005"), (0.07, "0.1"), (3.0, "5")]
        {
            assert_eq!(round_up(value).to_string(), round);
        }
    }
}
