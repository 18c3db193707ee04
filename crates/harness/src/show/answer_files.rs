//! The files of an answer: tables, curves, sheets, report.

use std::path::Path;

use crate::answer::rows::SceneAnswer;
use crate::error::Failure;
use crate::measurement::scene_cells::SceneCells;
use crate::output::{self, say};
use crate::question::experiment::Experiment;
use crate::show::curves::Figure;
use crate::show::report::Report;
use crate::show::sheet;
use crate::show::table;

/// Condenses the cells of `out`, whose pictures are there, writes all files of the answer beside them
/// and names these. `command` is what makes the results again.
///
/// # Errors
/// One line where a picture cannot be read or a file cannot be written.
pub(crate) fn write(
    experiment: &Experiment,
    cells: &[SceneCells],
    command: String,
    out: &Path,
) -> Result<Vec<SceneAnswer>, Failure> {
    let machine = SceneCells::provenance(cells).expect("an answer is there for its cells");
    let answers: Vec<SceneAnswer> = cells
        .iter()
        .map(|cells| SceneAnswer::new(experiment, cells, out))
        .collect::<Result<_, _>>()?;
    let figure = Figure::new(experiment, &answers);
    let mut files = vec![
        ("table.md".to_owned(), table::markdown(experiment, &answers, machine).into_bytes()),
        ("table.tex".to_owned(), table::latex(experiment, &answers, machine).into_bytes()),
        ("table.csv".to_owned(), table::csv(experiment, &answers).into_bytes()),
        ("curves.svg".to_owned(), figure.svg()?.into_bytes()),
        ("curves.png".to_owned(), figure.png()?),
    ];
    for (cells, answer) in cells.iter().zip(&answers) {
        let name = format!("sheet-{}.png", cells.scene);
        files.push((name, sheet::png(experiment, cells, answer, out)?));
    }
    for (name, bytes) in files {
        let path = out.join(name);
        output::write(&path, &bytes)?;
        say(path.display());
    }
    Report { experiment, cells, answers: &answers, machine, command }.write(out)?;
    Ok(answers)
}
