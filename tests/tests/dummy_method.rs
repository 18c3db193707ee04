//! What a method needs to be measured: one module and one entry in a list. Nothing of the harness knows
//! more of it.

use std::path::Path;

use manylights_harness::cli;
use manylights_harness::registry::Methods;

/// Grey of an unknown brightness, known better with more guesses.
mod dummy {
    use manylights_method::{
        Cost, CounterInfo, Direction, Error, Frame, Method, ParameterInfo, ParameterKind,
        Parameters, PassTime, Processor, Progress, Run,
    };
    use manylights_metrics::RadianceImage;
    use manylights_scene::Visibility;

    pub(crate) struct Dummy;

    struct Guesses {
        resolution: [u32; 2],
        seed: u64,
        done: u64,
        total: u64,
    }

    impl Method for Dummy {
        fn id(&self) -> &'static str {
            "dummy"
        }

        fn title(&self) -> &'static str {
            "Grey, by guesses"
        }

        fn processor(&self) -> Processor {
            Processor::Cpu
        }

        fn parameters(&self) -> &'static [ParameterInfo] {
            &[ParameterInfo {
                formerly: None,
                name: "guesses",
                help: "of the brightness",
                kind: ParameterKind::Count { default: 4, min: 1, max: 1 << 20 },
            }]
        }

        fn counters(&self) -> &'static [CounterInfo] {
            &[CounterInfo { name: "guesses", help: "made of the brightness" }]
        }

        fn cost(&self) -> Cost {
            Cost { parameter: "guesses", grows: Direction::Up }
        }

        fn visibility(&self) -> Visibility {
            Visibility::Traced
        }

        fn is_progressive(&self) -> bool {
            true
        }

        fn prepare<'a>(
            &self,
            frame: &Frame<'a>,
            parameters: &Parameters,
        ) -> Result<Box<dyn Run + 'a>, Error> {
            if frame.scene.lights.is_empty() {
                return Err(Error::Declined("guesses where there are lights".into()));
            }
            let Frame { resolution, seed, .. } = *frame;
            let total = parameters.count("guesses");
            Ok(Box::new(Guesses { resolution, seed, done: 0, total }))
        }
    }

    impl Run for Guesses {
        fn step(&mut self) -> Result<Progress, Error> {
            self.done += 1;
            Ok(Progress { done: self.done, total: self.total })
        }

        fn resolve(&mut self) -> Result<RadianceImage, Error> {
            let [width, height] = self.resolution;
            let grey = 0.1 + 0.1 / (self.seed + self.done) as f32;
            Ok(RadianceImage { width, height, pixels: vec![[grey; 3]; (width * height) as usize] })
        }

        fn counters(&self) -> Vec<(&'static str, u64)> {
            vec![("guesses", self.done)]
        }

        fn pass_times(&self) -> Vec<PassTime> {
            Vec::new()
        }
    }
}

const METHODS: Methods = &[&dummy::Dummy];

const EXPERIMENT: &str = r#"
title = "Guesses"
question = "How grey?"
scenes = ["cornell"]
transport = "indirect-1"
references = ["traced", "ignored"]
[[methods]]
id = "dummy"
parameters = { guesses = [1, 8] }
visibility = ["traced", "ignored"]
[[methods]]
id = "dummy"
budget = "time"
[profiles.quick]
resolution = [16, 12]
reference_samples = 32
repetitions = 1
seeds = [1, 2]
times = [1e-3]
"#;

fn run(arguments: &[&str]) {
    let arguments = ["manylights"].iter().chain(arguments).map(Into::into);
    if let Err(failure) = cli::run(arguments, METHODS) {
        panic!("{failure}");
    }
}

#[test]
fn one_module_and_one_entry_are_enough() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let read = |name: &str| std::fs::read_to_string(Path::new(&path(name))).expect(name);
    let (file, out, cache) = (path("experiment.toml"), path("out"), path("cache"));
    std::fs::write(&file, EXPERIMENT).expect("can write");
    run(&["plan", &file, "--profile", "quick"]);
    run(&["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache]);
    // Four variants by count and one by time, two seeds each.
    let cells = read("out/cells.jsonl");
    assert_eq!(cells.lines().filter(|line| line.contains(r#""outcome":"done""#)).count(), 10);
    assert!(cells.contains(r#""counters":{"guesses":8}"#), "{cells}");
    for answer in ["table.md", "table.csv", "table.tex", "curves.svg", "report.html"] {
        assert!(read(&format!("out/{answer}")).contains("dummy"), "{answer}");
    }
    run(&["report", &out]);
    run(&["merge", &out, "--out", &path("merged")]);
    run(&["list", "methods"]);
    let picture = path("dummy.exr");
    run(&[
        "render",
        "--scene",
        "cornell",
        "--method",
        "dummy",
        "--resolution",
        "16x12",
        "-o",
        &picture,
    ]);
    // The harness knows no other.
    let arguments = ["manylights", "render", "--scene", "trio", "--method", "vpl", "-o", &picture];
    let unknown = cli::run(arguments.map(Into::into), METHODS).expect_err("no such method");
    assert!(unknown.to_string().contains("unknown method `vpl`"), "{unknown}");
}
