use std::path::PathBuf;

/// Why there is no reference. Displays as one line.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The settings make no picture.
    #[error("{0}")]
    Settings(String),
    /// A path carried a radiance that is infinite or not a number.
    #[error(
        "radiance of pixel ({x}, {y}) is {value:?} in slice {slice}: \
         the scene holds values beyond what single precision carries"
    )]
    NonFinite {
        /// Column.
        x: u32,
        /// Row.
        y: u32,
        /// Slice of samples, from 0.
        slice: u32,
        /// Linear radiance.
        value: [f32; 3],
    },
    /// The cache could not be written.
    #[error("reference cache {}: {source}", path.display())]
    Cache {
        /// File or folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

impl From<Error> for manylights_method::Error {
    fn from(error: Error) -> Self {
        match error {
            Error::Settings(reason) => Self::Declined(reason),
            other => Self::Failed(other.to_string()),
        }
    }
}
