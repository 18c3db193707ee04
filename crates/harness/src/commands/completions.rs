//! `manylights completions`.

use clap_complete::Shell;

use crate::error::Failure;
use crate::output;

/// Prints the completions of a shell.
///
/// # Errors
/// One line where standard output cannot be written.
pub(crate) fn run(shell: Shell, command: &mut clap::Command) -> Result<(), Failure> {
    // The generator panics where it cannot write.
    let mut script = Vec::new();
    clap_complete::generate(shell, command, "manylights", &mut script);
    output::print(&script)
}
