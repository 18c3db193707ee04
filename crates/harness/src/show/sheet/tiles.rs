//! The layout of a sheet: rows of captioned pictures.

use image::{Rgb, RgbImage, imageops};

use crate::question::crops::frame;
use crate::show::lettering::{self, LINE};

const GAP: u32 = 10;
/// Pixels of the line around a crop.
const FRAME: u32 = 3;
const INK: Rgb<u8> = Rgb([30, 30, 30]);
const PAPER: Rgb<u8> = Rgb([255, 255, 255]);

/// Left, top, width, height in pixels.
pub(super) type Rectangle = [u32; 4];

/// A picture with two lines of caption above it.
pub(super) struct Tile {
    /// Two lines.
    pub(super) caption: [String; 2],
    /// Below them.
    pub(super) picture: RgbImage,
}

/// Draws the outline of a rectangle within it.
pub(super) fn draw_frame(
    picture: &mut RgbImage,
    [left, top, width, height]: Rectangle,
    nth: usize,
) {
    let ink = Rgb(frame(nth));
    for inset in 0..FRAME.min(width / 2).min(height / 2) {
        let (right, bottom) = (left + width - 1 - inset, top + height - 1 - inset);
        for x in left + inset..=right {
            picture.put_pixel(x, top + inset, ink);
            picture.put_pixel(x, bottom, ink);
        }
        for y in top + inset..=bottom {
            picture.put_pixel(left + inset, y, ink);
            picture.put_pixel(right, y, ink);
        }
    }
}

/// Puts rows below each other; the pictures of a row are of one size, all rows of one width.
pub(super) fn compose(rows: &[Vec<Tile>]) -> RgbImage {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0) as u32;
    let width = rows[0][0].picture.width();
    let heights: Vec<u32> =
        rows.iter().map(|row| row[0].picture.height() + 2 * LINE + GAP).collect();
    let size = (columns * (width + GAP) + GAP, heights.iter().sum::<u32>() + GAP);
    let mut sheet = RgbImage::from_pixel(size.0, size.1, PAPER);
    let mut y = GAP;
    for (tiles, height) in rows.iter().zip(heights) {
        for (column, tile) in (0..).zip(tiles) {
            let x = GAP + column * (width + GAP);
            for (line, text) in (0..).zip(&tile.caption) {
                let end = text.char_indices().nth(lettering::fitting(width));
                let text = &text[..end.map_or(text.len(), |(at, _)| at)];
                lettering::write(&mut sheet, x, y + line * LINE, text, INK);
            }
            imageops::replace(&mut sheet, &tile.picture, x.into(), (y + 2 * LINE).into());
        }
        y += height;
    }
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_stay_within_their_rectangle() {
        for (rectangle, inked) in
            [([2, 3, 10, 9], 90 - 4 * 3), ([0, 0, 1, 1], 0), ([1, 1, 2, 5], 10)]
        {
            let mut picture = RgbImage::new(16, 16);
            draw_frame(&mut picture, rectangle, 0);
            let ink = picture.pixels().filter(|pixel| pixel.0 == frame(0)).count();
            assert_eq!(ink, inked, "{rectangle:?}");
        }
    }
}
