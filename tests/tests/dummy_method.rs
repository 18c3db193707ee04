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

        fn version(&self) -> u32 {
            1
        }

        fn processor(&self) -> Processor {
            Processor::Cpu
        }

        fn parameters(&self) -> &'static [ParameterInfo] {
            &[ParameterInfo {
                formerly: None,
                introduced: None,
                name: "guesses",
                help: "of the brightness",
                kind: ParameterKind::Count { default: 4, min: 1, max: 1 << 20 },
            }]
        }

        fn counters(&self) -> &'static [CounterInfo] {
            &[CounterInfo { name: "guesses", help: "made of the brightness" }]
        }

        fn cost(&self) -> Option<Cost> {
            Some(Cost { parameter: "guesses", grows: Direction::Up })
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

/// The same grey at once: no amount of work.
mod flat {
    use manylights_method::{
        ChoiceWord, Cost, CounterInfo, Error, Frame, Method, ParameterInfo, ParameterKind,
        Parameters, PassTime, Processor, Progress, Run,
    };
    use manylights_metrics::RadianceImage;
    use manylights_scene::Visibility;

    pub(crate) struct Flat;

    struct Paint {
        resolution: [u32; 2],
        grey: f32,
    }

    impl Method for Flat {
        fn id(&self) -> &'static str {
            "flat"
        }

        fn title(&self) -> &'static str {
            "Grey, by decision"
        }

        fn version(&self) -> u32 {
            1
        }

        fn processor(&self) -> Processor {
            Processor::Cpu
        }

        fn parameters(&self) -> &'static [ParameterInfo] {
            const TONES: &[ChoiceWord] = &[
                ChoiceWord { word: "dark", help: "a tenth" },
                ChoiceWord { word: "light", help: "a half" },
            ];
            &[ParameterInfo {
                formerly: None,
                introduced: None,
                name: "tone",
                help: "of the grey",
                kind: ParameterKind::Choice { default: "dark", words: TONES },
            }]
        }

        fn counters(&self) -> &'static [CounterInfo] {
            &[]
        }

        fn cost(&self) -> Option<Cost> {
            None
        }

        fn visibility(&self) -> Visibility {
            Visibility::Traced
        }

        fn is_progressive(&self) -> bool {
            false
        }

        fn prepare<'a>(
            &self,
            frame: &Frame<'a>,
            parameters: &Parameters,
        ) -> Result<Box<dyn Run + 'a>, Error> {
            let grey = parameters.choice("tone", &[("dark", 0.1), ("light", 0.5)]);
            Ok(Box::new(Paint { resolution: frame.resolution, grey }))
        }
    }

    impl Run for Paint {
        fn step(&mut self) -> Result<Progress, Error> {
            Ok(Progress { done: 1, total: 1 })
        }

        fn resolve(&mut self) -> Result<RadianceImage, Error> {
            let [width, height] = self.resolution;
            let pixels = vec![[self.grey; 3]; (width * height) as usize];
            Ok(RadianceImage { width, height, pixels })
        }

        fn counters(&self) -> Vec<(&'static str, u64)> {
            Vec::new()
        }

        fn pass_times(&self) -> Vec<PassTime> {
            Vec::new()
        }
    }
}

const METHODS: Methods = &[&dummy::Dummy, &flat::Flat];

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

/// Beside methods with a time budget, as the baseline that sets one, and over its other parameters.
const WITHOUT_AMOUNT: &str = r#"
title = "Greys"
question = "Who is grey first?"
scenes = ["cornell"]
transport = "indirect-1"
references = ["traced"]
errors = [0.9]
[[methods]]
id = "flat"
parameters = { tone = ["dark", "light"] }
budget = "time"
[[methods]]
id = "dummy"
budget = "time"
[baseline]
id = "flat"
parameters = { tone = "dark" }
[profiles.quick]
resolution = [16, 12]
reference_samples = 32
repetitions = 2
seeds = [1, 2]
times = [1e-3, "baseline"]
"#;

#[test]
fn a_method_without_an_amount_runs_once_under_any_budget() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let read = |name: &str| std::fs::read_to_string(Path::new(&path(name))).expect(name);
    let (file, out, cache) = (path("experiment.toml"), path("out"), path("cache"));
    std::fs::write(&file, WITHOUT_AMOUNT).expect("can write");
    run(&["plan", &file, "--profile", "quick"]);
    run(&["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache]);
    let lines = read("out/cells.jsonl");
    let of = |method: &str, part: &str| {
        let method = format!(r#""method":"{method}""#);
        lines.lines().filter(|line| line.contains(&method) && line.contains(part)).count()
    };
    // Two tones, two seeds, two repetitions, whatever the number of times; of the other method, whose
    // searched cells may have been corrected, at least as many.
    assert_eq!((of("flat", ""), of("flat", r#""outcome":"done""#)), (8, 8), "{lines}");
    assert!(of("dummy", r#""outcome":"done""#) >= 8, "{lines}");
    assert_eq!((of("flat", r#""amount""#), of("flat", r#""budget":"count""#)), (0, 8), "{lines}");
    assert_eq!(of("dummy", r#""amount""#), of("dummy", ""), "{lines}");

    let table = read("out/table.md");
    let rows = table.lines().filter(|line| line.contains("flat tone=")).count();
    assert!(rows >= 2, "{table}");
    assert!(
        table.contains("No amount of work sets the time of flat: it is what it is."),
        "{table}"
    );
    let csv = read("out/table.csv");
    let columns: Vec<_> = csv.lines().next().expect("a head").split(',').collect();
    let column = |name: &str| columns.iter().position(|known| *known == name).expect(name);
    for (line, [searched, amount]) in csv.lines().skip(1).map(|line| {
        let fields: Vec<_> = line.split(',').collect();
        (line, [fields[column("time_budget")], fields[column("amount")]])
    }) {
        let flat = line.contains(",flat,");
        assert_eq!([searched.is_empty(), amount.is_empty()], [flat, flat], "{line}");
    }
    // The point of its curve has a time and no amount.
    assert!(read("out/curves.svg").contains("flat") && read("out/report.html").contains("flat"));
    // All is there already: nothing runs again, and repeating the work asks for no amount.
    run(&["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache]);
    assert_eq!(read("out/cells.jsonl").lines().count(), lines.lines().count());
    run(&["report", &out]);
    run(&["merge", &out, "--out", &path("merged")]);
    run(&["list", "methods"]);
    run(&["list", "methods", "--json"]);
}
