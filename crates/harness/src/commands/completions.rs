//! `manylights completions`.

use clap_complete::Shell;

/// Prints the completions of a shell.
pub(crate) fn run(shell: Shell, command: &mut clap::Command) {
    clap_complete::generate(shell, command, "manylights", &mut std::io::stdout());
}
