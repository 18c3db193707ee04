//! Results age with what they were computed by, and with nothing else: a parameter that a method gets
//! later leaves them as they are, a version that is raised does not.

use std::path::Path;

use manylights_harness::cli;
use manylights_harness::registry::Methods;
use manylights_method::{
    Cost, CounterInfo, Error, Frame, Method, ParameterInfo, ParameterKind, Parameters, Processor,
    Run,
};
use manylights_path_tracer::PathTracer;
use manylights_scene::Visibility;

/// The path tracer at some time of its life.
struct Aging {
    version: u32,
    parameters: &'static [ParameterInfo],
}

impl Method for Aging {
    fn id(&self) -> &'static str {
        "aging"
    }

    fn title(&self) -> &'static str {
        "the path tracer at some time of its life"
    }

    fn version(&self) -> u32 {
        self.version
    }

    fn processor(&self) -> Processor {
        Processor::Cpu
    }

    fn parameters(&self) -> &'static [ParameterInfo] {
        self.parameters
    }

    fn counters(&self) -> &'static [CounterInfo] {
        PathTracer.counters()
    }

    fn cost(&self) -> Option<Cost> {
        PathTracer.cost()
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
        PathTracer.prepare(frame, parameters)
    }
}

const SAMPLES: ParameterInfo = ParameterInfo {
    name: "samples",
    formerly: None,
    introduced: None,
    help: "paths a pixel",
    kind: ParameterKind::Count { default: 4, min: 1, max: 64 },
};
/// Its default is another value than that which stands for the time before it.
const TILT: ParameterInfo = ParameterInfo {
    name: "tilt",
    formerly: None,
    introduced: Some("0"),
    help: "of nothing in particular",
    kind: ParameterKind::Real { default: 1.0, min: 0.0, max: 9.0 },
};

const BEFORE: Methods = &[&Aging { version: 1, parameters: &[SAMPLES] }];
const WITH_TILT: Methods = &[&Aging { version: 1, parameters: &[SAMPLES, TILT] }];
const NEXT: Methods = &[&Aging { version: 2, parameters: &[SAMPLES] }];

fn experiment(parameters: &str) -> String {
    format!(
        r#"
title = "Ages"
question = "What stays?"
scenes = ["cornell"]
transport = "indirect-1"
references = ["traced"]
[[methods]]
id = "aging"
parameters = {{ {parameters} }}
[profiles.quick]
resolution = [16, 12]
reference_samples = 32
repetitions = 1
seeds = [1, 2]
"#
    )
}

/// The cells in a folder after a run.
fn cells(folder: &Path, parameters: &str, methods: Methods) -> String {
    let path = |name: &str| folder.join(name).to_str().expect("UTF-8").to_owned();
    let (file, out, cache) = (path("asked.toml"), path("out"), path("cache"));
    std::fs::write(&file, experiment(parameters)).expect("writable");
    // The question is the same in other words: what differs is the methods'.
    let _ = std::fs::copy(&file, path("out/experiment.toml"));
    let run = ["manylights", "run", &file, "--profile", "quick", "--out", &out, "--cache", &cache];
    cli::run(run.map(Into::into), methods).expect("it runs");
    let report = ["manylights", "report", &out];
    cli::run(report.map(Into::into), methods).expect("its cells are found again");
    std::fs::read_to_string(path("out/cells.jsonl")).expect("cells")
}

#[test]
fn what_a_method_gets_later_leaves_results_as_they_are() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let folder = folder.path();
    let first = cells(folder, "samples = 4", BEFORE);
    assert_eq!(first.lines().count(), 2);
    assert_eq!(cells(folder, "samples = 4, tilt = 0", WITH_TILT), first);
    let both = cells(folder, "samples = 4, tilt = [0, 2]", WITH_TILT);
    assert_eq!(both.lines().count(), 4);
    assert!(both.starts_with(&first), "{both}");
    assert!(both.contains(r#""tilt":2.0"#), "{both}");
}

#[test]
fn another_version_takes_the_place_of_the_last() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let first = cells(folder.path(), "samples = 4", BEFORE);
    let second = cells(folder.path(), "samples = 4", NEXT);
    assert_eq!(second.lines().count(), 2, "{second}");
    assert!(first.contains(r#""method":1"#) && second.contains(r#""method":2"#));
}
