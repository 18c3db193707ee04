//! One scale for the errors of all methods of a scene.

use manylights_metrics::RadianceImage;

use crate::measurement::reference::SceneReference;

/// That of pictures against any of the references of their scene.
pub(crate) fn error_scale(images: &[&RadianceImage], references: &[SceneReference]) -> f32 {
    scale_of(images, &references.iter().map(SceneReference::image).collect::<Vec<_>>())
}

/// The 99th percentile of the mean absolute error over the components, against any of the references,
/// rounded up to 1, 2 or 5 times a power of ten, so that fireflies do not hide the rest.
pub(crate) fn scale_of(images: &[&RadianceImage], references: &[&RadianceImage]) -> f32 {
    let mut errors: Vec<f32> = Vec::new();
    for image in images {
        for reference in references {
            let pairs = image.pixels.iter().zip(&reference.pixels);
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
