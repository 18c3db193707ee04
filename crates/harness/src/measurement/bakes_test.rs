//! A method that bakes, and writes down what it was told to.

use std::path::Path;
use std::sync::Mutex;

use manylights_method::{
    Bake, Baking, Cost, CounterInfo, Dependencies, Direction, Error, Frame, Method, ParameterInfo,
    ParameterKind, Parameters, PassTime, Processor, Progress, Run,
};
use manylights_metrics::RadianceImage;
use manylights_scene::{Scene, Visibility};

use crate::answer::rows::SceneAnswer;
use crate::measurement::bakes::{Bakes, Origin, SceneHashes, Wanted};
use crate::measurement::cell::{Done, Outcome};
use crate::measurement::scene_cells::SceneCells;
use crate::measurement::session::Session;
use crate::question::columns::Column;
use crate::question::experiment::{self, Experiment};
use crate::question::plan::{Bounded, Budget, Variant};
use crate::question::profiles::Profile;
use crate::registry::METHODS;
use crate::show::table;

struct Baker {
    depends: Dependencies,
    processor: Processor,
    log: Mutex<Vec<String>>,
}

/// What was baked: for which cameras.
struct Views(&'static Baker, Vec<String>);

struct Flat([u32; 2]);

const NOTHING: Dependencies =
    Dependencies { scene: false, lights: false, camera: false, seed: false, amount: false };

impl Baker {
    /// As methods are, for ever.
    fn new(depends: Dependencies, processor: Processor) -> &'static Self {
        Box::leak(Box::new(Self { depends, processor, log: Mutex::new(Vec::new()) }))
    }

    /// What was written down since the last call.
    fn log(&self) -> Vec<String> {
        std::mem::take(&mut self.log.lock().expect("nobody panics here"))
    }

    fn note(&self, what: &str, frame: &Frame<'_>, parameters: &Parameters) {
        let (camera, seed, work) = (&frame.camera.name, frame.seed, parameters.count("work"));
        let line = format!("{what} {camera}, seed {seed}, work {work}");
        self.log.lock().expect("nobody panics here").push(line);
    }
}

impl Method for &'static Baker {
    fn id(&self) -> &'static str {
        "baker"
    }

    fn title(&self) -> &'static str {
        "a method of a test"
    }

    fn version(&self) -> u32 {
        1
    }

    fn processor(&self) -> Processor {
        Processor::Cpu
    }

    fn parameters(&self) -> &'static [ParameterInfo] {
        const KIND: ParameterKind = ParameterKind::Count { default: 4, min: 1, max: 64 };
        &[ParameterInfo {
            name: "work",
            formerly: None,
            introduced: None,
            help: "none at all",
            kind: KIND,
        }]
    }

    fn counters(&self) -> &'static [CounterInfo] {
        &[]
    }

    fn cost(&self) -> Option<Cost> {
        Some(Cost { parameter: "work", grows: Direction::Up })
    }

    fn visibility(&self) -> Visibility {
        Visibility::Traced
    }

    fn is_progressive(&self) -> bool {
        false
    }

    fn baking(&self) -> Option<&dyn Baking> {
        Some(self)
    }

    fn prepare<'a>(
        &self,
        frame: &Frame<'a>,
        parameters: &Parameters,
    ) -> Result<Box<dyn Run + 'a>, Error> {
        self.bake(frame, parameters)?.prepare(frame, parameters)
    }
}

impl Baking for &'static Baker {
    fn depends_on(&self, _: &Parameters) -> Dependencies {
        self.depends
    }

    fn processor(&self, _: &Parameters) -> Processor {
        self.processor
    }

    fn counters(&self) -> &'static [CounterInfo] {
        &[CounterInfo { name: "views", help: "cameras so far" }]
    }

    fn bake(&self, frame: &Frame<'_>, parameters: &Parameters) -> Result<Box<dyn Bake>, Error> {
        self.note("bake", frame, parameters);
        Ok(Box::new(Views(self, vec![frame.camera.name.clone()])))
    }
}

impl Bake for Views {
    fn grow(&mut self, frame: &Frame<'_>, parameters: &Parameters) -> Result<(), Error> {
        self.0.note(&format!("grow {} to", self.1.join(" ")), frame, parameters);
        self.1.push(frame.camera.name.clone());
        Ok(())
    }

