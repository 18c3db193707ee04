//! Text on pictures, from an 8×8 bitmap font.

use font8x8::legacy::BASIC_LEGACY;
use image::{Rgb, RgbImage};

/// Height of a line in pixels.
pub(crate) const LINE: u32 = 20;
/// The font is drawn at twice its size.
const ZOOM: u32 = 2;
/// Width of a character in pixels.
const CHARACTER: u32 = 8 * ZOOM;

/// Characters of a line that fit into `width` pixels.
pub(crate) fn fitting(width: u32) -> usize {
    (width / CHARACTER) as usize
}

/// Writes a line of ASCII with its upper left corner at (`x`, `y`); what does not fit is cut off.
pub(crate) fn write(picture: &mut RgbImage, x: u32, y: u32, text: &str, color: Rgb<u8>) {
    for dot in dots_of(text) {
        let (left, top) = (x + ZOOM * dot.0, y + ZOOM * dot.1);
        for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            if let Some(pixel) = picture.get_pixel_mut_checked(left + dx, top + dy) {
                *pixel = color;
            }
        }
    }
}

/// Set dots of a line of ASCII as (column, row): eight of each for a character.
pub(crate) fn dots_of(text: &str) -> impl Iterator<Item = (u32, u32)> + '_ {
    (0..).step_by(8).zip(text.chars()).flat_map(|(left, character)| {
        let glyph = BASIC_LEGACY.get(character as usize).unwrap_or(&BASIC_LEGACY[b'?' as usize]);
        dots(glyph).map(move |(column, row)| (left + column, row))
    })
}

/// Set dots as (column, row); the lowest bit of a row is its leftmost dot.
fn dots(glyph: &[u8; 8]) -> impl Iterator<Item = (u32, u32)> + '_ {
    (0..8).flat_map(move |row: u32| {
        (0..8).filter(move |column| glyph[row as usize] >> column & 1 == 1).map(move |c| (c, row))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_leave_ink_and_clip_at_the_edge() {
        let mut picture = RgbImage::new(20, 16);
        write(&mut picture, 0, 0, "L~L", Rgb([255; 3]));
        let ink = picture.pixels().filter(|pixel| pixel.0[0] > 0).count();
        assert!(ink > 20, "{ink}");
        // The stem of an L is on the left.
        assert!((0..16).any(|y| picture.get_pixel(3, y).0[0] > 0));
    }
}
