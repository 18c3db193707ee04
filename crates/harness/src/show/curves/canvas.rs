//! What all parts of the figure draw with.

use plotters::coord::Shift;
use plotters::prelude::*;

/// Of all words.
pub(super) const FONT: &str = "sans-serif";
/// Of words.
pub(super) const TEXT: RGBColor = RGBColor(40, 40, 40);
/// Of the noise floor.
pub(super) const FLOOR: RGBColor = RGBColor(120, 120, 120);

/// What is drawn on.
pub(super) type Canvas<B> = DrawingArea<B, Shift>;
/// How drawing ends.
pub(super) type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;
