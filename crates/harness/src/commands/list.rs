//! `manylights list`.

use std::path::{Path, PathBuf};

use manylights_method::{ChoiceWord, CounterInfo, Method, ParameterInfo, ParameterKind, Processor};
use manylights_scene::SceneKind;
use serde_json::{Value, json};

use crate::error::Failure;
use crate::output::{print_json, say};
use crate::question::experiment;
use crate::registry::Methods;
use clap::Args;

/// What `list` shows.
#[derive(Clone, Copy, clap::ValueEnum)]
pub(crate) enum Listed {
    Methods,
    Scenes,
    Experiments,
}

#[derive(Args)]
pub(crate) struct ListArguments {
    /// What to list
    pub(crate) what: Listed,
    /// As JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
}

/// Where `list experiments` looks.
const RESULTS: &str = "results";

/// Lists methods, scenes or experiments.
///
/// # Errors
/// One line where an experiment file is malformed.
pub(crate) fn run(arguments: &ListArguments, methods: Methods) -> Result<(), Failure> {
    let entries = match arguments.what {
        Listed::Methods => methods.iter().map(|method| method_entry(*method)).collect(),
        Listed::Scenes => scenes(),
        Listed::Experiments => experiments()?,
    };
    if arguments.json {
        return print_json(&Value::Array(entries.into_iter().map(|entry| entry.json).collect()));
    }
    for entry in entries {
        say(entry.text);
    }
    Ok(())
}

struct Listing {
    text: String,
    json: Value,
}

fn method_entry(method: &dyn Method) -> Listing {
    let processor = match method.processor() {
        Processor::Cpu => "cpu",
        Processor::Gpu => "gpu",
    };
    let mut text = format!("{} ({processor}): {}", method.id(), method.title());
    for info in method.parameters() {
        text.push_str(&parameter_text(info));
    }
    let cost = method.cost().map(|cost| cost.parameter);
    if cost.is_none() {
        text.push_str(
            "\n  no parameter sets the amount of work: under any time budget it runs once",
        );
    }
    let json = json!({
        "id": method.id(),
        "title": method.title(),
        "processor": processor,
        "cost": cost,
        "parameters": method.parameters().iter().map(parameter_json).collect::<Vec<_>>(),
        "counters": method.counters().iter().map(counter_json).collect::<Vec<_>>(),
        "bake_counters": method.baking().map(|baking| {
            baking.counters().iter().map(counter_json).collect::<Vec<_>>()
        }),
    });
    Listing { text, json }
}

fn parameter_text(info: &ParameterInfo) -> String {
    let ParameterInfo { name, help, .. } = info;
    match info.kind {
        ParameterKind::Count { default, min, max } => format!(
            "\n  --set {name}=N  {help} (a whole number from {min} to {max}, default {default})"
        ),
        ParameterKind::Real { default, min, max } => {
            format!("\n  --set {name}=N  {help} (a number from {min} to {max}, default {default})")
        }
        ParameterKind::Choice { default, words } => {
            let line = |known: &ChoiceWord| format!("\n      {}: {}", known.word, known.help);
            let lines: String = words.iter().map(line).collect();
            format!("\n  --set {name}=WORD  {help} (default {default}){lines}")
        }
    }
}

fn parameter_json(info: &ParameterInfo) -> Value {
    let ParameterInfo { name, help, .. } = info;
    match info.kind {
        ParameterKind::Count { default, min, max } => json!({
            "name": name, "help": help, "kind": "count", "default": default, "min": min, "max": max,
        }),
        ParameterKind::Real { default, min, max } => json!({
            "name": name, "help": help, "kind": "real", "default": default, "min": min, "max": max,
        }),
        ParameterKind::Choice { default, words } => {
            let word = |known: &ChoiceWord| json!({ "word": known.word, "help": known.help });
            let words: Vec<_> = words.iter().map(word).collect();
            json!({
                "name": name, "help": help, "kind": "choice", "default": default, "words": words,
            })
        }
    }
}

fn counter_json(info: &CounterInfo) -> Value {
    json!({ "name": info.name, "help": info.help })
}

fn scenes() -> Vec<Listing> {
    manylights_scene::list()
        .into_iter()
        .map(|scene| {
            let kind = match scene.kind {
                SceneKind::Builtin => "built-in",
                SceneKind::File => "file",
            };
            Listing {
                text: format!("{} ({kind}): {}", scene.name, scene.about),
                json: json!({ "name": scene.name, "kind": kind, "about": scene.about }),
            }
        })
        .collect()
}

fn experiments() -> Result<Vec<Listing>, Failure> {
    let mut files: Vec<PathBuf> = Path::new(RESULTS)
        .read_dir()
        .into_iter()
        .flatten()
        .flatten()
        .map(|folder| folder.path().join("experiment.toml"))
        .filter(|file| file.is_file())
        .collect();
    files.sort();
    files.iter().map(|file| experiment_entry(file)).collect()
}

fn experiment_entry(file: &Path) -> Result<Listing, Failure> {
    let name = file.display().to_string();
    let (title, scenes) =
        experiment::summary(file).map_err(|reason| Failure::input(format!("{name}: {reason}")))?;
    Ok(Listing {
        text: format!("{name}: {title} ({})", scenes.join(", ")),
        json: json!({ "file": name, "title": title, "scenes": scenes }),
    })
}
