//! Spheres of light that move around a scene: projected at the vertices of a grid and read at every frame, with
//! kept pipelines, beside the same at every pixel; written to `results/throughput/moving-lights.md`. Run with
//! `cargo run -p manylights-tests --example moving_lights`, and the commit as its argument.

use std::time::Instant;

use glam::Vec3;
use manylights_area_lights::{AreaGather, AreaLights};
use manylights_gpu::{AdapterReport, Buffer};
use manylights_interpolation::{
    Bounds, Grid, Interpolation, Loops, Near, Order, Pixels, Projector, Reach, Reading, Scheme,
    Settings as ReadingSettings, Storage,
};
use manylights_method::{Method, Parameters};
use manylights_metrics::{RadianceImage, compare_linear};
use manylights_reflectance::{Damping, Form, Materials, Tables};
use manylights_scene::{AreaLight, Scene, Transport, Visibility};
use manylights_spherical_light::{
    Settings, SphereLight, SphericalLights, linked_projection, linked_shader,
};
use manylights_tests::{GPU, Stage, page, processors};

const RESOLUTION: [u32; 2] = [640, 480];
const LIGHTS: u32 = 512;
/// After one that compiles.
const FRAMES: u32 = 5;
const HOW: Interpolation = Interpolation {
    scheme: Scheme::Hermite,
    vertices: 8,
    bounds: Bounds::View,
    loops: Loops::Forward,
    order: Order::Sorted,
    near: Near::Apart,
    storage: Storage::F32,
};
/// Of reference over total in thesis figure 3.14 and table 3.5 from 5 to 9 bands.
const THESIS: &str = "5.0 falling to 1.1";

/// The built-in `trio`, Lambertian or glossy all over.
fn scene(glossy: bool) -> Scene {
    let mut scene = manylights_scene::load("trio", None).expect("built in");
    scene.lights.clear();
    for material in &mut scene.materials {
        (material.metallic, material.specular) = (0.0, if glossy { 1.0 } else { 0.0 });
        material.roughness = 0.5;
    }
    scene
}

/// On circles around a grid, outside of what is near it.
fn lights(grid: &Grid<f32>, frame: u32) -> Vec<AreaLight> {
    let spacing = Vec3::from(grid.spacing);
    let cells = Vec3::from(grid.vertices.map(|count| (count - 1) as f32));
    let (middle, radius) = (Vec3::from(grid.origin) + 0.5 * cells * spacing, 0.1);
    let reach = Vec3::splat(2.0 * spacing.max_element());
    let distance = (0.5 * cells * spacing + reach).length() + 2.0 * radius;
    let light = |i: u32| {
        let height = (i as f32 + 0.5) / LIGHTS as f32;
        let (sin, cos) = (2.4 * i as f32 + 0.1 * frame as f32).sin_cos();
        let across = (1.0 - height * height).sqrt();
        let toward = Vec3::new(across * cos, height, across * sin);
        AreaLight::Sphere {
            center: middle + distance * toward,
            radius,
            radiance: Vec3::new(1.0, 0.8, 0.5 + 0.5 * height),
        }
    };
    let lights: Vec<_> = (0..LIGHTS).map(light).collect();
    assert!(!lights.iter().any(|light| Reach::new(grid).meets(light)), "a light is near");
    lights
}

/// Both ways of making a picture of one scene, ready for any lights.
struct Ways {
    grid: Grid<f32>,
    projector: Projector,
    reading: Reading,
    read: Buffer,
    gather: AreaGather,
}

impl Ways {
    fn new(stage: &Stage, bands: usize) -> Self {
        let settings = Settings { bands, ..Settings::default() };
        let materials = Materials::of_scene(&stage.scene);
        let kinds = materials.kinds();
        let mut tables = Vec::new();
        if kinds.specular {
            let lobes = materials.lobe_records(Tables::shared(), bands, Form::Full, Damping::None);
            tables.push(GPU.storage("shapes", &materials.shape_records()).expect("it fits"));
            tables.push(GPU.storage("lobes", &lobes).expect("it fits"));
        }
        let count = RESOLUTION[0] * RESOLUTION[1];
        let (surfaces, camera) = (stage.on_gpu.surfaces(), stage.scene.cameras[0].position);
        let grid = HOW.grid(&GPU, &stage.scene, (surfaces, count)).expect("a grid");
        let shader = linked_projection(&settings, HOW.projection()).expect("it links");
        let projector = Projector::new(&GPU, grid, &shader).expect("it fits");
        let read = GPU.zeroed("read", 16 * u64::from(count)).expect("it fits");
        let pixels = Pixels { surfaces, count, camera, tables: &tables, results: &read };
        let Interpolation { scheme, order, storage, .. } = HOW;
        let of_grid = ReadingSettings { grid, scheme, bands, kinds, order, storage };
        let coefficients = &projector.coefficients().buffer;
        let reading = Reading::new(&GPU, &of_grid, coefficients, &pixels).expect("kernels");
        let shader = linked_shader(kinds, &settings).expect("it links");
        let gather = AreaGather::new(&GPU, (surfaces, count), camera, &shader, tables);
        Self { grid, projector, reading, read, gather: gather.expect("it fits") }
    }

    fn records(&self, frame: u32) -> Vec<SphereLight> {
        lights(&self.grid, frame).iter().filter_map(SphereLight::of).collect()
    }

