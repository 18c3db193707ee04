//! `manylights check`.

use std::path::{Path, PathBuf};

use crate::answer::regression::times::{self, seconds};
use crate::answer::regression::{self, Moved};
use crate::answer::statistics::median;
use crate::commands::machine::Machine;
use crate::commands::run;
use crate::error::Failure;
use crate::measurement::cell::Cell;
use crate::measurement::inputs::{Inputs, Seen};
use crate::measurement::lines;
use crate::measurement::pictures::image_path;
use crate::measurement::provenance::Provenance;
use crate::measurement::session::Session;
use crate::output::{self, print_json, say};
use crate::question::experiment::{self, Experiment};
use crate::question::profiles::Profile;
use crate::registry::Methods;
use crate::show::changes::{self, Change};
use clap::Args;
use manylights_metrics::RadianceImage;

#[derive(Args)]
pub(crate) struct CheckArguments {
    /// Folders of baselines: each an experiment.toml and its cells.jsonl
    #[arg(
        long,
        value_name = "DIR",
        num_args = 1..,
        default_values = ["results/check", "results/check-direct"]
    )]
    pub(crate) baseline: Vec<PathBuf>,
    /// Makes what comes out the new baseline
    #[arg(long)]
    pub(crate) bless: bool,
    /// Times decide as well: each as a multiple of that of the experiment's baseline, against the spread
    /// over the seeds and repetitions of the blessed run
    #[arg(long, conflicts_with = "bless")]
    pub(crate) times: bool,
    /// What moved as a page, with pictures: before, now, difference
    #[arg(long, value_name = "FILE.html", conflicts_with = "bless")]
    pub(crate) page: Option<PathBuf>,
    /// What moved, as JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) machine: Machine,
}

/// Runs the quick profile of each baseline's experiment afresh and compares. With `--bless`, what came
/// out becomes the baseline. Where a time is the budget, the baseline's amount of work is repeated, since
/// a search ends elsewhere each time.
///
/// # Errors
/// One line: bad input; or something moved, after a table of it.
pub(crate) fn run(arguments: &CheckArguments, methods: Methods) -> Result<(), Failure> {
    let mut moved = Vec::new();
    let mut changes = Vec::new();
    let mut folders = Vec::new();
    for directory in &arguments.baseline {
        let (of_folder, pictures) = compare(directory, arguments, methods)?;
        if !of_folder.is_empty() {
            folders.push(directory.display().to_string());
        }
        moved.extend(of_folder);
        changes.extend(pictures);
    }
    if let Some(page) = &arguments.page {
        output::write(page, changes::page(&moved, &changes)?.as_bytes())?;
    }
    if arguments.json {
        print_json(&serde_json::to_value(&moved).expect("plain data"))?;
    }
    if moved.is_empty() {
        return Ok(());
    }
    print_table(&moved);
    Err(Failure::Failed(format!(
        "{} quantities moved; where that is meant: manylights check --baseline {} --bless",
        moved.len(),
        folders.join(" ")
    )))
}

