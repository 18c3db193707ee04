//! Shadow rays on the adapter against the hierarchy of the host.

use manylights_gpu::{Center, Gpu, GpuFrame, Shadows, SurfaceRecord};
use manylights_scene::bvh::Bvh;
use manylights_scene::{Light, Scene};
use manylights_virtual_lights::{distribute, scene_maps};

/// Share of pairs of pixel and light on which the two walks disagree. Their roundings differ where a ray
/// grazes an edge.
fn disagreement(scene: &Scene, resolution: [u32; 2], lights: u64) -> f64 {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let frame = GpuFrame::new(&gpu, scene, &scene.cameras[0], resolution).expect("it fits");
    let maps = scene_maps(&frame, scene, lights, 1).expect("maps");
    let (lights, _) = distribute(&frame, scene, &maps).expect("lights");
    let centers: Vec<_> = lights.iter().map(Center::from).collect();
    let shadows = Shadows::new(&frame, scene).expect("the hierarchy fits");
    let occluded = shadows.occluded_lights(&centers).expect("a pass");
    let surfaces: Vec<SurfaceRecord> = gpu.read(frame.surfaces()).expect("a G-buffer");
    assert_eq!(occluded.len(), surfaces.len() * lights.len());
    let bvh = Bvh::build(scene);
    let (mut dark, mut wrong) = (0, 0);
    for (light, occluded) in lights.iter().zip(occluded.chunks(surfaces.len())) {
        let to = [light.position, light.geometric_normal];
        for (surface, &occluded) in surfaces.iter().zip(occluded) {
            let expected = surface.triangle == SurfaceRecord::NO_TRIANGLE || {
                let front = scene.geometric_normal(surface.triangle);
                let normal = if front.dot(surface.normal) >= 0.0 { front } else { -front };
                !bvh.sees([surface.position, normal], to)
            };
            dark += usize::from(occluded);
            wrong += usize::from(occluded != expected);
        }
    }
    let share = |count: usize| count as f64 / occluded.len() as f64;
    println!("{}: {} occluded, {:e} disagree", scene.name, share(dark), share(wrong));
    assert!(share(dark) > 0.05 && share(dark) < 0.95, "a weak test: {dark} occluded");
    share(wrong)
}

#[test]
fn agree_with_the_host() {
    for name in ["cornell", "cornell-glossy", "trio", "atrium"] {
        let scene = manylights_scene::load(name, None).expect("built in");
        // More than a batch of 256.
        let share = disagreement(&scene, [48, 36], 400);
        assert!(share < 1e-3, "{name}: {share}");
    }
}

/// Above 2¹⁹ pixels a batch has one word.
#[test]
fn agree_in_large_pictures() {
    let scene = manylights_scene::load("cornell", None).expect("built in");
    let share = disagreement(&scene, [1024, 520], 5);
    assert!(share < 1e-3, "{share}");
}

#[test]
fn do_not_depend_on_the_unit_of_length() {
    for factor in [1e-3, 1e4] {
        let mut scene = manylights_scene::load("trio", None).expect("built in");
        for vertex in &mut scene.vertices {
            vertex.position *= factor;
        }
        for camera in &mut scene.cameras {
            camera.position *= factor;
        }
        for light in &mut scene.lights {
            if let Light::Spot { position, .. } = light {
                *position *= factor;
            }
        }
        let share = disagreement(&scene, [48, 36], 64);
        assert!(share < 1e-3, "{factor}: {share}");
    }
}
