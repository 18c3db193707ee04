//! How methods look in plots. Colour and marker follow from the place in the registry alone, so a
//! method looks the same in every figure.

use plotters::style::RGBColor;

/// The palette of Okabe and Ito (2008), told apart by colour-blind readers, without its yellow.
const COLORS: [RGBColor; 7] = [
    RGBColor(0, 0, 0),
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];

/// Shape of the points of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Cross,
}

const MARKERS: [Marker; 5] =
    [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Diamond, Marker::Cross];

/// Colour and marker of the method at a place in the registry. Both cycles differ in length: 35 methods differ.
pub(crate) fn method_style(place: usize) -> (RGBColor, Marker) {
    (COLORS[place % COLORS.len()], MARKERS[place % MARKERS.len()])
}

/// Dash and gap in pixels of the n-th curve of one method; `None` for a full line.
pub(crate) fn dashes(nth: usize) -> Option<(u32, u32)> {
    match nth {
        0 => None,
        1 => Some((9, 4)),
        2 => Some((3, 3)),
        more => Some((9 + 5 * more as u32, 6)),
    }
}
