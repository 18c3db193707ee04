//! Scenes that are declined, each in one line, pictures of many lights, and bakes.

use crate::common::{DIRECT, GPU, render, scene};
use glam::Vec3;
use manylights_area_lights::AreaLights;
use manylights_gpu::GpuFrame;
use manylights_method::{Error, Frame, Method, Parameters};
use manylights_polygonal_light::PolygonalLights;
use manylights_scene::AreaLight;

#[test]
fn what_is_not_the_methods_is_declined() {
    let mut spheres = scene(3);
    let sphere = AreaLight::Sphere { center: Vec3::Y, radius: 0.1, radiance: Vec3::ONE };
    spheres.area_lights.push(sphere);
    let mut narrow = scene(3);
    narrow.materials.iter_mut().for_each(|material| material.roughness = 0.29);
    let cases = [
        (spheres, "takes lights that are triangles; of this scene's 4 lights 1 are others"),
        (narrow.clone(), "narrow=keep"),
    ];
    for (scene, words) in cases {
        match render(&scene, [16, 12], &[], DIRECT) {
            Err(Error::Declined(reason)) => {
                assert!(reason.contains(words) && !reason.contains('\n'), "{reason}");
            }
            Err(error) => panic!("failed: {error}"),
            Ok(_) => panic!("rendered"),
        }
    }
    render(&narrow, [16, 12], &[("narrow", "keep")], DIRECT).expect("kept");
}

/// More lights than a batch holds, of records of either size.
#[test]
fn many_lights_give_the_same_bits_twice() {
    let scene = scene(1200);
    for word in ["main", "scaled"] {
        let texts = [("approximation", word)];
        let picture = || render(&scene, [16, 12], &texts, DIRECT).expect("a picture").0;
        let first = picture();
        assert!(first.pixels.as_flattened().iter().any(|value| *value > 0.0));
        assert!(first == picture());
    }
}

/// Lights without an area are lights of the scene that send nothing.
#[test]
fn lights_without_area_are_black() {
    let mut scene = scene(3);
    let corners = [Vec3::Y, 2.0 * Vec3::Y, 3.0 * Vec3::Y];
    let flat = AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: true };
    scene.area_lights = vec![flat; 2];
    for word in ["main", "point"] {
        let image = render(&scene, [16, 12], &[("approximation", word)], DIRECT);
        let image = image.expect("a picture").0;
        assert!(image.pixels.as_flattened().iter().all(|&value| value == 0.0));
    }
}

#[test]
fn every_bake_makes_all_of_its_tables() {
    let method = AreaLights(PolygonalLights);
    let baking = method.baking().expect("tables");
    let scene = scene(3);
    let (camera, resolution) = (&scene.cameras[0], [16, 12]);
    let on_gpu = GpuFrame::new(&GPU, &scene, camera, resolution).expect("the scene fits");
    let frame =
        Frame { scene: &scene, camera, resolution, transport: DIRECT, seed: 0, gpu: Some(&on_gpu) };
    let made = || {
        let parameters = Parameters::new(method.parameters(), [("bands", "3")]).expect("in range");
        let bake = baking.bake(&frame, &parameters).expect("a bake");
        let counters = bake.counters();
        let mut run = bake.prepare(&frame, &parameters).expect("a run");
        // The run keeps what it needs.
        drop(bake);
        assert_eq!(run.counters(), [("lights", 0)]);
        while !run.step().expect("a step").finished() {}
        assert_eq!(run.counters(), [("lights", 3)]);
        (counters, run.resolve().expect("a picture").pixels)
    };
    let first = made();
    // One a roughness: 0.3, 0.35 and 0.55.
    assert_eq!(first.0, [("tables", 3)]);
    assert_eq!(made(), first);
}
