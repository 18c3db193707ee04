//! The path tracer as one of the methods under comparison.

use std::time::Instant;

use manylights_method::{
    Cost, CounterInfo, Direction, Error, Frame, Method, ParameterInfo, ParameterKind, Parameters,
    PassTime, Processor, Progress, Run,
};
use manylights_metrics::RadianceImage;
use manylights_scene::Visibility;

use crate::cache::REFERENCE_VERSION;
use crate::picture::Picture;
use manylights_paths::SLICE;

/// The path tracer, as a method: `reference`.
#[derive(Clone, Copy, Debug)]
pub struct PathTracer;

struct PathTracerRun<'a> {
    picture: Picture<'a>,
    slices: u32,
    slice_samples: u32,
    primary_seconds: f64,
    sample_seconds: f64,
}

impl Method for PathTracer {
    fn id(&self) -> &'static str {
        "reference"
    }

    fn title(&self) -> &'static str {
        "Path tracing on the CPU, the reference (Kajiya 1986)"
    }

    fn version(&self) -> u32 {
        REFERENCE_VERSION
    }

    fn processor(&self) -> Processor {
        Processor::Cpu
    }

    fn parameters(&self) -> &'static [ParameterInfo] {
        &[ParameterInfo {
            name: "samples",
            formerly: None,
            introduced: None,
            help: "paths a pixel, rounded up to equal slices of at most 16",
            kind: ParameterKind::Count { default: 64, min: 1, max: 1 << 24 },
        }]
    }

    fn counters(&self) -> &'static [CounterInfo] {
        &[
            CounterInfo { name: "samples", help: "paths a pixel" },
            CounterInfo { name: "rays", help: "rays cast, primary and shadow rays among them" },
        ]
    }

    fn cost(&self) -> Option<Cost> {
        Some(Cost { parameter: "samples", grows: Direction::Up })
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
        let start = Instant::now();
        let Frame { scene, camera, transport, resolution, seed, .. } = *frame;
        let samples = parameters.count("samples") as u32;
        let slices = samples.div_ceil(SLICE);
        let slice_samples = samples.div_ceil(slices);
        let picture = Picture::new(scene, camera, transport, resolution, seed, slice_samples)?;
        Ok(Box::new(PathTracerRun {
            picture,
            slices,
            slice_samples,
            primary_seconds: start.elapsed().as_secs_f64(),
            sample_seconds: 0.0,
        }))
    }
}

impl Run for PathTracerRun<'_> {
    fn step(&mut self) -> Result<Progress, Error> {
        let start = Instant::now();
        self.picture.slice()?;
        self.sample_seconds += start.elapsed().as_secs_f64();
        Ok(Progress {
            done: u64::from(self.picture.slices() * self.slice_samples),
            total: u64::from(self.slices * self.slice_samples),
        })
    }

    fn resolve(&mut self) -> Result<RadianceImage, Error> {
        Ok(self.picture.image())
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        let samples = u64::from(self.picture.slices() * self.slice_samples);
        vec![("samples", samples), ("rays", self.picture.rays())]
    }

    fn pass_times(&self) -> Vec<PassTime> {
        let pass = |pass, seconds| PassTime { pass, seconds };
        vec![pass("primary", self.primary_seconds), pass("sample", self.sample_seconds)]
    }
}
