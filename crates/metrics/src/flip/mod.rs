//! ꟻLIP, how different two pictures look when they alternate in one place: Andersson, Nilsson, Akenine-Möller,
//! Oskarsson, Åström and Fairchild, "ꟻLIP: A Difference Evaluator for Alternating Images" (HPG 2020). Steps and
//! constants are the paper's: colours as far as contrast sensitivity lets the observer see them, then edges and
//! points, which sharpen the differences of colour.

mod color;
mod features;
mod plane;
mod sensitivity;

use color::{Display, Lab};
use features::Features;
use plane::Plane;

use crate::RadianceImage;

/// Compresses differences of colour.
const COLOR_EXPONENT: f64 = 0.7;
/// Differences of colour up to this part of the largest one ...
const KNEE: f64 = 0.4;
/// ... are spread over this part of the results.
const KNEE_RESULT: f64 = 0.95;
/// Expands differences of features.
const FEATURE_EXPONENT: f64 = 0.5;

/// Mean of the differences over all pixels of two pictures of sRGB values in `[0, 1]`, which have one size: 0
/// where they are equal, at most 1. It is symmetric.
pub(crate) fn mean(image: &RadianceImage, reference: &RadianceImage) -> f64 {
    let display = Display::new();
    let [image, reference] = [image, reference].map(|picture| Seen::new(picture, &display));
    let largest = largest_color_difference(&display);
    let colors = image.colors.iter().zip(&reference.colors);
    let features = image.features.iter().zip(&reference.features);
    let differences: Vec<f64> = colors
        .zip(features)
        .map(|((color, other_color), (features, other_features))| {
            let color = color.distance(other_color).powf(COLOR_EXPONENT);
            let color = redistributed(color, largest);
            let feature = features.difference(other_features).powf(FEATURE_EXPONENT);
            color.powf(1.0 - feature)
        })
        .collect();
    // Row by row: sums of sums lose fewer digits than one long sum.
    let rows = differences.chunks_exact(image.width);
    rows.map(|row| row.iter().sum::<f64>()).sum::<f64>() / differences.len() as f64
}

/// A picture as the observer has it, pixel by pixel.
struct Seen {
    width: usize,
    colors: Vec<Lab>,
    features: Vec<Features>,
}

impl Seen {
    fn new(picture: &RadianceImage, display: &Display) -> Self {
        let width = picture.width as usize;
        let opponent: Vec<[f64; 3]> =
            picture.pixels.iter().map(|pixel| display.opponent(pixel)).collect();
        let channels = [0, 1, 2].map(|channel| {
            let values = opponent.iter().map(|pixel| pixel[channel]).collect();
            Plane { width, values }
        });
        let features = features::of_achromatic(&channels[0]);
        let [luminance, red_green, blue_yellow] = sensitivity::filtered(&channels);
        let pixels = luminance.values.iter().zip(&red_green.values).zip(&blue_yellow.values);
        let colors = pixels.map(|((&a, &b), &c)| display.lab_of_opponent([a, b, c])).collect();
        Self { width, colors, features }
    }
}

/// Of colours that a display shows: that of pure green and blue.
fn largest_color_difference(display: &Display) -> f64 {
    let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|linear| display.lab(linear));
    green.distance(&blue).powf(COLOR_EXPONENT)
}

/// Two straight lines, so that the many small differences have most of the results.
fn redistributed(difference: f64, largest: f64) -> f64 {
    let knee = KNEE * largest;
    if difference < knee {
        KNEE_RESULT / knee * difference
    } else {
        KNEE_RESULT + (difference - knee) / (largest - knee) * (1.0 - KNEE_RESULT)
    }
}
