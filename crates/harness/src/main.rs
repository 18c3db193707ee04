//! `manylights`: see the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    match manylights_harness::cli::run(std::env::args_os()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("manylights: {failure}");
            ExitCode::from(failure.status())
        }
    }
}
