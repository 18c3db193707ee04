//! What a header of OpenEXR says about where pixels lie and what their numbers mean.

use std::fmt::{Display, Formatter};

use exr::meta::attribute::Chromaticities;
use exr::meta::header::Header;
use exr::prelude::Vec2;

/// CIE x and y of red, green, blue and white: ITU-R BT.709-6, items 1.3 and 1.4.
const REC_709: [[f32; 2]; 4] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];
/// Programs round to three digits. Ten times that is the way to the nearest other primary in use, the
/// green of EBU Tech. 3213.
const ROUNDING: f32 = 1e-3;

/// Where the pixels of a file lie in its frame: OpenEXR's data and display window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Column and row of the first pixel.
    pub first: [i32; 2],
    /// Column and row where the frame starts.
    pub frame_first: [i32; 2],
    /// Width and height of the frame in pixels.
    pub frame_size: [usize; 2],
}

impl Window {
    pub(crate) fn of(header: &Header) -> Self {
        let first = header.own_attributes.layer_position;
        let frame = header.shared_attributes.display_window;
        Self {
            first: [first.x(), first.y()],
            frame_first: [frame.position.x(), frame.position.y()],
            frame_size: [frame.size.width(), frame.size.height()],
        }
    }
}

impl Display for Window {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { first: [column, row], frame_first, frame_size: [width, height] } = self;
        write!(formatter, "column {column}, row {row} of a frame of {width}×{height} pixels")?;
        match frame_first {
            [0, 0] => Ok(()),
            [column, row] => write!(formatter, " from column {column}, row {row}"),
        }
    }
}

/// Refuses a file that says that its numbers are not of Rec. 709. One that says nothing is.
pub(crate) fn check_colors(header: &Header) -> exr::error::Result<()> {
    let Some(Chromaticities { red, green, blue, white }) = header.shared_attributes.chromaticities
    else {
        return Ok(());
    };
    let theirs = [red, green, blue, white].map(|Vec2(x, y)| [x, y]);
    let pairs = theirs.as_flattened().iter().zip(REC_709.as_flattened());
    if pairs.into_iter().all(|(theirs, ours)| (theirs - ours).abs() <= ROUNDING) {
        return Ok(());
    }
    let [red, green, blue, white] = theirs.map(|[x, y]| format!("{x} {y}"));
    let reason = format!(
        "its chromaticities (red {red}, green {green}, blue {blue}, white {white}) are not those of \
         Rec. 709: convert it to linear Rec. 709 first"
    );
    Err(exr::error::Error::Invalid(reason.into()))
}
