//! Rays per second on one core, for `scripts/compare-embree`.
//!
//! `ray_rates export FILE` writes the room and the rays of `benches/rays.rs`, little-endian: number of
//! triangles, their corners, then for each set the number of rays and (origin, t_min, direction,
//! t_max) of each. `ray_rates` prints a JSON object: million rays per second of processor time for
//! each set, the best of several passes, and the sum of the distances.

#[path = "../benches/room/mod.rs"]
mod room;

use std::error::Error;
use std::fs;
use std::io::Write;
use std::time::Instant;

use glam::Vec3;
use manylights_scene::Scene;
use manylights_scene::bvh::{Bvh, Ray};

const PASSES: usize = 8;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let scene = room::scene();
    let bvh = Bvh::build(&scene);
    let sets = room::rays(&scene, &bvh);
    match &arguments[..] {
        [] => print_rates(&bvh, &sets),
        [command, file] if command == "export" => export(file, &scene, &sets)?,
        _ => return Err("usage: ray_rates [export FILE]".into()),
    }
    Ok(())
}

fn print_rates(bvh: &Bvh, sets: &[Vec<Ray>; 3]) {
    let closest = |ray: &Ray| bvh.closest(ray).map_or(0.0, |hit| f64::from(hit.t));
    let occluded = |ray: &Ray| f64::from(u8::from(bvh.occluded(ray)));
    let entries = [
        entry(room::SETS[0], &sets[0], closest),
        entry(room::SETS[1], &sets[1], closest),
        entry(room::SETS[2], &sets[2], occluded),
    ];
    println!("{{{}}}", entries.join(", "));
}

fn entry(name: &str, rays: &[Ray], cast: impl Fn(&Ray) -> f64) -> String {
    let (mut best, mut sum) = (f64::INFINITY, 0.0);
    for _ in 0..PASSES {
        let clock = Clock::start();
        sum = rays.iter().map(&cast).sum();
        best = best.min(clock.seconds());
    }
    let rate = rays.len() as f64 / best / 1e6;
    format!(r#""{name}": {{"rate": {rate:.3}, "sum": {sum:.6e}}}"#)
}

/// Processor time of this thread where the system tells it, so that other programs count little;
/// wall-clock time elsewhere.
struct Clock {
    wall: Instant,
    processor: Option<f64>,
}

impl Clock {
    fn start() -> Self {
        Self { wall: Instant::now(), processor: thread_seconds() }
    }

    fn seconds(&self) -> f64 {
        match (self.processor, thread_seconds()) {
            (Some(start), Some(end)) => end - start,
            _ => self.wall.elapsed().as_secs_f64(),
        }
    }
}

fn thread_seconds() -> Option<f64> {
    let text = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_ascii_whitespace().next()?.parse::<f64>().ok()? * 1e-9)
}

fn export(file: &str, scene: &Scene, sets: &[Vec<Ray>; 3]) -> Result<(), Box<dyn Error>> {
    let mut file = std::io::BufWriter::new(fs::File::create(file)?);
    let mut numbers = |numbers: &[f32]| {
        numbers.iter().try_for_each(|number| file.write_all(&number.to_le_bytes()))
    };
    // Counts go through the same door: their bits as those of a number.
    numbers(&[f32::from_bits(scene.triangles.len() as u32)])?;
    for triangle in 0..scene.triangles.len() as u32 {
        scene.corners(triangle).iter().try_for_each(|corner| numbers(&corner.to_array()))?;
    }
    for rays in sets {
        numbers(&[f32::from_bits(rays.len() as u32)])?;
        for Ray { origin, direction, t_min, t_max } in rays {
            let [o, d]: [Vec3; 2] = [*origin, *direction];
            numbers(&[o.x, o.y, o.z, *t_min, d.x, d.y, d.z, *t_max])?;
        }
    }
    Ok(())
}
