//! The small pictures that `scripts/metrics-fixtures` makes too, by the same formulas. Every value is
//! a small integer over a power of two, so that f32 and Python agree on it exactly.

pub(crate) mod exr_files;

use manylights_metrics::RadianceImage;

/// A picture whose components are `value(column, row, component)`.
pub(crate) fn picture(
    width: u32,
    height: u32,
    mut value: impl FnMut(u32, u32, usize) -> f64,
) -> RadianceImage {
    let mut image = RadianceImage::black(width, height);
    for (index, pixel) in (0..).zip(&mut image.pixels) {
        for (component, c) in pixel.iter_mut().enumerate() {
            *c = value(index % width, index / width, component) as f32;
        }
    }
    image
}

/// Integers 0..=255 from a linear congruential generator (Knuth's MMIX).
pub(crate) fn noise(width: u32, height: u32, seed: u64) -> RadianceImage {
    let mut state = seed;
    picture(width, height, |_, _, _| f64::from(next(&mut state)))
}

/// The high byte of the next state of the generator of [`noise`].
pub(crate) fn next(state: &mut u64) -> u8 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 56) as u8
}

/// Integers that rise by 2, 3 and 5 a column and by 3, 1 and 0 a row.
pub(crate) fn gradient(width: u32, height: u32) -> RadianceImage {
    picture(width, height, |column, row, component| {
        f64::from([2 * column + 3 * row, 3 * column + row, 5 * column][component])
    })
}

/// `f` of the components of both pictures, in f64.
pub(crate) fn combine(
    a: &RadianceImage,
    b: &RadianceImage,
    f: impl Fn(f64, f64) -> f64,
) -> RadianceImage {
    picture(a.width, a.height, |column, row, component| {
        let index = (row * a.width + column) as usize;
        f(f64::from(a.pixels[index][component]), f64::from(b.pixels[index][component]))
    })
}

/// `f` of every component, in f64.
pub(crate) fn map(image: &RadianceImage, f: impl Fn(f64) -> f64) -> RadianceImage {
    combine(image, image, |c, _| f(c))
}
