//! Where results go. What cannot be written is refused before anything is rendered.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::error::Failure;

/// Creates `directory` where it is missing and makes sure that it can be written.
///
/// # Errors
/// One line that names the option to change.
pub(crate) fn check_directory(directory: &Path, option: &str) -> Result<(), Failure> {
    std::fs::create_dir_all(directory)
        .and_then(|()| NamedTempFile::new_in(directory).map(drop))
        .map_err(|error| cannot_write(directory, option, error))
}

/// The EXR and the PNG beside it for `-o`.
///
/// # Errors
/// One line where the name does not end in `.exr` or its folder cannot be written.
pub(crate) fn check_image(path: &Path) -> Result<(PathBuf, PathBuf), Failure> {
    let png = path.with_extension("png");
    let is_exr = path.extension().is_some_and(|extension| extension == "exr");
    if !is_exr || path.is_dir() || png.is_dir() {
        return Err(Failure::input(format!(
            "{}: -o needs the name of an .exr file (the .png is written beside it)",
            path.display()
        )));
    }
    NamedTempFile::new_in(folder(path)).map_err(|error| cannot_write(path, "-o", error))?;
    Ok((path.to_owned(), png))
}

/// Refuses outputs that would replace what they are made from. Files that are not there yet replace
/// nothing.
///
/// # Errors
/// One line that names the file and the option to change.
pub(crate) fn keep_inputs<'a>(
    outputs: impl IntoIterator<Item = PathBuf>,
    inputs: impl IntoIterator<Item = &'a Path>,
    option: &str,
) -> Result<(), Failure> {
    let inputs: BTreeMap<_, _> =
        inputs.into_iter().filter_map(|path| Some((identity(path)?, path))).collect();
    for output in outputs {
        if let Some(input) = identity(&output).and_then(|file| inputs.get(&file)) {
            return Err(Failure::input(format!(
                "{} would be written over {}, which is an input: choose another {option}",
                output.display(),
                input.display()
            )));
        }
    }
    Ok(())
}

/// Whether both are there and one, through whatever links.
pub(crate) fn is_same_file(a: &Path, b: &Path) -> bool {
    identity(a).is_some_and(|file| Some(file) == identity(b))
}

/// What two paths to one file have in common; nothing where there is no file.
#[cfg(unix)]
fn identity(path: &Path) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    path.metadata().ok().map(|file| (file.dev(), file.ino()))
}

#[cfg(not(unix))]
fn identity(path: &Path) -> Option<PathBuf> {
    path.canonicalize().ok()
}

/// Says a line to people, on standard error. Nothing depends on whether anybody reads it: a closed pipe
/// must not end a run half-way, as it does with `eprintln!`.
pub(crate) fn say(line: impl Display) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Prints JSON on standard output, as [`print()`].
///
/// # Errors
/// Those of [`print()`].
pub(crate) fn print_json(value: &serde_json::Value) -> Result<(), Failure> {
    print(format!("{value}\n").as_bytes())
}

/// Prints what programs read, on standard output. A reader that has read enough is no error.
///
/// # Errors
/// One line where standard output cannot be written.
pub(crate) fn print(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::input(format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Writes a whole file or nothing.
///
/// # Errors
/// One line with the path.
pub(crate) fn write(path: &Path, contents: &[u8]) -> Result<(), Failure> {
    let write = || -> std::io::Result<()> {
        let mut builder = tempfile::Builder::new();
        // The default mode would keep everybody else from reading the results.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut file = builder.tempfile_in(folder(path))?;
        file.write_all(contents)?;
        file.as_file().sync_all()?;
        file.persist(path)?;
        Ok(())
    };
    write().map_err(|error| cannot_write(path, "the output", error))
}

fn cannot_write(path: &Path, option: &str, error: std::io::Error) -> Failure {
    Failure::input(format!("cannot write {}: {error}: choose another {option}", path.display()))
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}