    fn prepare<'a>(&self, frame: &Frame<'a>, _: &Parameters) -> Result<Box<dyn Run + 'a>, Error> {
        Ok(Box::new(Flat(frame.resolution)))
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        vec![("views", self.1.len() as u64)]
    }

    fn pass_times(&self) -> Vec<PassTime> {
        // A second for each camera so far.
        vec![PassTime { pass: "view", seconds: self.1.len() as f64 }]
    }
}

impl Run for Flat {
    fn step(&mut self) -> Result<Progress, Error> {
        Ok(Progress { done: 1, total: 1 })
    }

    fn resolve(&mut self) -> Result<RadianceImage, Error> {
        let [width, height] = self.0;
        Ok(RadianceImage { width, height, pixels: vec![[0.5; 3]; (width * height) as usize] })
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        Vec::new()
    }

    fn pass_times(&self) -> Vec<PassTime> {
        Vec::new()
    }
}

const EXPERIMENT: &str = r#"
title = "Test"
question = "What is baked when?"
scenes = ["atrium"]
cameras = ["nave", "aisle"]
transport = "direct"
references = ["traced"]
[[methods]]
id = "reference"
[profiles.quick]
resolution = [16, 11]
reference_samples = 2
repetitions = 2
seeds = [1, 2]
"#;

/// [`EXPERIMENT`], read in this folder.
fn experiment_in(folder: &Path) -> Experiment {
    let file = folder.join("experiment.toml");
    std::fs::write(&file, EXPERIMENT).expect("writable");
    experiment::read(&file, Profile::Quick, METHODS).expect("valid")
}

/// The cells of `cameras` of the atrium by a method that bakes, with this budget; and what it wrote down.
fn cells(
    depends: Dependencies,
    (budget, bounded): (Budget, Bounded),
    cameras: &[usize],
) -> (Vec<SceneCells>, Vec<String>) {
    let folder = tempfile::tempdir().expect("temporary folder");
    let mut experiment = experiment_in(folder.path());
    let baker = Baker::new(depends, Processor::Cpu);
    experiment.variants = vec![Variant { budget, bounded, ..variant(baker) }];
    let scenes = measured(&experiment, folder.path(), cameras);
    (scenes, baker.log())
}

fn variant(baker: &'static Baker) -> Variant {
    Variant {
        method: Box::leak(Box::new(baker)),
        place: 0,
        parameters: Parameters::defaults((&baker).parameters()),
        swept: Some("work"),
        visibility: Visibility::Traced,
        budget: Budget::Count,
        bounded: Bounded::Time,
    }
}

fn measured(experiment: &Experiment, folder: &Path, cameras: &[usize]) -> Vec<SceneCells> {
    let scene = manylights_scene::load("atrium", None).expect("built in");
    let mut session = Session::open(experiment, folder, folder, None).expect("a free folder");
    let cells = |&camera: &usize| session.scene(&scene, camera, &[0]).expect("a scene");
    cameras.iter().map(cells).collect()
}

fn done(scene: &SceneCells) -> impl Iterator<Item = &Done> {
    scene.cells.iter().map(|(_, cell)| match &cell.outcome {
        Outcome::Done(done) => done.as_ref(),
        other => panic!("{other:?}"),
    })
}

const COUNT: (Budget, Bounded) = (Budget::Count, Bounded::Time);

#[test]
fn repetitions_seeds_and_cameras_share_what_does_not_depend_on_them() {
    let depends = Dependencies { scene: true, lights: true, ..NOTHING };
    let (scenes, log) = cells(depends, COUNT, &[0, 1]);
    assert_eq!(log, ["bake nave, seed 1, work 4"]);
    assert_eq!([&*scenes[0].scene, &*scenes[1].scene], ["atrium-nave", "atrium-aisle"]);
    let all: Vec<&Done> = scenes.iter().flat_map(done).collect();
    assert_eq!(all.len(), 8);
    assert!(all.iter().all(|cell| cell.bake_seconds == all[0].bake_seconds));
    let shared: Vec<bool> = all.iter().map(|cell| cell.bake_shared).collect();
    assert_eq!(shared, [false, true, true, true, true, true, true, true]);
    assert!(all.iter().all(|cell| cell.bake_counters["views"] == 1));
}

