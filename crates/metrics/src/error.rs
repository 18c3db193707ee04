//! What can go wrong with pictures.

use std::path::{Path, PathBuf};

use crate::Window;

/// A picture that cannot be read, written or compared. Each message is one line.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file that is missing, unreadable, damaged or not a picture of three channels.
    #[error("cannot read {}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A file that cannot be written.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why not.
        reason: String,
    },
    /// Two pictures of different sizes.
    #[error("the image is {}×{} pixels, the reference {}×{}: they must agree", image[0], image[1], reference[0], reference[1])]
    Sizes {
        /// Width and height of the image in pixels.
        image: [u32; 2],
        /// Width and height of the reference in pixels.
        reference: [u32; 2],
    },
    /// Two pictures of one size that lie elsewhere.
    #[error(
        "the image starts at {image}, the reference at {reference}: their pixels do not lie on each \
         other; bring both to one frame (oiiotool --croptofull)"
    )]
    Windows {
        /// Where the image lies.
        image: Window,
        /// Where the reference lies.
        reference: Window,
    },
    /// Pixels that are infinite or not a number.
    #[error(
        "{count} of the {which}'s pixels are not finite, the first at column {column}, row {row}"
    )]
    NonFinite {
        /// `image` or `reference`.
        which: &'static str,
        /// How many pixels.
        count: usize,
        /// Column of the first one in row-major order.
        column: u32,
        /// Its row, 0 at the top.
        row: u32,
    },
    /// A picture smaller than the window of SSIM.
    #[error("{width}×{height} pixels are too few to compare: SSIM needs 11×11")]
    TooSmall {
        /// Pixels a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// A picture whose `pixels` do not fill its size.
    #[error("a picture of {width}×{height} pixels holds {length}")]
    Shape {
        /// Pixels a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Pixels that are there.
        length: usize,
    },
    /// A range that no error can be relative to, as that of a black reference.
    #[error(
        "the range of the values is {0}: it must be finite and above zero (is the reference black?)"
    )]
    Range(f64),
    /// An exposure that shows nothing.
    #[error("the exposure is {0}: it must be finite and above zero")]
    Exposure(f32),
}

impl Error {
    pub(crate) fn read(path: &Path, reason: impl ToString) -> Self {
        Self::Read { path: path.to_owned(), reason: one_line(&reason.to_string()) }
    }

    pub(crate) fn write(path: &Path, reason: impl ToString) -> Self {
        Self::Write { path: path.to_owned(), reason: one_line(&reason.to_string()) }
    }
}

/// Names taken from a file may hold line ends and other control characters.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}
