//! Error against time of one indirect bounce plus direct light, for `scripts/compare-mitsuba`.
//!
//! `time_to_error SCENE CACHE CONVERGED_SAMPLES REPETITIONS SLICES...` renders the scene (a name or a
//! scene file; assets from `MANYLIGHTS_ASSETS`) with so many slices for each of both transports and
//! prints a JSON line for each picture: samples, seconds from scene to picture, and RMSE of radiance
//! against the converged picture outside pixels that show a lamp or touch one that does.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use manylights_method::{Frame, Method, Parameters};
use manylights_metrics::RadianceImage;
use manylights_path_tracer::{PathTracer, SLICE, Settings, render};
use manylights_scene::Transport;
use manylights_scene::bvh::{Bvh, Ray};
use manylights_scene::{Camera, Scene, load};

const RESOLUTION: [u32; 2] = [256, 256];
const TRANSPORTS: [&str; 2] = ["direct", "indirect-1"];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let [scene, cache, converged, repetitions, slices @ ..] = &arguments[..] else {
        return Err(
            "usage: time_to_error SCENE CACHE CONVERGED_SAMPLES REPETITIONS SLICES...".into()
        );
    };
    let assets = std::env::var_os("MANYLIGHTS_ASSETS");
    let scene = load(scene, assets.as_deref().map(Path::new))?;
    let camera = scene.camera(None)?;
    let slices = slices.iter().map(|text| text.parse()).collect::<Result<Vec<u32>, _>>()?;
    let converged = converged_picture(&scene, camera, converged.parse()?, Path::new(cache))?;
    let dark = pixels_without_lamp(&scene, camera);
    eprintln!("{} pixels are left out", dark.iter().filter(|dark| !**dark).count());
    for repetition in 0..repetitions.parse()? {
        for &slices in &slices {
            let start = Instant::now();
            let picture = picture(&scene, camera, slices, 100 + repetition)?;
            let seconds = start.elapsed().as_secs_f64();
            let rmse = rmse(&picture, &converged, &dark);
            let samples = slices * SLICE;
            println!(r#"{{"samples": {samples}, "seconds": {seconds:.4}, "rmse": {rmse:.6}}}"#);
        }
    }
    Ok(())
}

fn picture(
    scene: &Scene,
    camera: &Camera,
    slices: u32,
    seed: u64,
) -> Result<RadianceImage, Box<dyn Error>> {
    let mut pictures = Vec::new();
    for transport in TRANSPORTS {
        let transport: Transport = transport.parse()?;
        let frame = Frame { scene, camera, resolution: RESOLUTION, transport, seed, gpu: None };
        let parameters = Parameters::new(PathTracer.parameters(), [])?;
        let mut run = PathTracer.prepare(&frame, &parameters)?;
        for _ in 0..slices {
            run.step()?;
        }
        pictures.push(run.resolve()?);
    }
    Ok(sum(&pictures))
}

fn converged_picture(
    scene: &Scene,
    camera: &Camera,
    samples: u32,
    cache: &Path,
) -> Result<RadianceImage, Box<dyn Error>> {
    let mut pictures = Vec::new();
    for transport in TRANSPORTS {
        let settings =
            Settings { transport: transport.parse()?, resolution: RESOLUTION, seed: 1, samples };
        let reference = render(scene, camera, &settings, Some(cache), &mut |_| {})?;
        eprintln!(
            "{transport}: {} samples, noise floor {:.6}",
            reference.samples, reference.noise_floor
        );
        pictures.push(reference.image);
    }
    Ok(sum(&pictures))
}

fn sum(pictures: &[RadianceImage]) -> RadianceImage {
    let [width, height] = RESOLUTION;
    let mut sum = RadianceImage::black(width, height);
    for picture in pictures {
        let total = sum.pixels.as_flattened_mut();
        for (total, value) in total.iter_mut().zip(picture.pixels.as_flattened()) {
            *total += value;
        }
    }
    sum
}

/// Pixels of whose 3 × 3 neighbourhood no centre shows a lamp: a box filter mixes no lamp into them.
fn pixels_without_lamp(scene: &Scene, camera: &Camera) -> Vec<bool> {
    let bvh = Bvh::build(scene);
    let [width, height] = RESOLUTION;
    let shows_lamp = |x: u32, y: u32| {
        let direction = camera.direction(x, y, RESOLUTION);
        let hit = bvh.closest(&Ray::new(camera.position, direction));
        hit.is_some_and(|hit| scene.emits(hit.triangle))
    };
    let around = |at: u32, length: u32| at.saturating_sub(1)..(at + 2).min(length);
    let no_lamp = |x, y| !around(y, height).any(|y| around(x, width).any(|x| shows_lamp(x, y)));
    (0..width * height).map(|index| no_lamp(index % width, index / width)).collect()
}

fn rmse(a: &RadianceImage, b: &RadianceImage, counted: &[bool]) -> f64 {
    let pixels =
        || std::iter::zip(&a.pixels, &b.pixels).zip(counted).filter(|(_, counted)| **counted);
    let squares: f64 = pixels()
        .flat_map(|((a, b), _)| std::iter::zip(a, b))
        .map(|(a, b)| f64::from(a - b).powi(2))
        .sum();
    (squares / (3 * pixels().count()) as f64).sqrt()
}
