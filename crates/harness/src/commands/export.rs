//! `manylights export`: results in the formats of services that track benchmarks.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::answer::statistics::{Quartiles, quartiles};
use crate::error::Failure;
use crate::measurement::cell::{Cell, Done, Outcome};
use crate::measurement::journal;
use crate::output::print_json;
use clap::Args;
use std::path::PathBuf;

/// A service that tracks benchmarks.
#[derive(Clone, Copy, clap::ValueEnum)]
pub(crate) enum Tracker {
    /// Bencher Metric Format
    Bencher,
    /// customSmallerIsBetter
    GithubActionBenchmark,
}

#[derive(Args)]
pub(crate) struct ExportArguments {
    /// Folder of results
    pub(crate) directory: PathBuf,
    /// Of which tracker
    #[arg(long, value_enum)]
    pub(crate) format: Tracker,
}

/// Prints the medians of a folder of results.
///
/// # Errors
/// One line where the folder holds no cells, or cells of several machines: trackers have a place for
/// one.
pub(crate) fn run(arguments: &ExportArguments) -> Result<(), Failure> {
    let path = arguments.directory.join("cells.jsonl");
    let journal::Contents { cells, problems } = journal::read(&path)?;
    problems.iter().for_each(|problem| eprintln!("{problem}"));
    let at = |reason: &str| Failure::input(format!("{}: {reason}", path.display()));
    let machine = &cells.first().ok_or_else(|| at("no cells: run an experiment first"))?.provenance;
    if cells.iter().any(|cell| cell.provenance.machine != machine.machine) {
        return Err(at("cells of several machines: export each machine's own folder"));
    }
    let measures = measures(&latest(&cells));
    print_json(&match arguments.format {
        Tracker::Bencher => bencher(&measures),
        Tracker::GithubActionBenchmark => github_action_benchmark(&measures),
    })
}

/// The cells of the last build and size, each once: a folder may hold several profiles, and cells that
/// ran again stand in it twice.
fn latest(cells: &[Cell]) -> Vec<&Cell> {
    let size = |cell: &Cell| {
        (cell.provenance.program.clone(), cell.inputs.resolution, cell.inputs.references.clone())
    };
    let last = cells.last().map(size);
    let alike = cells.iter().filter(|cell| Some(size(cell)) == last);
    alike.map(|cell| (&cell.key, cell)).collect::<BTreeMap<_, _>>().into_values().collect()
}

/// Quartiles by benchmark (scene and variant) and measure.
type Measures = BTreeMap<String, BTreeMap<String, Quartiles>>;

fn measures(cells: &[&Cell]) -> Measures {
    let mut samples: BTreeMap<String, BTreeMap<String, Vec<f64>>> = BTreeMap::new();
    for cell in cells {
        let Outcome::Done(done) = &cell.outcome else { continue };
        let name = format!("{}/{}", cell.inputs.view(), cell.inputs.label());
        let measured = samples.entry(name).or_default();
        for (measure, value) in values(done) {
            measured.entry(measure).or_default().push(value);
        }
    }
    let condensed = |measured: BTreeMap<String, Vec<f64>>| {
        let quartile = |(name, values)| quartiles(values).map(|quartiles| (name, quartiles));
        measured.into_iter().filter_map(quartile).collect()
    };
    samples.into_iter().map(|(name, measured)| (name, condensed(measured))).collect()
}

fn values(done: &Done) -> Vec<(String, f64)> {
    let errors = done
        .errors
        .iter()
        .map(|(reference, errors)| (format!("rmse-{reference}"), errors.display.rmse));
    errors.chain([("seconds".to_owned(), done.step_seconds)]).collect()
}

/// Bencher Metric Format: benchmark → measure → value with bounds.
fn bencher(measures: &Measures) -> Value {
    let metric = |quartiles: &Quartiles| {
        json!({
            "value": quartiles.median,
            "lower_value": quartiles.lower,
            "upper_value": quartiles.upper,
        })
    };
    let benchmark = |measured: &BTreeMap<String, Quartiles>| -> Value {
        measured.iter().map(|(name, quartiles)| (name.clone(), metric(quartiles))).collect()
    };
    measures.iter().map(|(name, measured)| (name.clone(), benchmark(measured))).collect()
}

/// `customSmallerIsBetter` of github-action-benchmark: a list.
fn github_action_benchmark(measures: &Measures) -> Value {
    let entry = |name: &str, measure: &str, quartiles: &Quartiles| {
        json!({
            "name": format!("{name} {measure}"),
            "unit": if measure == "seconds" { "s" } else { "sRGB" },
            "value": quartiles.median,
            "range": format!("± {:.3e}", 0.5 * (quartiles.upper - quartiles.lower)),
        })
    };
    let entries = |(name, measured): (&String, &BTreeMap<String, Quartiles>)| {
        measured.iter().map(|(m, quartiles)| entry(name, m, quartiles)).collect::<Vec<_>>()
    };
    measures.iter().flat_map(entries).collect()
}
