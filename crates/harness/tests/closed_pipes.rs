//! Whoever reads what the program says may stop: `manylights run … 2>&1 | head -1`.

use crate::common;
use std::path::Path;
use std::process::Command;

use crate::common::{command, succeeded};

const EXPERIMENT: &str = r#"
title = "Test"
question = "Does it end?"
scenes = ["cornell"]
transport = "indirect-1"
references = ["traced", "ignored"]
[[methods]]
id = "reference"
parameters = { samples = [1, 4] }
[profiles.quick]
resolution = [16, 16]
reference_samples = 32
repetitions = 2
seeds = [1, 2]
"#;

/// Both ends closed before the program starts: every write fails.
fn status(arguments: &[&str], folder: &Path) -> Option<i32> {
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let mut command: Command = command(arguments);
    command.stdout(writer.try_clone().expect("a handle")).stderr(writer);
    command.env("MANYLIGHTS_CACHE", folder.join("cache"));
    command.status().expect("the program starts").code()
}

#[test]
fn closed_pipes_end_nothing_half_way() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let folder = folder.path();
    let path = |name: &str| folder.join(name).to_str().expect("UTF-8").to_owned();
    let (file, out, picture) = (path("experiment.toml"), path("out"), path("a.exr"));
    std::fs::write(&file, EXPERIMENT).expect("writable");
    let render: [&str; 11] = [
        "render",
        "--scene",
        "cornell",
        "--method",
        "reference",
        "--resolution",
        "16x16",
        "--set",
        "samples=1",
        "-o",
        &picture,
    ];
    let run = ["run", &file, "--profile", "quick", "--out", &out];
    for arguments in [
        &run[..],
        &["report", &out],
        &["plan", &file, "--profile", "quick"],
        &["plan", &file, "--profile", "quick", "--json"],
        &render,
        &["metrics", &picture, &picture],
        &["metrics", &picture, &picture, "--json"],
        &["list", "methods"],
        &["list", "methods", "--json"],
        &["export", &out, "--format", "bencher"],
        &["check", "--baseline", &out, "--bless"],
        &["check", "--baseline", &out],
        &["merge", &out, "--out", &path("merged")],
        &["completions", "bash"],
        &["--help"],
        &["--version"],
    ] {
        assert_eq!(status(arguments, folder), Some(0), "{arguments:?}");
    }
    assert!(folder.join("out/table.md").exists(), "the run went on to its end");
    // What is refused is refused whether or not anybody hears it.
    assert_eq!(status(&["run", "missing.toml"], folder), Some(2));
    succeeded(&common::manylights(&["report", &out]));
}
