//! How many cells carry a light, and which.

use glam::Vec3;
use manylights_gpu::{Gpu, GpuFrame};
use manylights_scene::{Light, Scene};
use manylights_virtual_lights::{VirtualLight, distribute, scene_maps};

const SCENES: [&str; 4] = ["cornell", "cornell-glossy", "trio", "atrium"];

fn load(name: &str) -> Scene {
    manylights_scene::load(name, None).expect("built in")
}

fn lights(gpu: &Gpu, scene: &Scene, count: u64, seed: u64) -> Vec<VirtualLight> {
    let frame = GpuFrame::new(gpu, scene, &scene.cameras[0], [4, 4]).expect("fits");
    let maps = scene_maps(&frame, scene, count, seed).expect("maps");
    distribute(&frame, scene, &maps).expect("lights").0
}

/// By how much the number of lights misses what was asked for, as a part of it.
fn missed(gpu: &Gpu, scene: &Scene, count: u64, seed: u64) -> f64 {
    let found = lights(gpu, scene, count, seed).len() as f64;
    (found / count as f64 - 1.0).abs()
}

#[test]
fn as_many_lights_as_asked_for() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    for scene in SCENES.map(load) {
        for (count, seed) in
            [100, 400, 1928, 10_000].iter().flat_map(|n| [0, 1, 2, 3].map(|s| (*n, s)))
        {
            let missed = missed(&gpu, &scene, count, seed);
            assert!(missed <= 0.02, "{} {count} {seed}: {missed}", scene.name);
        }
        // Beyond what is counted while maps are sought.
        assert!(missed(&gpu, &scene, 40_000, 1) <= 0.02, "{}", scene.name);
    }
}

/// Each primary light gets its part of them.
#[test]
fn as_many_of_several_lights() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let mut scene = load("cornell");
    let direction = Vec3::new(0.2, -0.3, -1.0).normalize();
    scene.lights.push(Light::Directional { direction, irradiance: Vec3::ONE });
    scene.lights.push(scene.lights[0]);
    for (count, seed) in [(401, 0), (2000, 3)] {
        assert!(missed(&gpu, &scene, count, seed) <= 0.02, "{count} {seed}");
        let found = lights(&gpu, &scene, count, seed);
        let parallel = found.iter().filter(|light| light.incoming == -direction).count();
        assert!(
            (3.0 * parallel as f64 / count as f64 - 1.0).abs() <= 0.03,
            "{parallel} of {count}"
        );
    }
    // Of each at least one.
    assert_eq!(lights(&gpu, &scene, 1, 0).len(), 3);
}

/// All cells of a cube in a closed room are lit, and six faces have whole ones.
#[test]
fn a_cube_has_whole_cells() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let scene = load("integrating-sphere");
    let found = [100, 400, 1928, 10_000].map(|count| lights(&gpu, &scene, count, 1).len());
    assert_eq!(found, [6 * 4 * 4, 6 * 8 * 8, 6 * 18 * 18, 6 * 41 * 41]);
}

/// However many there are and however far their maps reach beyond what is lit.
#[test]
fn lights_carry_the_same_flux() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    for scene in SCENES.map(load) {
        let flux = |count, seed| {
            let lights = lights(&gpu, &scene, count, seed);
            lights.iter().map(|light| f64::from(light.flux.y)).sum::<f64>()
        };
        let all = flux(10_000, 0);
        for (count, seed) in [(400, 0), (400, 1), (1928, 2), (1928, 3)] {
            let found = flux(count, seed);
            assert!(
                (found / all - 1.0).abs() < 0.05,
                "{} {count} {seed}: {found} {all}",
                scene.name
            );
        }
    }
}

#[test]
fn the_same_lights_again() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let scene = load("trio");
    let bits = |_| {
        let lights = lights(&gpu, &scene, 400, 2);
        lights.iter().map(|light| light.position.to_array().map(f32::to_bits)).collect::<Vec<_>>()
    };
    assert_eq!(bits(0), bits(1));
}

/// A spot that looks away keeps a map of as many cells; one that is so far that its cone is nearly empty
/// has no more than 64 for each light.
#[test]
fn where_nearly_nothing_is_lit() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let mut scene = load("cornell");
    let spot = |position, direction| Light::Spot {
        position,
        direction,
        intensity: Vec3::ONE,
        inner: 0.5,
        outer: 0.6,
    };
    let cells = |scene: &Scene| {
        let frame = GpuFrame::new(&gpu, scene, &scene.cameras[0], [4, 4]).expect("fits");
        let maps = scene_maps(&frame, scene, 400, 0).expect("maps");
        let (lights, _) = distribute(&frame, scene, &maps).expect("lights");
        (maps[0].projection.resolution, lights.len())
    };
    scene.lights = vec![spot(Vec3::new(0.0, 0.0, 50.0), Vec3::Z)];
    assert_eq!(cells(&scene), ([20, 20], 0));
    scene.lights = vec![spot(Vec3::new(0.0, 0.0, 50.0), Vec3::NEG_Z)];
    let (resolution, lights) = cells(&scene);
    assert_eq!(resolution, [160, 160]);
    assert!((1..100).contains(&lights), "{lights}");
}
