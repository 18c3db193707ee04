//! `manylights render`.

use std::path::{Path, PathBuf};

use crate::commands::machine::Machine;
use crate::error::Failure;
use crate::measurement::bakes;
use crate::measurement::measure::{self, MeasuredRun};
use crate::measurement::provenance::Provenance;
use crate::measurement::stage::{self, Stage};
use crate::output::{self, say};
use crate::progress::ProgressBar;
use crate::question::plan::no_choice;
use crate::question::settings;
use crate::registry::{self, Methods};
use clap::Args;
use manylights_scene::{Transport, Visibility};

#[derive(Args)]
pub(crate) struct RenderArguments {
    /// Built-in scene, scenes/NAME.toml, or a .toml, .glb or .gltf file
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) scene: String,
    /// Method (see `list methods`)
    #[arg(long, value_name = "ID")]
    pub(crate) method: String,
    /// Sets a parameter of the method
    #[arg(long, value_name = "KEY=VALUE", value_parser = settings::split)]
    pub(crate) set: Vec<(String, String)>,
    /// Light paths: direct, indirect-1 (or another number of bounces), direct+indirect-1 (the direct
    /// light of point-like lights is exact and the same for all methods), all
    #[arg(long, default_value = "indirect-1", value_name = "PATHS")]
    pub(crate) transport: Transport,
    /// Of the last segment of direct, indirect-1, direct+indirect-1: traced, ignored [default: what the
    /// method computes]
    #[arg(long, value_name = "VISIBILITY")]
    pub(crate) visibility: Option<Visibility>,
    /// Size of the picture
    #[arg(long, default_value = "512x512", value_name = "WxH", value_parser = settings::resolution)]
    pub(crate) resolution: [u32; 2],
    /// Camera of the scene [default: its first]
    #[arg(long, value_name = "NAME")]
    pub(crate) camera: Option<String>,
    /// Same seed, same picture
    #[arg(long, default_value_t = 1, value_name = "N", allow_negative_numbers = true)]
    pub(crate) seed: u64,
    /// Radiance; a PNG at the scene's exposure is written beside it
    #[arg(short, long, value_name = "OUT.exr")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) machine: Machine,
}

/// Renders one picture to an EXR and a PNG.
///
/// # Errors
/// One line: bad input before anything is rendered; a failed device or pixels that are not finite
/// after the picture is written.
pub(crate) fn run(arguments: &RenderArguments, methods: Methods) -> Result<(), Failure> {
    let place = registry::place(methods, &arguments.method).map_err(Failure::input)?;
    let method = methods[place];
    let pairs = arguments.set.iter().map(|(key, value)| (key.as_str(), value.as_str()));
    let parameters = settings::parameters(method, pairs).map_err(Failure::input)?;
    let transport = arguments.transport;
    if arguments.visibility == Some(Visibility::Ignored) && transport.visibility().is_none() {
        return Err(Failure::input(format!("--visibility ignored: {}", no_choice(transport))));
    }
    let visibility = arguments.visibility.unwrap_or(method.visibility());
    let (exr, png) = output::check_image(&arguments.output)?;
    let scene = stage::load(&arguments.scene, arguments.machine.assets.as_deref())?;
    let inputs = scene.sources.iter().map(PathBuf::as_path);
    output::keep_inputs([exr.clone(), png.clone()], inputs, "-o")?;
    let gpu = stage::open_gpu([method], arguments.machine.adapter.as_deref())?;
    let camera = arguments.camera.as_deref();
    let stage = Stage::new(&scene, camera, transport, arguments.resolution, gpu.as_ref())?;
    let frame = stage.frame(visibility, arguments.seed);
    let mut progress = ProgressBar::new(&format!("{} {}", scene.name, method.id()));
    let baking = method.baking();
    let bake = baking.map(|baking| bakes::once(baking, &frame, &parameters)).transpose()?;
    let mut measured = measure::measure(
        method,
        &frame,
        &parameters,
        bake.as_ref().map(|(bake, cost)| (bake.as_ref(), cost.clone())),
        &mut |at, _, _| {
            progress.set(at.done, at.total);
            Ok(())
        },
    )?;
    drop(progress);
    measured.image = stage.completed(measured.image);
    let mut facts = vec![
        ("scene".to_owned(), scene.name.clone()),
        ("camera".to_owned(), stage.camera.name.clone()),
        ("method".to_owned(), method.id().to_owned()),
        ("parameters".to_owned(), parameters.to_string()),
        ("transport".to_owned(), transport.to_string()),
        ("seed".to_owned(), arguments.seed.to_string()),
        ("exposure".to_owned(), scene.exposure.to_string()),
    ];
    if transport.visibility().is_some() {
        facts.push(("visibility".to_owned(), visibility.to_string()));
    }
    facts.extend(attributes(&Provenance::here(gpu.as_ref())));
    write(&measured, &facts, &exr, &png, scene.exposure)?;
    check_finite(&measured, &exr)?;
    report(&measured, &exr, &png);
    Ok(())
}

fn attributes(provenance: &Provenance) -> Vec<(String, String)> {
    let adapter = provenance.adapter.as_ref().map(ToString::to_string);
    let pairs = [
        ("program", Some(provenance.program_name())),
        ("system", Some(provenance.system.clone())),
        ("cpu", Some(provenance.cpu.clone())),
        ("adapter", adapter),
    ];
    pairs.into_iter().filter_map(|(name, text)| Some((name.to_owned(), text?))).collect()
}

fn write(
    measured: &MeasuredRun,
    facts: &[(String, String)],
    exr: &Path,
    png: &Path,
    exposure: f32,
) -> Result<(), Failure> {
    // OpenEXR has names of its own: ours carry a prefix.
    let facts: Vec<_> =
        facts.iter().map(|(name, text)| (format!("manylights.{name}"), text.clone())).collect();
    measured.image.write_exr(exr, &facts).map_err(Failure::input)?;
    measured.image.write_png(png, exposure).map_err(Failure::input)
}

fn report(measured: &MeasuredRun, exr: &Path, png: &Path) {
    let counters: Vec<_> =
        measured.counters.iter().map(|(name, n)| format!("{name} {n}")).collect();
    let bake = match measured.bake.seconds {
        0.0 => String::new(),
        seconds => format!("baked in {seconds:.3} s, "),
    };
    say(format_args!(
        "{} and {}: {bake}prepared in {:.3} s, rendered in {:.3} s; {}",
        exr.display(),
        png.display(),
        measured.prepare_seconds,
        measured.step_seconds,
        counters.join(", ")
    ));
}

fn check_finite(measured: &MeasuredRun, exr: &Path) -> Result<(), Failure> {
    match measured.image.non_finite() {
        0 => Ok(()),
        count => Err(Failure::Failed(format!(
            "{}: {count} pixels are not finite (magenta in the PNG)",
            exr.display()
        ))),
    }
}
