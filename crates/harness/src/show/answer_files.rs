//! The files of an answer: tables, curves, sheets, report.

use std::path::{Path, PathBuf};

use crate::answer::error_column::ErrorColumn;
use crate::answer::rows::SceneAnswer;
use crate::error::Failure;
use crate::measurement::scene_cells::SceneCells;
use crate::output::{self, say};
use crate::question::experiment::Experiment;
use crate::show::curves::Figure;
use crate::show::report::{self, Report};
use crate::show::sheet;
use crate::show::table;

/// The files that every answer has beside a sheet for each scene.
const FILES: [&str; 5] = ["table.md", "table.tex", "table.csv", "curves.svg", "curves.png"];

/// What [`write()`] writes to `out` for scenes of these names.
pub(crate) fn paths<'a>(scenes: impl Iterator<Item = &'a str>, out: &Path) -> Vec<PathBuf> {
    let names = FILES.into_iter().chain([report::FILE]).map(str::to_owned);
    names.chain(scenes.map(sheet_name)).map(|name| out.join(name)).collect()
}

fn sheet_name(scene: &str) -> String {
    format!("sheet-{scene}.png")
}

/// Condenses the cells of `out`, whose pictures are there, writes all files of the answer beside them
/// and names these. `command` is what makes the results again; curves are of the RMSE unless another
/// error is asked for.
///
/// # Errors
/// One line where a picture cannot be read or a file cannot be written.
pub(crate) fn write(
    experiment: &Experiment,
    cells: &[SceneCells],
    command: String,
    curves_error: Option<ErrorColumn>,
    out: &Path,
) -> Result<Vec<SceneAnswer>, Failure> {
    let machine = SceneCells::provenance(cells).expect("an answer is there for its cells");
    let answers: Vec<SceneAnswer> = cells
        .iter()
        .map(|cells| SceneAnswer::new(experiment, cells, out))
        .collect::<Result<_, _>>()?;
    let figure = Figure::new(experiment, &answers, curves_error);
    let contents = [
        table::markdown(experiment, &answers, machine).into_bytes(),
        table::latex(experiment, &answers, machine).into_bytes(),
        table::csv(experiment, &answers).into_bytes(),
        figure.svg()?.into_bytes(),
        figure.png()?,
    ];
    let mut files: Vec<_> = FILES.map(str::to_owned).into_iter().zip(contents).collect();
    for (cells, answer) in cells.iter().zip(&answers) {
        files.push((sheet_name(&cells.scene), sheet::png(experiment, cells, answer, out)?));
    }
    for (name, bytes) in files {
        let path = out.join(name);
        output::write(&path, &bytes)?;
        say(path.display());
    }
    Report { experiment, cells, answers: &answers, machine, command, curves_error }.write(out)?;
    Ok(answers)
}