#[test]
fn each_seed_has_a_bake_of_its_own_where_it_depends_on_it() {
    let (scenes, log) = cells(Dependencies { seed: true, ..NOTHING }, COUNT, &[0, 1]);
    assert_eq!(log, ["bake nave, seed 1, work 4", "bake nave, seed 2, work 4"]);
    let shared: Vec<bool> = done(&scenes[0]).map(|cell| cell.bake_shared).collect();
    assert_eq!(shared, [false, false, true, true]);
}

#[test]
fn a_bake_grows_from_camera_to_camera_and_tells_what_the_growth_took() {
    let depends = Dependencies { scene: true, camera: true, ..NOTHING };
    let (scenes, log) = cells(depends, COUNT, &[0, 1]);
    let grown = ["bake nave, seed 1, work 4", "grow nave to aisle, seed 1, work 4"];
    assert_eq!(log, grown);
    for (scene, views) in scenes.iter().zip([1, 2]) {
        for cell in done(scene) {
            assert_eq!(cell.bake_counters["views"], views);
            assert_eq!(cell.bake_pass_seconds["view"], 1.0, "of this camera alone");
        }
    }
    // Alone, as a job on another machine or after an interruption: the same bake.
    let (scenes, log) = cells(depends, COUNT, &[1]);
    assert_eq!(log, grown);
    assert!(done(&scenes[0]).all(|cell| cell.bake_counters["views"] == 2));
    // Back to the first: nothing of the second may be in its bake.
    let (_, log) = cells(depends, COUNT, &[1, 0]);
    assert_eq!(log, [&grown[..], &grown[..1]].concat());
}

#[test]
fn an_equal_build_time_is_searched_with_bakes_that_are_made_anew() {
    let depends = Dependencies { amount: true, ..NOTHING };
    // No bake takes so long: the most work is the nearest.
    let budget = (Budget::Seconds(1e9), Bounded::BuildTime);
    let (scenes, log) = cells(depends, budget, &[0]);
    // Two tries, then what is measured. These bakes do nothing: which try took longer is the clock's
    // affair, and one of too little work is corrected.
    let [least, most] = [4, 64].map(|work| format!("bake nave, seed 1, work {work}"));
    assert_eq!(log[..2], [least, most.clone()]);
    assert!(log.len() > 2 && log.last() == Some(&most), "{log:?}");
    let found: Vec<_> = done(&scenes[0]).map(|cell| (cell.amount, cell.bake_shared)).collect();
    assert_eq!(found, [false, true, true, true].map(|shared| (Some(64.0), shared)));
    // Where a frame is what costs, the bake is not made again for each try.
    let budget = (Budget::Seconds(1e9), Bounded::Time);
    let (_, log) = cells(Dependencies { scene: true, ..NOTHING }, budget, &[0]);
    assert_eq!(log, ["bake nave, seed 1, work 4"]);
}

#[test]
fn a_baseline_without_a_bake_sets_no_build_time() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let mut experiment = experiment_in(folder.path());
    let budgeted = Variant {
        budget: Budget::Baseline,
        bounded: Bounded::BuildTime,
        ..experiment.variants[0].clone()
    };
    experiment.variants.push(budgeted);
    let scene = manylights_scene::load("atrium", None).expect("built in");
    let mut session =
        Session::open(&experiment, folder.path(), folder.path(), None).expect("a free folder");
    let cells = session.scene(&scene, 0, &[1]).expect("a scene");
    for (_, cell) in cells.cells {
        let Outcome::Declined { reason } = cell.outcome else { panic!("{:?}", cell.outcome) };
        assert!(reason.contains("bakes nothing"), "{reason}");
    }
}

#[test]
fn no_table_tells_the_time_of_a_baked_frame_without_the_bake() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let mut experiment = experiment_in(folder.path());
    experiment.columns = vec![Column::Time, Column::Rmse];
    experiment.variants.push(variant(Baker::new(NOTHING, Processor::Cpu)));
    let scene = manylights_scene::load("atrium", None).expect("built in");
    let mut session =
        Session::open(&experiment, folder.path(), folder.path(), None).expect("a free folder");
    let mut headings = |variants: &[usize]| {
        let mut cells = session.scene(&scene, 0, variants).expect("a scene");
        for (_, cell) in &mut cells.cells {
            let Outcome::Done(done) = &mut cell.outcome else { panic!("{:?}", cell.outcome) };
            if done.bake_counters.contains_key("views") {
                done.bake_seconds = 7.0;
            }
        }
        let answer = SceneAnswer::new(&experiment, &cells, folder.path()).expect("pictures");
        let table = table::of_scene(&experiment, &answer).swap_remove(0);
        let titles: Vec<_> = table.heading.iter().map(|(title, _)| *title).collect();
        (titles, table.lines)
    };
    assert_eq!(headings(&[0]).0, ["rank", "method", "time ms", "RMSE", "95 %"]);
    let (titles, lines) = headings(&[0, 1]);
    assert_eq!(titles, ["rank", "method", "time ms", "bake ms", "RMSE", "95 %"]);
    let bakes: Vec<_> = lines.iter().map(|line| line[3].as_str()).collect();
    assert_eq!(bakes, ["0", "7000", ""]);
}

