//! Parts of pictures that are shown enlarged.

use serde::Deserialize;

/// Frames of the crops of a scene, in turn: three of the palette of Okabe and Ito (2008) that are seen
/// on dark and on bright pictures.
const FRAMES: [[u8; 3]; 3] = [[230, 159, 0], [86, 180, 233], [0, 158, 115]];

/// Colour of the frame of the n-th crop of a scene, sRGB.
pub(crate) fn frame(nth: usize) -> [u8; 3] {
    FRAMES[nth % FRAMES.len()]
}

/// A rectangle of the pictures of a scene, the same for all methods.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Crop {
    /// Name of the scene.
    pub(crate) scene: String,
    /// Left, top, width, height in parts of the picture, whatever its resolution.
    rectangle: [f64; 4],
}

impl Crop {
    /// Refuses what is not within a picture.
    ///
    /// # Errors
    /// One line.
    pub(crate) fn check(&self) -> Result<(), String> {
        let [left, top, width, height] = self.rectangle;
        let within =
            |start: f64, length: f64| start >= 0.0 && length > 0.0 && start + length <= 1.0;
        if within(left, width) && within(top, height) {
            return Ok(());
        }
        Err(format!(
            "crops: the rectangle of `{}` must lie within [0, 1]: left, top, width, height",
            self.scene
        ))
    }

    /// Left, top, width, height in pixels; at least one pixel wide and high.
    pub(crate) fn pixels(&self, [width, height]: [u32; 2]) -> [u32; 4] {
        let span = |start: f64, length: f64, side: u32| {
            let side_length = f64::from(side);
            let first = ((start * side_length) as u32).min(side - 1);
            let count = ((length * side_length).round() as u32).clamp(1, side - first);
            (first, count)
        };
        let [x, y, w, h] = self.rectangle;
        let (left, columns) = span(x, w, width);
        let (top, rows) = span(y, h, height);
        [left, top, columns, rows]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crop(rectangle: [f64; 4]) -> Crop {
        Crop { scene: "s".into(), rectangle }
    }

    #[test]
    fn rectangles_lie_within_the_picture() {
        assert!(crop([0.0, 0.0, 1.0, 1.0]).check().is_ok());
        for bad in
            [[0.5, 0.0, 0.6, 1.0], [-0.1, 0.0, 0.2, 0.2], [0.0, 0.0, 0.0, 1.0], [f64::NAN; 4]]
        {
            assert!(crop(bad).check().is_err(), "{bad:?}");
        }
        assert_eq!(crop([0.5, 0.25, 0.5, 0.25]).pixels([64, 32]), [32, 8, 32, 8]);
        assert_eq!(crop([0.99, 0.99, 0.01, 0.01]).pixels([10, 10]), [9, 9, 1, 1]);
    }
}
