//! Versions move with what they stand for: results of one version are taken for those of every program
//! that has it.
//!
//! `versions.json` holds a small picture, or some numbers, of every method and shared stage, with the
//! versions that they depend on. Where one moved and none of its versions did, this fails. On the
//! processor and driver that it was recorded on every bit counts; elsewhere means are compared.
//!
//! `MANYLIGHTS_BLESS=1` records anew, and refuses what moved under the same versions.

use std::collections::BTreeMap;
use std::path::PathBuf;

use bytemuck::cast_slice;
use glam::Vec3;
use manylights_area_lights::AREA_LIGHTS_VERSION;
use manylights_gpu::{SHADERS_VERSION, Shadows};
use manylights_harness::registry::METHODS;
use manylights_method::{Error, Method, Processor};
use manylights_metrics::{
    METRICS, METRICS_VERSION, MetricInfo, RadianceImage, compare_display, compare_linear,
};
use manylights_path_tracer::{REFERENCE_VERSION, Settings};
use manylights_reflectance::lobes::LobeTable;
use manylights_reflectance::zonal::ZonalTable;
use manylights_reflectance::{Damping, TABLES_VERSION, diffuse};
use manylights_scene::{Lobe, Scene, Transport};
use manylights_tests::{GPU, Stage, under_spheres, under_triangles};
use manylights_virtual_lights::{
    PLACEMENT_VERSION, RadiusRule, distribute, lit_maps, radii, scene_maps,
};
use serde_json::{Value, json};

const RESOLUTION: [u32; 2] = [24, 16];
const SCENES: [&str; 2] = ["cornell-glossy", "trio"];
/// Means of so many runs of numbers, for each of three interleaved channels.
const RUNS: usize = 16;
/// Beyond what other processors and drivers round differently.
const TOLERANCE: f64 = 1e-3;

/// Versions by name.
type Versions = BTreeMap<&'static str, u32>;

/// What is recorded of a method or stage.
struct Sketch {
    versions: Versions,
    /// Hash of all bits.
    hash: String,
    means: Vec<f64>,
}