/// Scene, camera, seed, amount of work.
type Asked<'s> = (&'s Scene, usize, u64, u64);

/// What bakes write down that are wanted one after the other.
fn baked(baker: &'static Baker, wanted: &[Asked<'_>]) -> Vec<String> {
    let mut bakes = Bakes::default();
    for &(scene, camera, seed, amount) in wanted {
        let amount = amount as f64;
        let parameters = Parameters::defaults((&baker).parameters()).with_number("work", amount);
        let origin = Origin { scene: SceneHashes::new(scene), seed, amount: Some(amount) };
        let (variant, baking, parameters) = (0, &baker as &dyn Baking, &parameters);
        let wanted = Wanted { variant, baking, parameters, origin, camera };
        let frame = |camera: usize| Frame {
            scene,
            camera: &scene.cameras[camera],
            resolution: [16, 11],
            transport: "direct".parse().expect("a transport"),
            seed,
            gpu: None,
        };
        bakes.get(&wanted, &|camera, bake| bake(&frame(camera))).expect("a bake");
    }
    baker.log()
}

#[test]
fn a_bake_is_made_again_for_what_it_depends_on_and_for_nothing_else() {
    let scene = manylights_scene::load("atrium", None).expect("built in");
    let mut darker = scene.clone();
    darker.lights.pop().expect("a light");
    let mut moved = scene.clone();
    moved.vertices[0].position *= 2.0;
    let mut emissive = scene.clone();
    emissive.materials[0].emission += 1.0;
    let first = (&scene, 0, 1, 4);
    let changes: [(Asked<'_>, Dependencies); 5] = [
        ((&moved, 0, 1, 4), Dependencies { scene: true, ..NOTHING }),
        ((&darker, 0, 1, 4), Dependencies { lights: true, ..NOTHING }),
        ((&emissive, 0, 1, 4), Dependencies { lights: true, ..NOTHING }),
        ((&scene, 0, 2, 4), Dependencies { seed: true, ..NOTHING }),
        ((&scene, 0, 1, 5), Dependencies { amount: true, ..NOTHING }),
    ];
    for (change, depends) in changes {
        let baker = Baker::new(depends, Processor::Cpu);
        assert_eq!(baked(baker, &[first, change]).len(), 2, "{depends:?}");
        assert_eq!(baked(baker, &[first, first]).len(), 1, "{depends:?}");
        // All else may change: of the scene, lights are more than themselves.
        let Dependencies { scene, lights, camera: _, seed, amount } = depends;
        let others = Dependencies {
            scene: !scene && !lights,
            lights: !lights && !scene,
            camera: false,
            seed: !seed,
            amount: !amount,
        };
        assert_eq!(baked(Baker::new(others, Processor::Cpu), &[first, change]).len(), 1);
    }
    // Materials and triangles alone: what shines does not matter.
    let baker = Baker::new(Dependencies { scene: true, ..NOTHING }, Processor::Cpu);
    assert_eq!(baked(baker, &[first, (&darker, 0, 1, 4), (&emissive, 0, 1, 4)]).len(), 1);
}

#[test]
fn on_the_adapter_the_first_bake_and_the_first_growth_are_thrown_away() {
    let scene = manylights_scene::load("atrium", None).expect("built in");
    let depends = Dependencies { camera: true, seed: true, ..NOTHING };
    let log = baked(
        Baker::new(depends, Processor::Gpu),
        &[(&scene, 0, 1, 4), (&scene, 0, 2, 4), (&scene, 1, 1, 4), (&scene, 1, 2, 4)],
    );
    let [bake, grow] = ["bake nave", "grow nave to aisle"];
    let log: Vec<_> = log.iter().map(|line| line.split(',').next().expect("a camera")).collect();
    assert_eq!(log, [bake, bake, bake, bake, grow, grow, grow]);
}
