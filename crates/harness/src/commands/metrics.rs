//! `manylights metrics`.

use manylights_metrics::{METRICS, compare_display, compare_linear, read_exr_pair};
use serde_json::json;

use crate::error::Failure;
use crate::output::{print_json, say};
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct MetricsArguments {
    /// Picture to judge
    pub(crate) image: PathBuf,
    /// What it should be
    pub(crate) reference: PathBuf,
    /// Exposure of the display-referred errors
    #[arg(long, default_value_t = 1.0, value_name = "FACTOR")]
    pub(crate) exposure: f32,
    /// As JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
}

/// Prints the errors of one picture against another.
///
/// # Errors
/// One line where a file cannot be read, sizes or windows differ or pixels are not finite.
pub(crate) fn run(arguments: &MetricsArguments) -> Result<(), Failure> {
    let [image, reference] =
        read_exr_pair(&arguments.image, &arguments.reference).map_err(Failure::input)?;
    let linear = compare_linear(&image, &reference).map_err(Failure::input)?;
    let exposure = arguments.exposure;
    let display = compare_display(&image, &reference, exposure).map_err(Failure::input)?;
    if arguments.json {
        let report = json!({ "linear": linear, "display": display, "exposure": exposure });
        return print_json(&report);
    }
    say(format_args!("{:<15} {:>12} {:>12}  formula", "metric", "linear", "display"));
    for metric in METRICS {
        let [linear, display] = [&linear, &display].map(|errors| match (metric.value)(errors) {
            Some(value) => format!("{value:.6}"),
            None => "—".to_owned(),
        });
        say(format_args!("{:<15} {linear:>12} {display:>12}  {}", metric.id, metric.formula));
    }
    say(format_args!(
        "linear: radiance in W m^-2 sr^-1; display: sRGB values in [0, 1] at exposure {exposure}"
    ));
    Ok(())
}