impl Sketch {
    fn new<const N: usize>(versions: [(&'static str, u32); N], numbers: &[f64]) -> Self {
        assert!(numbers.iter().all(|number| number.is_finite()), "{versions:?}");
        // FNV-1a, http://www.isthe.com/chongo/tech/comp/fnv: nobody means to collide.
        let bytes = numbers.iter().flat_map(|number| number.to_le_bytes());
        let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        let run = numbers.len().div_ceil(RUNS).next_multiple_of(3);
        let mean = |run: &[f64], channel: usize| {
            let values = run.iter().skip(channel).step_by(3);
            values.clone().sum::<f64>() / values.len().max(1) as f64
        };
        let means = numbers.chunks(run).flat_map(|run| [0, 1, 2].map(|k| mean(run, k))).collect();
        Self { versions: versions.into(), hash: format!("{hash:016x}"), means }
    }

    fn json(&self, place: &str) -> Value {
        // Six digits, as the tolerance leaves three of them.
        let rounded = |mean: &f64| format!("{mean:.5e}").parse::<f64>().expect("a number");
        let means: Vec<f64> = self.means.iter().map(rounded).collect();
        json!({ "versions": self.versions, "hash": { place: self.hash }, "means": means })
    }

    /// What of it differs from what was recorded.
    fn moved(&self, recorded: &Value, place: &str) -> Option<String> {
        if let Some(hash) = recorded["hash"][place].as_str() {
            return (hash != self.hash).then(|| "other bits".to_owned());
        }
        let means: Vec<f64> =
            recorded["means"].as_array()?.iter().filter_map(Value::as_f64).collect();
        if means.len() != self.means.len() {
            return Some(format!("{} means for {}", self.means.len(), means.len()));
        }
        let peak = means.iter().fold(0.0, |peak: f64, mean| peak.max(mean.abs()));
        let differs = |(now, then): &(&f64, &f64)| {
            (*now - *then).abs() > TOLERANCE * then.abs().max(TOLERANCE * peak)
        };
        let (now, then) = self.means.iter().zip(&means).find(differs)?;
        Some(format!("{now} for {then}"))
    }
}

fn numbers(image: &RadianceImage) -> Vec<f64> {
    image.pixels.iter().flatten().map(|&value| value.into()).collect()
}

fn components(vectors: impl IntoIterator<Item = Vec3>) -> Vec<f64> {
    vectors.into_iter().flat_map(|vector| vector.to_array()).map(f64::from).collect()
}

/// At its default parameters, as its source shades, and from a grid where it has one: one indirect bounce of point-like lights, or else direct
/// light of those with a surface.
fn of_method(method: &dyn Method) -> Sketch {
    let visibility = method.visibility();
    let indirect = Transport::Indirect { bounces: 1, visibility };
    let scenes = SCENES.map(|scene| manylights_scene::load(scene, None).expect("built in"));
    let bounced: Option<Vec<_>> =
        scenes.map(|scene| picture(method, scene, indirect, &[])).into_iter().collect();
    let own = ("method", method.version());
    let [placement, shaders, tables] = shared();
    match (bounced, method.processor()) {
        (Some(numbers), Processor::Cpu) => Sketch::new([own], &numbers.concat()),
        (Some(numbers), Processor::Gpu) => {
            Sketch::new([own, placement, shaders, tables], &numbers.concat())
        }
        (None, _) => {
            let direct = Transport::Direct { visibility };
            let scenes = [under_spheres(5), under_triangles(5)];
            let has_grid = method.parameters().iter().any(|info| info.name == "interpolation");
            // So fine that not all lights are near it.
            let gridded: &[_] = &[("interpolation", "hermite"), ("grid", "24")];
            let settings = [Some(&[][..]), has_grid.then_some(gridded)];
            let pictures = scenes.iter().flat_map(|scene| {
                settings
                    .iter()
                    .flatten()
                    .filter_map(|settings| picture(method, scene.clone(), direct, settings))
            });
            let numbers: Vec<_> = pictures.collect();
            assert!(!numbers.is_empty(), "{} declines all", method.id());
            let numbers = numbers.concat();
            let area_lights = ("area_lights", AREA_LIGHTS_VERSION);
            Sketch::new([own, area_lights, shaders, tables], &numbers)
        }
    }
}

/// `None` where the method declines.
fn picture(
    method: &dyn Method,
    scene: Scene,
    transport: Transport,
    settings: &[(&'static str, &'static str)],
) -> Option<Vec<f64>> {
    let stage = Stage::new(scene, RESOLUTION);
    let mut run = match stage.prepare(method, settings, transport, 1) {
        Ok(run) => run,
        Err(Error::Declined(_)) => return None,
        Err(error) => panic!("{}: {error}", method.id()),
    };
    while !run.step().expect("a step").finished() {}
    Some(numbers(&run.resolve().expect("a picture")))
}

/// As the harness collects them for cells on the adapter.
fn shared() -> [(&'static str, u32); 3] {
    [("placement", PLACEMENT_VERSION), ("shaders", SHADERS_VERSION), ("tables", TABLES_VERSION)]
}

fn of_placement() -> Sketch {
    let stage = Stage::builtin("trio", RESOLUTION);
    let maps = scene_maps(&stage.on_gpu, &stage.scene, 64, 1).expect("maps");
    let (maps, _) = lit_maps(&stage.on_gpu, &stage.scene, &maps).expect("lights");
    let lights = maps.iter().flat_map(|map| map.lights.iter().flatten());
    let lights = components(lights.flat_map(|light| [light.position, light.normal, light.flux]));
    let reach = RadiusRule::ALL.map(|rule| radii(&stage.scene, &maps, rule).0);
    let reach = reach.concat().into_iter().map(f64::from).collect();
    let [placement, shaders, _] = shared();
    Sketch::new([placement, shaders], &[lights, reach].concat())
}

/// What pixels see, and which lights they see.
fn of_shaders() -> Sketch {
    let stage = Stage::builtin("trio", RESOLUTION);
    let surfaces = stage.surfaces();
    let seen = components(surfaces.iter().flat_map(|surface| {
        [surface.position, surface.normal, surface.diffuse, surface.f0, Vec3::splat(surface.alpha)]
    }));
    let maps = scene_maps(&stage.on_gpu, &stage.scene, 64, 1).expect("maps");
    let (lights, _) = distribute(&stage.on_gpu, &stage.scene, &maps).expect("lights");
    let centers: Vec<_> = lights.iter().map(Into::into).collect();
    let shadows = Shadows::new(&stage.on_gpu, &stage.scene).expect("the hierarchy fits");
    let occluded = shadows.occluded_lights(&centers).expect("a pass");
    let dark = occluded.chunks(surfaces.len()).map(|pixels| {
        pixels.iter().filter(|occluded| **occluded).count() as f64 / surfaces.len() as f64
    });
    let [placement, shaders, _] = shared();
    Sketch::new([placement, shaders], &[seen, dark.collect()].concat())
}

fn of_tables() -> Sketch {
    let dielectric = manylights_scene::Brdf {
        alpha: 0.25,
        lobe: Lobe::Dielectric { index: 1.5 },
        ..manylights_scene::Brdf::lambert(Vec3::ONE)
    };
    let values = [
        cast_slice(LobeTable::of(0.25, 5, Damping::None).values()).to_vec(),
        cast_slice(LobeTable::of(dielectric, 3, Damping::Weakest).values()).to_vec(),
        cast_slice(ZonalTable::of(0.5, 5, Damping::None).values()).to_vec(),
        cast_slice(&diffuse::lobes(5, Damping::None)).to_vec(),
    ];
    let [_, _, tables] = shared();
    Sketch::new([tables], &values.concat())
}

fn of_references() -> Sketch {
    let scene = manylights_scene::load("cornell-glossy", None).expect("built in");
    let picture = |transport: &str| {
        let transport = transport.parse().expect("a transport");
        let settings = Settings { transport, resolution: RESOLUTION, seed: 1, samples: 32 };
        let rendered =
            manylights_path_tracer::render(&scene, &scene.cameras[0], &settings, None, &mut |_| {});
        numbers(&rendered.expect("a reference").image)
    };
    let one_bounce = Stage::builtin("trio", RESOLUTION);
    let ignored = one_bounce.reference(manylights_scene::Visibility::Ignored, 32).image;
    let pictures = ["direct", "indirect-1", "all"].map(picture).concat();
    Sketch::new([("reference", REFERENCE_VERSION)], &[pictures, numbers(&ignored)].concat())
}

/// A sketch holds a mean for each value, so those of metrics that came later are apart.
fn of_metrics(metrics: &'static [MetricInfo]) -> Sketch {
    let picture = |rate: f32| {
        let value = |index: u32| 0.5 + 0.5 * (rate * index as f32).sin();
        let pixels = (0..24 * 16).map(|i| [value(i), value(i + 7), value(2 * i)]).collect();
        RadianceImage { width: 24, height: 16, pixels }
    };
    let (image, reference) = (picture(0.31), picture(0.32));
    let errors = [
        compare_linear(&image, &reference).expect("comparable"),
        compare_display(&image, &reference, 1.5).expect("comparable"),
    ];
    let values =
        errors.iter().flat_map(|errors| metrics.iter().filter_map(|info| (info.value)(errors)));
    // Once a channel, so that each mean is one number.
    let values: Vec<f64> = values.flat_map(|value| [value; 3]).collect();
    Sketch::new([("metrics", METRICS_VERSION)], &values)
}

fn sketches() -> BTreeMap<String, Sketch> {
    let stages = [
        ("placement", of_placement()),
        ("shaders", of_shaders()),
        ("tables", of_tables()),
        ("references", of_references()),
        ("metrics", of_metrics(&METRICS[..8])),
        ("later metrics", of_metrics(&METRICS[8..])),
    ];
    let stages = stages.map(|(name, sketch)| (format!("stage {name}"), sketch));
    let methods =
        METHODS.iter().map(|&method| (format!("method {}", method.id()), of_method(method)));
    methods.chain(stages).collect()
}

/// Processor, with the instructions that it has, and driver.
fn place() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| {
        let line = text.lines().find(|line| line.starts_with(name))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    };
    let vectors = field("flags").unwrap_or_default();
    let vectors = vectors.split(' ').filter(|flag| flag.starts_with("avx") || *flag == "fma");
    let adapter = GPU.report();
    format!(
        "{} {}; {} {}; {} {}",
        std::env::consts::ARCH,
        std::env::consts::OS,
        field("model name").unwrap_or_default(),
        vectors.collect::<Vec<_>>().join(" "),
        adapter.name,
        adapter.driver_info
    )
}

#[test]
fn nothing_moves_without_its_version() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/versions.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|_| "{}".to_owned());
    let mut recorded: BTreeMap<String, Value> = serde_json::from_str(&text).expect("JSON");
    let (place, sketches) = (place(), sketches());
    let bless = std::env::var_os("MANYLIGHTS_BLESS").is_some();
    let mut faults = Vec::new();
    for (name, sketch) in &sketches {
        let Some(known) = recorded.get_mut(name) else {
            match bless {
                true => drop(recorded.insert(name.clone(), sketch.json(&place))),
                false => faults.push(format!("{name} is new: record it with MANYLIGHTS_BLESS=1")),
            }
            continue;
        };
        let same_versions = known["versions"] == json!(sketch.versions);
        match sketch.moved(known, &place) {
            Some(what) if same_versions => {
                let versions = &known["versions"];
                faults.push(format!("{name} moved ({what}), its versions {versions} did not"));
            }
            _ if bless && same_versions => known["hash"][&place] = sketch.hash.clone().into(),
            _ if bless => *known = sketch.json(&place),
            _ if same_versions => {}
            _ => faults.push(format!("{name} has new versions: record it with MANYLIGHTS_BLESS=1")),
        }
    }
    let gone: Vec<String> =
        recorded.keys().filter(|name| !sketches.contains_key(*name)).cloned().collect();
    for name in gone {
        match bless {
            true => drop(recorded.remove(&name)),
            false => faults.push(format!("{name} is gone: record that with MANYLIGHTS_BLESS=1")),
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    if bless {
        let lines: Vec<String> = recorded
            .iter()
            .map(|(name, sketch)| format!("{}:{sketch}", Value::from(name.as_str())))
            .collect();
        std::fs::write(&path, format!("{{\n{}\n}}\n", lines.join(",\n"))).expect("writable");
    }
}
