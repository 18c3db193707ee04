//! Files that appear complete or not at all.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use crate::Error;

/// Writes `path` through a temporary file in the same folder and renames it into place, so that a
/// reader or a killed run never meets half a file.
pub(crate) fn write_atomically(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<&mut File>) -> Result<(), String>,
) -> Result<(), Error> {
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    // The default mode would keep everybody else from reading the picture.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut temporary = builder.tempfile_in(folder).map_err(|error| Error::write(path, error))?;
    let mut writer = BufWriter::new(temporary.as_file_mut());
    fill(&mut writer).map_err(|reason| Error::write(path, reason))?;
    writer.flush().map_err(|error| Error::write(path, error))?;
    drop(writer);
    temporary.persist(path).map_err(|error| Error::write(path, error.error))?;
    Ok(())
}