    /// Seconds of all processors: of projecting and of reading.
    fn by_grid(&mut self, records: &[SphereLight]) -> [f64; 2] {
        let start = processors::seconds(true);
        GPU.clear(&self.read).expect("a buffer");
        self.projector.project(records).expect("a projection");
        let projected = processors::seconds(true) - start;
        self.reading.add().expect("a reading");
        [projected, processors::seconds(true) - start - projected]
    }

    /// Seconds of all processors.
    fn by_pixel(&self, records: &[SphereLight]) -> f64 {
        let start = processors::seconds(true);
        GPU.clear(self.gather.results()).expect("a buffer");
        let batches = self.gather.batches(records).expect("it fits");
        self.gather.add(&batches, 0..batches.count()).expect("a gather");
        processors::seconds(true) - start
    }

    fn bits(&self) -> Vec<u32> {
        GPU.read(&self.read).expect("a picture")
    }
}

fn image(pixels: &Buffer) -> RadianceImage {
    let pixels: Vec<[f32; 4]> = GPU.read(pixels).expect("a picture");
    let pixels = pixels.iter().map(|&[r, g, b, _]| [r, g, b].map(|value| value.max(0.0))).collect();
    RadianceImage { width: RESOLUTION[0], height: RESOLUTION[1], pixels }
}

/// The whole method with its bake, which makes its tables and bounds as well; the second time, seconds of all
/// processors.
fn by_method(stage: &Stage, bands: usize) -> f64 {
    let method = AreaLights(SphericalLights);
    let bands = bands.to_string();
    let texts = [("bands", &*bands), ("interpolation", "hermite")];
    let parameters = Parameters::new(method.parameters(), texts).expect("in range");
    let frame = stage.frame(Transport::Direct { visibility: Visibility::Ignored }, 0);
    let picture = |_| {
        let start = processors::seconds(true);
        let bake = method.baking().expect("tables").bake(&frame, &parameters).expect("a bake");
        let mut run = bake.prepare(&frame, &parameters).expect("a run");
        while !run.step().expect("a step").finished() {}
        processors::seconds(true) - start
    };
    [0, 1].map(picture)[1]
}

fn median(mut seconds: Vec<f64>) -> f64 {
    seconds.sort_by(f64::total_cmp);
    1e3 * seconds[seconds.len() / 2]
}

fn row(stage: &mut Stage, name: &str, bands: usize) -> String {
    let mut ways = Ways::new(stage, bands);
    let start = Instant::now();
    let first = ways.records(0);
    ways.by_grid(&first);
    let bits = ways.bits();
    ways.by_pixel(&first);
    eprintln!("{name}, {bands} bands: {:.1} s", start.elapsed().as_secs_f64());
    let [mut projected, mut read, mut gathered] = [(); 3].map(|()| Vec::new());
    for frame in 1..=FRAMES {
        let records = ways.records(frame);
        let [project, reading] = ways.by_grid(&records);
        projected.push(project);
        read.push(reading);
        gathered.push(ways.by_pixel(&records));
    }
    let (found, truth) = (image(&ways.read), image(ways.gather.results()));
    let errors = compare_linear(&found, &truth).expect("of one size");
    let sum: f64 = truth.pixels.as_flattened().iter().map(|&value| f64::from(value)).sum();
    let mean = sum / truth.pixels.as_flattened().len() as f64;
    ways.by_grid(&first);
    assert!(ways.bits() == bits, "the same positions give the same bits");
    stage.scene.area_lights = lights(&ways.grid, 1);
    let method = 1e3 * by_method(stage, bands);
    let [project, read, gather] = [projected, read, gathered].map(median);
    format!(
        "| {name} | {bands} | {project:.1} | {read:.1} | {gather:.0} | {:.1} | {method:.0} | {:.1e} | {:.1e} |\n",
        gather / (project + read),
        errors.mae / mean,
        errors.rmse / mean,
    )
}

fn main() {
    let AdapterReport { name, driver, driver_info, .. } = GPU.report();
    let commit = std::env::args().nth(1).unwrap_or_else(|| "unknown".to_owned());
    let mut text = format!(
        "# Lights that move\n\n\
         `cargo run -p manylights-tests --example moving_lights` on {name} ({driver} {driver_info}), commit {commit}.\n\n\
         `trio` under {LIGHTS} spheres that circle around it, outside two cells of the grid; {}×{} pixels, 8³ \
         vertices, `hermite`. Milliseconds of all processors together a frame (others ran besides), median of {FRAMES} frames with other positions, both \
         ways in turn. Projector, reading and gather are kept: a frame makes the lights' records \
         and compiles nothing; the pixels, which stay, are sorted once. `method`: a whole bake and picture of the method instead. Errors are relative to the \
         mean radiance, against every light at every pixel. The same positions gave the same bits in every row. At \
         least 5 is asked for at every number of bands; the thesis has {THESIS}.\n\n\
         | receivers | bands | project | read | at every pixel | ratio | method | MAE | RMSE |\n\
         |---|---|---|---|---|---|---|---|---|\n",
        RESOLUTION[0], RESOLUTION[1],
    );
    for (name, glossy) in [("Lambertian", false), ("glossy", true)] {
        let mut stage = Stage::new(scene(glossy), RESOLUTION);
        for bands in 5..=9 {
            text += &row(&mut stage, name, bands);
        }
    }
    page::write("results/throughput/moving-lights.md", &text);
}
