//! Tells the program its commit and its compiler, for the provenance of results.

use std::process::Command;

fn main() {
    // Sources of all crates and the git state: a later edit must not pass for the commit.
    for path in ["..", "../../Cargo.lock", "../../scenes"] {
        println!("cargo::rerun-if-changed={path}");
    }
    for file in ["HEAD", "index"] {
        if let Some(path) = output("git", &["rev-parse", "--git-path", file]) {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    if let Some(commit) = output("git", &["describe", "--always", "--dirty", "--abbrev=12"]) {
        println!("cargo::rustc-env=MANYLIGHTS_COMMIT={commit}");
    }
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let version = output(&rustc, &["--version"]).unwrap_or_else(|| "rustc unknown".to_owned());
    println!("cargo::rustc-env=MANYLIGHTS_RUSTC={version}");
}

fn output(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?.trim().to_owned();
    (output.status.success() && !text.is_empty()).then_some(text)
}
