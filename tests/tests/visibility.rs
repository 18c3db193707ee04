//! Shadow rays on the adapter against the hierarchy of the host, and the reference that methods
//! with traced visibility converge to.

use glam::Vec3;
use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord, distribute};
use manylights_method::{Frame, Method, Parameters, Transport, Visibility};
use manylights_metrics::RadianceImage;
use manylights_path_tracer::Settings;
use manylights_scene::bvh::Bvh;
use manylights_scene::{Light, Scene};
use manylights_vpl::{Vpl, oracle};

const TRACED: Transport = Transport::Indirect { bounces: 1, visibility: Visibility::Traced };

fn vpl(scene: &Scene, on_gpu: &GpuFrame, lights: u64) -> RadianceImage {
    let (camera, resolution) = (&scene.cameras[0], on_gpu.resolution());
    let frame = Frame { scene, camera, resolution, transport: TRACED, seed: 0, gpu: Some(on_gpu) };
    let lights = lights.to_string();
    let parameters = Parameters::new(Vpl.parameters(), [("lights", &*lights)]).expect("in range");
    let mut run = Vpl.prepare(&frame, &parameters).expect("vpl renders the scene");
    while !run.step().expect("a step").finished() {}
    run.resolve().expect("a picture")
}

fn on_gpu(scene: &Scene, resolution: [u32; 2]) -> GpuFrame {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    GpuFrame::new(&gpu, scene, &scene.cameras[0], resolution).expect("the scene fits")
}

/// Every pixel is the oracle's sum over the lights that the host's rays find visible. Roundings of the
/// two walks differ where a ray grazes an edge: the share of other pixels is bounded.
fn shadows_agree(scene: &Scene, lights: u64, other: f64) {
    let frame = on_gpu(scene, [48, 36]);
    let picture = vpl(scene, &frame, lights);
    let (lights, _) = distribute(&frame, scene, lights, 0).expect("lights");
    let surfaces: Vec<SurfaceRecord> = frame.gpu().read(frame.surfaces()).expect("a G-buffer");
    let bvh = Bvh::build(scene);
    let camera = scene.cameras[0].position.as_dvec3();
    let settings = manylights_vpl::Settings { lights: 1, clamp: None, radius: None };
    let (mut hidden, mut pairs, mut wrong) = (0, 0, 0);
    for (surface, pixel) in surfaces.iter().zip(&picture.pixels) {
        if surface.triangle == SurfaceRecord::NO_TRIANGLE {
            assert_eq!(*pixel, [0.0; 3]);
            continue;
        }
        let front = scene.geometric_normal(surface.triangle);
        let normal = if front.dot(surface.normal) >= 0.0 { front } else { -front };
        let visible: Vec<_> = lights
            .iter()
            .filter(|light| {
                bvh.sees([surface.position, normal], [light.position, light.geometric_normal])
            })
            .copied()
            .collect();
        hidden += lights.len() - visible.len();
        pairs += lights.len();
        let expected = oracle::radiance(surface, camera, &visible, &settings).as_vec3();
        let difference = (Vec3::from(*pixel) - expected).abs().max_element();
        wrong += usize::from(difference > 2e-4 * expected.max_element().max(1e-3));
    }
    let share = wrong as f64 / surfaces.len() as f64;
    println!("{}: {wrong} pixels differ, {hidden} of {pairs} pairs hidden", scene.name);
    assert!(hidden > pairs / 20 && hidden < pairs, "{hidden} of {pairs} hidden: a weak test");
    assert!(share <= other, "{}: {wrong} pixels differ", scene.name);
}

#[test]
fn shadows_agree_with_the_host() {
    for name in ["cornell", "cornell-glossy", "trio", "atrium"] {
        let scene = manylights_scene::load(name, None).expect("built in");
        // More than a word and more than a batch.
        shadows_agree(&scene, 300, 0.004);
    }
}

/// All lengths by a factor; radiances stay.
fn scale(scene: &mut Scene, factor: f32) {
    for vertex in &mut scene.vertices {
        vertex.position *= factor;
    }
    for camera in &mut scene.cameras {
        camera.position *= factor;
    }
    for light in &mut scene.lights {
        if let Light::Spot { position, intensity, .. } | Light::Point { position, intensity } =
            light
        {
            *position *= factor;
            *intensity *= factor * factor;
        }
    }
}

#[test]
fn shadows_do_not_depend_on_the_unit_of_length() {
    for factor in [1e-3, 1e4] {
        let mut scene = manylights_scene::load("trio", None).expect("built in");
        scale(&mut scene, factor);
        shadows_agree(&scene, 36, 0.004);
    }
}

/// As without visibility (vpl_truths.rs), towards the reference with shadows.
#[test]
fn converges_to_the_reference() {
    let scene = manylights_scene::load("cornell", None).expect("built in");
    let resolution = [48, 48];
    let settings = Settings { transport: TRACED, resolution, seed: 0, samples: 1024 };
    let reference =
        manylights_path_tracer::render(&scene, &scene.cameras[0], &settings, None, &mut |_| {})
            .expect("a reference");
    let frame = on_gpu(&scene, resolution);
    let errors = [16, 256, 4096].map(|lights| {
        let image = vpl(&scene, &frame, lights);
        manylights_metrics::compare_linear(&image, &reference.image).expect("comparable").rmse
    });
    println!("RMSE {errors:?}, noise floor {}", reference.noise_floor);
    for pair in errors.windows(2) {
        assert!(pair[1] < 0.75 * pair[0], "{errors:?}");
    }
}
