//! `manylights`: see the library.

use std::process::ExitCode;

use manylights_harness::cli;
use manylights_harness::registry::METHODS;

fn main() -> ExitCode {
    match cli::run(std::env::args_os(), METHODS) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("manylights: {failure}");
            ExitCode::from(failure.status())
        }
    }
}
