//! `manylights`: see the library.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

use std::io::Write;
use std::process::ExitCode;

use manylights_harness::cli;
use manylights_harness::registry::METHODS;

fn main() -> ExitCode {
    match cli::run(std::env::args_os(), METHODS) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // A reader of standard error that has gone is no reason to panic.
            let _ = writeln!(std::io::stderr(), "manylights: {failure}");
            ExitCode::from(failure.status())
        }
    }
}
