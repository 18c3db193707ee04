//! `table.md` and `table.csv`.

use std::fmt::Write as _;

use manylights_metrics::METRICS;

use crate::answer::{Medians, Rank, Row, RowResult, SceneAnswer, values};
use crate::experiment::Experiment;
use crate::numbers::{milliseconds, short};
use crate::provenance::Provenance;

/// The table for people.
pub(crate) fn markdown(
    experiment: &Experiment,
    scenes: &[SceneAnswer],
    machine: &Provenance,
) -> String {
    let mut text = head(experiment, machine);
    for scene in scenes {
        let _ = write!(text, "\n## {}\n", scene.scene);
        for reference in &experiment.references {
            scene_table(&mut text, experiment, scene, &reference.to_string());
        }
    }
    text.push_str(&foot(experiment));
    text
}

fn head(experiment: &Experiment, machine: &Provenance) -> String {
    let scale = &experiment.scale;
    let [width, height] = scale.resolution;
    let adapter = machine.adapter.as_ref().map_or_else(String::new, |adapter| {
        let field = |name: &str| adapter[name].as_str().unwrap_or_default().to_owned();
        format!("; adapter {} ({} {})", field("name"), field("driver"), field("driver_info"))
    });
    format!(
        "# {}\n\n{}\n\nProfile {}: {width}×{height} pixels, transport {}, {} timed runs for each of \
         {} seed(s), references of {} samples a pixel.\n{}; {}, {} threads, {}{adapter}.\n",
        experiment.title,
        experiment.question,
        experiment.profile,
        experiment.transport,
        scale.repetitions,
        scale.seeds.len(),
        scale.reference_samples,
        machine.program_name(),
        machine.cpu,
        machine.threads,
        machine.system,
    )
}

fn scene_table(text: &mut String, experiment: &Experiment, scene: &SceneAnswer, reference: &str) {
    let _ = write!(
        text,
        "\nAgainst the reference with visibility *{reference}*:\n\n\
         | rank | method | counts | time ms | quartiles | ÷ base | RMSE | ÷ base | PSNR dB | SSIM | RMSE linear |\n\
         |---:|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n"
    );
    let base = scene.rows[experiment.baseline].medians();
    for (row, rank) in scene.rows.iter().zip(scene.ranks(reference)) {
        let label = experiment.variants[row.variant].label();
        let _ = match &row.result {
            RowResult::Done(medians) => {
                writeln!(text, "{}", numbers(&label, rank, medians, base, reference))
            }
            RowResult::Declined(reason) => {
                writeln!(text, "| | {label} | declined: {} {}", cell(reason), "| ".repeat(9))
            }
            RowResult::Failed(reason) => {
                writeln!(text, "| | {label} | **failed**: {} {}", cell(reason), "| ".repeat(9))
            }
        };
    }
    if let Some((linear, display)) = scene.floor(reference) {
        let _ = writeln!(
            text,
            "| | *noise floor of the reference* | | | | | {} | | | | {} |",
            short(display),
            short(linear)
        );
    }
}

fn numbers(
    label: &str,
    rank: Option<Rank>,
    medians: &Medians,
    base: Option<&Medians>,
    reference: &str,
) -> String {
    let errors = &medians.errors[reference];
    let rank = rank.map_or_else(String::new, |rank| {
        format!("{}{}", rank.place, if rank.shared { "=" } else { "" })
    });
    let seconds = medians.seconds;
    let counts: Vec<_> = medians.counters.iter().map(|(name, n)| format!("{n} {name}")).collect();
    let ratio = |value: f64, of: &dyn Fn(&Medians) -> f64| {
        base.map_or_else(String::new, |base| short(value / of(base)))
    };
    format!(
        "| {rank} | {label} | {} | {} | {}–{} | {} | {} | {} | {:.2} | {:.4} | {} |",
        counts.join(", "),
        milliseconds(seconds.median),
        milliseconds(seconds.lower),
        milliseconds(seconds.upper),
        ratio(seconds.median, &|base| base.seconds.median),
        short(errors.display.rmse),
        ratio(errors.display.rmse, &|base| base.errors[reference].display.rmse),
        errors.display.psnr,
        errors.display.ssim,
        short(errors.linear.rmse),
    )
}

/// A reason must not break the table.
fn cell(reason: &str) -> String {
    reason.replace('|', "\\|")
}

fn foot(experiment: &Experiment) -> String {
    format!(
        "\nTime: wall clock of the work (median and quartiles), warmed up, without preparation, \
         read-back, metrics and files. Base: `{}`. RMSE, PSNR and SSIM are of sRGB values at the \
         scene's exposure, RMSE linear of radiance in W·m⁻²·sr⁻¹. Ranks are by RMSE; rows that are \
         closer than the noise floor share a rank (=). All metrics are in `table.csv`.\n",
        experiment.variants[experiment.baseline].label()
    )
}

/// The table for programs: one line for each scene, variant and reference.
pub(crate) fn csv(experiment: &Experiment, scenes: &[SceneAnswer]) -> String {
    let mut text = String::from(
        "scene,method,parameters,reference,outcome,rank,rank_shared,seconds,seconds_lower,\
         seconds_upper,prepare_seconds,linear_floor,display_floor",
    );
    for space in ["linear", "display"] {
        for metric in METRICS {
            let _ = write!(text, ",{space}_{}", metric.id);
        }
    }
    text.push('\n');
    for scene in scenes {
        for reference in &experiment.references {
            let reference = reference.to_string();
            for (row, rank) in scene.rows.iter().zip(scene.ranks(&reference)) {
                text.push_str(&csv_line(experiment, &scene.scene, row, rank, &reference));
                text.push('\n');
            }
        }
    }
    text
}

fn csv_line(
    experiment: &Experiment,
    scene: &str,
    row: &Row,
    rank: Option<Rank>,
    reference: &str,
) -> String {
    let variant = &experiment.variants[row.variant];
    let mut fields = vec![
        quoted(scene),
        variant.method.id().to_owned(),
        quoted(&variant.parameters.to_string()),
        reference.to_owned(),
    ];
    match &row.result {
        RowResult::Done(medians) => {
            let comparison = &medians.errors[reference];
            let rank = rank.expect("rows with pictures are ranked");
            fields.extend(["done".into(), rank.place.to_string(), rank.shared.to_string()]);
            let seconds = medians.seconds;
            let numbers = [
                seconds.median,
                seconds.lower,
                seconds.upper,
                medians.prepare_seconds,
                comparison.linear_floor,
                comparison.display_floor,
            ];
            let metrics = values(&comparison.linear).chain(values(&comparison.display));
            fields
                .extend(numbers.into_iter().chain(metrics.map(|(_, v)| v)).map(|v| v.to_string()));
        }
        RowResult::Declined(reason) => fields.push(quoted(&format!("declined: {reason}"))),
        RowResult::Failed(reason) => fields.push(quoted(&format!("failed: {reason}"))),
    }
    fields.resize(13 + 2 * METRICS.len(), String::new());
    fields.join(",")
}

/// RFC 4180.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
