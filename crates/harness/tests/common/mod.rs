//! Running the program.

use std::path::Path;
use std::process::{Child, Command, Output, Stdio};

use manylights_metrics::RadianceImage;

/// Runs the program from the root of the workspace, as the README does.
pub(crate) fn manylights(arguments: &[&str]) -> Output {
    command(arguments).output().expect("the program starts")
}

pub(crate) fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_manylights"));
    command
        .args(arguments)
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))
        .env_remove("MANYLIGHTS_CACHE")
        // Where it is unset, Mesa writes lines of its own to standard error.
        .env("XDG_RUNTIME_DIR", std::env::temp_dir());
    command
}

/// As [`manylights`], with the adapter opened for these limits.
pub(crate) fn manylights_within(limits: &str, arguments: &[&str]) -> Output {
    command(arguments).env("MANYLIGHTS_LIMITS", limits).output().expect("the program starts")
}

/// As [`manylights`], on a machine of this name.
pub(crate) fn manylights_on(machine: &str, arguments: &[&str]) -> Output {
    command(arguments).env("MANYLIGHTS_MACHINE", machine).output().expect("the program starts")
}

/// Starts the program and does not wait for it.
pub(crate) fn spawn(arguments: &[&str]) -> Child {
    command(arguments).stderr(Stdio::null()).spawn().expect("the program starts")
}

/// Asserts exit status 0.
pub(crate) fn succeeded(output: &Output) {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{:?}: {errors}", output.status);
}

/// Runs the program and parses its standard output.
pub(crate) fn json(arguments: &[&str]) -> serde_json::Value {
    let output = manylights(arguments);
    succeeded(&output);
    serde_json::from_slice(&output.stdout).expect("JSON on standard output")
}

/// Asserts exit status 2 and a single line that says `said`.
pub(crate) fn refused(arguments: &[&str], said: &str) {
    let output = manylights(arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {errors}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    assert_eq!(errors.lines().count(), 1, "{arguments:?}: {errors}");
    assert!(errors.contains(said), "{arguments:?}: {errors} does not say {said}");
    assert!(!errors.contains("panicked"), "{errors}");
}

/// A picture with all components of one value; its path.
pub(crate) fn write_image(
    folder: &Path,
    name: &str,
    [width, height]: [u32; 2],
    value: f32,
) -> String {
    let path = folder.join(name);
    let pixels = vec![[value; 3]; (width * height) as usize];
    RadianceImage { width, height, pixels }.write_exr(&path, &[]).expect("writable");
    path.to_str().expect("UTF-8").to_owned()
}