/// What moved against one baseline, and the pictures of it; nothing where it is blessed.
fn compare(
    directory: &Path,
    arguments: &CheckArguments,
    methods: Methods,
) -> Result<(Vec<Moved>, Vec<Change>), Failure> {
    let file = directory.join("experiment.toml");
    let experiment = experiment::read(&file, Profile::Quick, methods).map_err(Failure::input)?;
    let path = directory.join("cells.jsonl");
    let lines::Contents { lines: baseline, problems, notes } = lines::read(&path)?;
    let baseline: Vec<Cell> = baseline.into_iter().map(|line| line.cell).collect();
    notes.iter().for_each(say);
    if let Some(problem) = problems.first().filter(|_| !arguments.bless) {
        return Err(Failure::input(format!("{problem}: restore it, or bless with --bless")));
    }
    if baseline.is_empty() && !arguments.bless {
        let place = path.display();
        return Err(Failure::input(format!("{place}: no baseline: make one with --bless")));
    }
    let unit = match arguments.times {
        true => Some(unit_of_times(&experiment, directory, &baseline)?),
        false => None,
    };
    // References too are made afresh: those of a cache are from before the change.
    let fresh = tempfile::tempdir().map_err(Failure::input)?;
    let cells = measure(&experiment, &baseline, [fresh.path(), directory], arguments)?;
    if arguments.bless {
        let lines: String = cells.iter().map(lines::line).collect();
        output::write(&path, lines.as_bytes())?;
        keep_pictures(&cells, [fresh.path(), directory])?;
        say(format_args!("{}: {} cells are the new baseline", path.display(), cells.len()));
        return Ok((Vec::new(), Vec::new()));
    }
    let mut moved = regression::compare(&baseline, &cells);
    match unit {
        Some(unit) => moved.extend(times::compare(&baseline, &cells, &unit)),
        None => report_times(&baseline, &cells),
    }
    let foreign = baseline.iter().find(|old| {
        let alike = |new: &&Cell| new.inputs.label() == old.inputs.label();
        let same = |new: &Cell| regression::same_digits(&old.provenance, &new.provenance);
        !cells.iter().find(alike).is_some_and(same)
    });
    if let Some(cell) = foreign {
        say(format_args!(
            "pictures: the baseline is of {}, another processor or driver: only counts and errors \
             are compared",
            cell.provenance.cpu
        ));
    }
    if moved.is_empty() {
        say(format_args!("{}: nothing moved: {} cells", directory.display(), cells.len()));
    }
    let changes = match arguments.page {
        Some(_) => changes_of(&moved, [&baseline, &cells], [directory, fresh.path()])?,
        None => Vec::new(),
    };
    Ok((moved, changes))
}

/// The picture of a cell beside the lines of a baseline.
fn kept_picture(directory: &Path, cell: &Cell) -> PathBuf {
    let name = format!("{}-{}.exr", cell.inputs.view(), &cell.key[..16]);
    directory.join("pictures").join(name)
}

/// Puts the pictures of each variant's first seed into the baseline's folder, in the place of those before.
fn keep_pictures(cells: &[Cell], [fresh, directory]: [&Path; 2]) -> Result<(), Failure> {
    let folder = directory.join("pictures");
    let at = |error: std::io::Error| Failure::input(format!("{}: {error}", folder.display()));
    std::fs::create_dir_all(&folder).map_err(at)?;
    for entry in folder.read_dir().map_err(at)? {
        let path = entry.map_err(at)?.path();
        if path.extension().is_some_and(|extension| extension == "exr") {
            std::fs::remove_file(&path).map_err(at)?;
        }
    }
    for cell in regression::pictured(cells).values() {
        let image = image_path(fresh, &cell.inputs.view(), &cell.key).with_extension("exr");
        let image = RadianceImage::read_exr(&image).map_err(Failure::input)?;
        image.write_exr(&kept_picture(directory, cell), &[]).map_err(Failure::input)?;
    }
    Ok(())
}

/// The pictures of what moved, where there are some.
fn changes_of(
    moved: &[Moved],
    [before, now]: [&[Cell]; 2],
    [directory, fresh]: [&Path; 2],
) -> Result<Vec<Change>, Failure> {
    let [before, now] = [before, now].map(regression::pictured);
    let read = |path: PathBuf| match path.exists() {
        true => RadianceImage::read_exr(&path).map(Some).map_err(Failure::input),
        false => Ok(None),
    };
    let mut names: Vec<&String> = moved.iter().map(|moved| &moved.cell).collect();
    names.dedup();
    let change = |name: &String| {
        let [old, new] = [before.get(name), now.get(name)];
        let image = |cell: &Cell| image_path(fresh, &cell.inputs.view(), &cell.key);
        let cell = new.or(old)?;
        let paths = [
            old.map(|cell| kept_picture(directory, cell)),
            new.map(|cell| image(cell).with_extension("exr")),
        ];
        Some((name.clone(), cell.inputs.exposure, paths))
    };
    let changes = names.into_iter().filter_map(change).map(|(cell, exposure, paths)| {
        let [before, now] = paths.map(|path| path.map_or(Ok(None), read));
        Ok(Change { cell, exposure, before: before?, now: now? })
    });
    changes.collect()
}

