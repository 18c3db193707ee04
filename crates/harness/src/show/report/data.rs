//! The numbers of the page, as its scripts and other programs read them.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::Report;
use super::pictures::{Picture, Pictures};
use crate::answer::ranks::Rank;
use crate::answer::rows::{Medians, RowResult, SceneAnswer};
use crate::measurement::cell::Cell;
use crate::measurement::provenance::Provenance;
use crate::measurement::scene_cells::SceneCells;
use crate::question::crops;
use crate::question::experiment::Experiment;
use crate::question::references::Reference;
use crate::show::style::method_style;

/// All numbers; `pictures` has one entry a scene. Medians of every row, then every cell.
pub(super) fn data(report: &Report<'_>, pictures: &[Pictures<'_>], csv: String) -> Value {
    let Report { experiment, cells, answers, machine, .. } = report;
    let scale = &experiment.scale;
    let scenes = cells.iter().zip(*answers).zip(pictures);
    json!({
        "title": experiment.title,
        "question": experiment.question,
        "profile": experiment.profile,
        "transport": experiment.transport.to_string(),
        "resolution": scale.resolution,
        "seeds": scale.seeds,
        "repetitions": scale.repetitions,
        "reference_samples": scale.reference_samples,
        "references": experiment.references.iter().map(|r| &r.name).collect::<Vec<_>>(),
        "variants": experiment.variants.iter().map(|variant| json!({
            "label": variant.label(),
            "method": variant.method.id(),
            "title": variant.method.title(),
            "color": color(variant.place),
        })).collect::<Vec<_>>(),
        "baseline": experiment.baseline,
        "machine": machine,
        "command": report.command,
        "scenes": scenes
            .map(|((cells, answer), pictures)| scene(experiment, cells, answer, pictures))
            .collect::<Vec<_>>(),
        "cells": cells.iter().flat_map(|scene| &scene.cells).map(|(_, cell)| whole(cell, machine))
            .collect::<Vec<_>>(),
        "csv": csv,
    })
}

fn scene(
    experiment: &Experiment,
    cells: &SceneCells,
    answer: &SceneAnswer,
    pictures: &Pictures<'_>,
) -> Value {
    let names: Vec<String> = cells.references.iter().map(|r| r.name.clone()).collect();
    let crops = experiment.crops.iter().filter(|crop| crop.scene == cells.scene);
    let crops = crops.enumerate().map(|(nth, crop)| {
        let [r, g, b] = crops::frame(nth);
        json!({
            "rectangle": crop.pixels(pictures.resolution()),
            "color": format!("#{r:02x}{g:02x}{b:02x}"),
        })
    });
    let ranks: BTreeMap<_, _> =
        names.iter().map(|name| (name.as_str(), answer.ranks(experiment, name))).collect();
    let rows = (0..answer.rows.len()).map(|index| row(answer, index, &ranks));
    let floor = |reference: &Reference| {
        let (linear, display) = answer.floor(&reference.name)?;
        Some((reference.name.clone(), json!({ "linear": linear, "display": display })))
    };
    json!({
        "name": cells.scene,
        "exposure": cells.exposure,
        "resolution": pictures.resolution(),
        "factor": pictures.factor,
        "error_scale": pictures.error_scale,
        "left_out": pictures.left_out,
        "references": experiment.references.iter()
            .map(|reference| answer.description(experiment, reference)).collect::<Vec<_>>(),
        "floors": experiment.references.iter().filter(|reference| reference.is_path_traced())
            .filter_map(floor).collect::<serde_json::Map<_, _>>(),
        "crops": crops.collect::<Vec<_>>(),
        "pictures": pictures.list.iter().map(picture).collect::<Vec<_>>(),
        "rows": rows.collect::<Vec<_>>(),
    })
}

fn picture(picture: &Picture<'_>) -> Value {
    match picture {
        Picture::Reference(reference) => json!({
            "reference": reference.name,
            "made": reference.caption,
        }),
        Picture::Row(row, _) => json!({ "row": row }),
    }
}

/// Ranks of all rows by name of the reference.
type Ranks<'a> = BTreeMap<&'a str, Vec<Option<Rank>>>;

fn row(answer: &SceneAnswer, index: usize, ranks: &Ranks<'_>) -> Value {
    let row = &answer.rows[index];
    match &row.result {
        RowResult::Done(medians) => done(answer, index, medians, ranks),
        RowResult::Declined(reason) => {
            json!({ "variant": row.variant, "machine": row.machine, "outcome": "declined", "reason": reason })
        }
        RowResult::Failed(reason) => {
            json!({ "variant": row.variant, "machine": row.machine, "outcome": "failed", "reason": reason })
        }
    }
}

fn done(answer: &SceneAnswer, index: usize, medians: &Medians, ranks: &Ranks<'_>) -> Value {
    let row = &answer.rows[index];
    let against = |(&name, ranks): (&&str, &Vec<Option<Rank>>)| {
        let errors = medians.errors.get(name)?;
        let rank = ranks[index];
        let sample = &medians.samples[name];
        let split = medians.split.get(name);
        let excess = answer.excess(row, name);
        let value = json!({
            "rank_best": rank.map(|rank| rank.best),
            "rank_worst": rank.map(|rank| rank.worst),
            "differs_from_baseline": excess.is_some_and(|excess| !excess.holds_zero()),
            "error": sample.mean_squared().sqrt(),
            "error_interval": sample.interval(),
            "linear": errors.linear,
            "display": errors.display,
            "bias": split.map(|split| split.squared_bias.roots()[0]),
            "deviation": split.map(|split| split.variance.roots()[0]),
            "seed_rmse": sample.seeds.iter().map(|seed| seed.squared.sqrt()).collect::<Vec<_>>(),
        });
        Some((name.to_owned(), value))
    };
    let seconds = medians.seconds;
    json!({
        "variant": row.variant,
        "machine": row.machine,
        "outcome": "done",
        "cell": medians.key,
        "amount": medians.amount,
        "counters": medians.counters,
        "runs": medians.runs,
        "seconds": seconds.median,
        "seconds_lower": seconds.lower,
        "seconds_upper": seconds.upper,
        "bake_seconds": medians.bake_seconds,
        "bake_counters": medians.bake_counters,
        "prepare_seconds": medians.prepare_seconds,
        "errors": ranks.iter().filter_map(against).collect::<serde_json::Map<_, _>>(),
    })
}

/// A cell, without the provenance that it shares with all others of the report.
fn whole(cell: &Cell, machine: &Provenance) -> Value {
    let mut value = serde_json::to_value(cell).expect("a cell is plain data");
    let on_host = Provenance { adapter: None, ..machine.clone() };
    if let (Some(object), true) =
        (value.as_object_mut(), cell.provenance == *machine || cell.provenance == on_host)
    {
        object.remove("provenance");
    }
    value
}

fn color(place: usize) -> String {
    let (color, _) = method_style(place);
    format!("#{:02x}{:02x}{:02x}", color.0, color.1, color.2)
}
