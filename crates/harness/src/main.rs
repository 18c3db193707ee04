//! `manylights`: see the library.
#![warn(clippy::print_stderr, clippy::print_stdout)]

use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    match manylights_harness::cli::run(std::env::args_os()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // A reader of standard error that has gone is no reason to panic.
            let _ = writeln!(std::io::stderr(), "manylights: {failure}");
            ExitCode::from(failure.status())
        }
    }
}