fn measure(
    experiment: &Experiment,
    baseline: &[Cell],
    [out, directory]: [&Path; 2],
    arguments: &CheckArguments,
) -> Result<Vec<Cell>, Failure> {
    let machine = &arguments.machine;
    let scenes = run::load(experiment, machine.assets.as_deref())?;
    if arguments.bless {
        let sources = scenes.iter().flat_map(|scene| &scene.sources).map(PathBuf::as_path);
        output::keep_inputs([directory.join("cells.jsonl")], sources, "--baseline")?;
    }
    let cache = out.join("references");
    output::check_directory(&cache, "TMPDIR")?;
    let mut session = Session::open(experiment, out, &cache, machine.adapter.as_deref())?;
    session.replayed = baseline.to_vec();
    let variants: Vec<usize> = (0..experiment.variants.len()).collect();
    scenes.iter().try_for_each(|scene| session.check_references(scene))?;
    let mut cells = Vec::new();
    for scene in &scenes {
        for camera in 0..experiment.cameras().len() {
            let measured = session.scene(scene, camera, &variants)?;
            cells.extend(measured.cells.into_iter().map(|(_, cell)| cell));
        }
    }
    Ok(cells)
}

fn print_table(moved: &[Moved]) {
    let head = ["cell", "quantity", "baseline", "now", "why it counts"].map(str::to_owned);
    let rows: Vec<[String; 5]> = std::iter::once(head)
        .chain(moved.iter().cloned().map(|m| [m.cell, m.quantity, m.before, m.now, m.why]))
        .collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let widths: Vec<usize> = (0..5).map(|column| width(column).unwrap_or(0)).collect();
    for row in &rows {
        let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}"));
        say(cells.collect::<Vec<_>>().join("  ").trim_end());
    }
}

/// The label of the variant whose time is the unit of all others, where the baseline has what times are
/// compared with.
fn unit_of_times(
    experiment: &Experiment,
    directory: &Path,
    baseline: &[Cell],
) -> Result<String, Failure> {
    let refused =
        |reason: String| Failure::input(format!("{}: --times: {reason}", directory.display()));
    let here = Provenance::here(None).machine;
    if baseline.iter().any(|cell| cell.provenance.machine != here) {
        return Err(refused("the baseline is another machine's: bless it on this one".to_owned()));
    }
    let unit = &experiment.variants[experiment.baseline];
    let seen = Seen { scene: "", camera: None, content: "", exposure: 1.0 };
    let label = Inputs::new(experiment, unit, seen).label();
    times::check_baseline(baseline, &label).map_err(refused)?;
    Ok(label)
}

/// For information alone: times decide nothing.
fn report_times(before: &[Cell], now: &[Cell]) {
    let same = before.iter().zip(now).all(|(a, b)| a.provenance.machine == b.provenance.machine);
    if !same {
        say("times: the baseline is another machine's, so they are not compared");
        return;
    }
    let pairs = before.iter().filter_map(|old| {
        let alike = |new: &&Cell| {
            let labels = new.inputs.label() == old.inputs.label();
            let (a, b) = (&new.inputs, &old.inputs);
            labels && (a.view(), a.seed, a.repetition) == (b.view(), b.seed, b.repetition)
        };
        Some(seconds(now.iter().find(alike)?)? / seconds(old)?)
    });
    if let Some(ratio) = median(pairs) {
        say(format_args!(
            "times: {ratio:.2} times the baseline's (median; for information, decides nothing)"
        ));
    }
}
