//! Virtual lights with shadows: every pixel sums what its shadow rays let through, and converges to the
//! reference with shadows.

use glam::Vec3;
use manylights_gpu::{Center, Gpu, GpuFrame, Shadows, SurfaceRecord, distribute};
use manylights_method::{Frame, Method, Parameters, Transport, Visibility};
use manylights_metrics::RadianceImage;
use manylights_path_tracer::Settings;
use manylights_scene::Scene;
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

/// On Lambertian and on glossy surfaces, with more lights than a batch of shadow rays.
#[test]
fn pixels_sum_what_they_see() {
    for name in ["cornell", "trio"] {
        let scene = manylights_scene::load(name, None).expect("built in");
        let frame = on_gpu(&scene, [32, 24]);
        let picture = vpl(&scene, &frame, 400);
        let (lights, _) = distribute(&frame, &scene, 400, 0).expect("lights");
        // The kernel gathers those on Lambertian surfaces first, but a sum has no order.
        let centers: Vec<_> = lights.iter().map(Center::from).collect();
        let shadows = Shadows::new(&frame, &scene).expect("the hierarchy fits");
        let hidden = shadows.hidden_lights(&frame, &centers).expect("a pass");
        let surfaces: Vec<SurfaceRecord> = frame.gpu().read(frame.surfaces()).expect("a G-buffer");
        let eye = scene.cameras[0].position.as_dvec3();
        let settings = manylights_vpl::Settings { lights: 1, clamp: None, radius: None };
        let truth: Vec<_> = (0..surfaces.len())
            .map(|pixel| {
                let seen = lights.iter().zip(hidden.chunks(surfaces.len()));
                let seen = seen.filter(|(_, hidden)| !hidden[pixel]).map(|(light, _)| *light);
                oracle::radiance(&surfaces[pixel], eye, &seen.collect::<Vec<_>>(), &settings)
            })
            .collect();
        let peak = truth.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
        assert!(peak > 0.0);
        for (pixel, truth) in picture.pixels.iter().zip(&truth) {
            let error = (Vec3::from(*pixel).as_dvec3() - truth).abs().max_element();
            assert!(error < 1e-5 * peak, "{name}: {pixel:?}, {truth}");
        }
    }
}

/// As without visibility (vpl_truths.rs). The mean absolute error, since single pixels next to an edge
/// make the RMSE of so few lights a matter of chance.
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
        manylights_metrics::compare_linear(&image, &reference.image).expect("comparable").mae
    });
    println!("mean absolute errors {errors:?}, noise floor {}", reference.noise_floor);
    for pair in errors.windows(2) {
        assert!(pair[1] < 0.5 * pair[0], "{errors:?}");
    }
}
