//! `manylights merge`.

use std::path::{Path, PathBuf};

use crate::error::Failure;
use crate::measurement::cell::{Cell, Outcome};
use crate::measurement::journal::Journal;
use crate::measurement::lines;
use crate::measurement::pictures::image_path;
use crate::output::{self, say};
use crate::registry::Methods;
use crate::show::answer_files;
use crate::show::report::{self, Loaded};
use clap::Args;

#[derive(Args)]
pub(crate) struct MergeArguments {
    /// Folders of results of one experiment
    #[arg(required = true)]
    pub(crate) directories: Vec<PathBuf>,
    /// Folder of the merged results
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
}

/// Brings the results of several folders, from several machines, into one, and writes its answer. A
/// row is one machine's; ratios are to the baseline of the same machine.
///
/// # Errors
/// One line where a folder holds no results or those of another experiment, or is that of the merged
/// results.
pub(crate) fn run(arguments: &MergeArguments, methods: Methods) -> Result<(), Failure> {
    let out = &arguments.out;
    let parts = |folder: &Path| ["cells.jsonl", "cells"].map(|name| folder.join(name));
    let inputs: Vec<_> = arguments.directories.iter().flat_map(|folder| parts(folder)).collect();
    output::keep_inputs(parts(out), inputs.iter().map(PathBuf::as_path), "--out")?;
    output::check_directory(&out.join("cells"), "--out")?;
    let mut journal = Journal::open(out)?;
    for directory in &arguments.directories {
        keep_question(directory, out)?;
        let lines::Contents { lines, problems, notes } =
            lines::read(&directory.join("cells.jsonl"))?;
        notes.iter().for_each(say);
        problems.iter().for_each(|problem| say(format_args!("{problem}; left out")));
        if lines.is_empty() {
            return Err(Failure::input(format!("{}: no cells to merge", directory.display())));
        }
        copy_references(directory, out)?;
        for line in lines {
            // Pictures first: a cell of the journal has one.
            if journal.get(&line.cell.key) != Some(&line.cell) {
                copy_pictures(&line.cell, directory, out)?;
                journal.append_line(line)?;
            }
        }
    }
    let Loaded { experiment, scenes } = report::load(out, methods)?;
    let command = report::command(&out.join("experiment.toml"), &experiment, None);
    answer_files::write(&experiment, &scenes, command, None, out)?;
    Ok(())
}

/// All folders must answer the same question.
fn keep_question(directory: &Path, out: &Path) -> Result<(), Failure> {
    let [theirs, ours] = [directory, out].map(|folder| folder.join("experiment.toml"));
    let text = std::fs::read(&theirs)
        .map_err(|error| Failure::input(format!("{}: {error}", theirs.display())))?;
    match std::fs::read(&ours) {
        Ok(known) if known == text => Ok(()),
        Ok(_) => Err(Failure::input(format!(
            "{} differs from {}: only results of one experiment can be merged",
            theirs.display(),
            ours.display()
        ))),
        Err(_) => output::write(&ours, &text),
    }
}

fn copy_pictures(cell: &Cell, from: &Path, to: &Path) -> Result<(), Failure> {
    if !matches!(cell.outcome, Outcome::Done(_)) || cell.inputs.repetition > 0 {
        return Ok(());
    }
    let [from, to] = [from, to].map(|folder| image_path(folder, &cell.inputs.view(), &cell.key));
    for extension in ["exr", "png", "layers.exr"] {
        let [from, to] = [&from, &to].map(|path| path.with_extension(extension));
        copy(&from, &to)?;
    }
    Ok(())
}

fn copy_references(from: &Path, to: &Path) -> Result<(), Failure> {
    let folder = from.join("cells");
    let at = |error: std::io::Error| Failure::input(format!("{}: {error}", folder.display()));
    for entry in folder.read_dir().map_err(at)? {
        let name = entry.map_err(at)?.file_name();
        if name.to_str().is_some_and(|name| name.contains("-reference-")) {
            copy(&folder.join(&name), &to.join("cells").join(&name))?;
        }
    }
    Ok(())
}

/// Copies what is there.
fn copy(from: &Path, to: &Path) -> Result<(), Failure> {
    if !from.exists() {
        return Ok(());
    }
    let bytes = std::fs::read(from)
        .map_err(|error| Failure::input(format!("{}: {error}", from.display())))?;
    output::write(to, &bytes)
}
