//! The files of an answer: tables, curves, sheets, report.

use std::path::Path;

use crate::answer::SceneAnswer;
use crate::curves::Figure;
use crate::error::Failure;
use crate::report::Report;
use crate::{output, sheet, table};

/// Writes them all into `out` and names them.
///
/// # Errors
/// One line where a picture cannot be read or a file cannot be written.
pub(crate) fn write(report: &Report<'_>, out: &Path) -> Result<(), Failure> {
    let Report { experiment, cells, answers, machine, .. } = report;
    let figure = Figure::new(experiment, answers);
    let mut files = vec![
        ("table.md".to_owned(), table::markdown(experiment, answers, machine).into_bytes()),
        ("table.tex".to_owned(), table::latex(experiment, answers, machine).into_bytes()),
        ("table.csv".to_owned(), table::csv(experiment, answers).into_bytes()),
        ("curves.svg".to_owned(), figure.svg()?.into_bytes()),
        ("curves.png".to_owned(), figure.png()?),
    ];
    for (cells, answer) in cells.iter().zip(*answers) {
        let name = format!("sheet-{}.png", cells.scene);
        files.push((name, sheet::png(experiment, cells, answer, out)?));
    }
    for (name, bytes) in files {
        let path = out.join(name);
        output::write(&path, &bytes)?;
        eprintln!("{}", path.display());
    }
    report.write(out)
}

/// One answer for each scene; the pictures are in `out`.
///
/// # Errors
/// One line where a picture cannot be read.
pub(crate) fn answers(
    experiment: &crate::experiment::Experiment,
    scenes: &[crate::session::SceneCells],
    out: &Path,
) -> Result<Vec<SceneAnswer>, Failure> {
    scenes.iter().map(|cells| SceneAnswer::new(experiment, cells, out)).collect()
}
