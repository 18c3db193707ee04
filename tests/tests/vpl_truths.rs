//! Virtual point lights against closed forms and against the reference that they converge to.

use glam::Vec3;
use manylights_gpu::{Gpu, GpuFrame};
use manylights_method::{Frame, Method, Parameters, Transport, Visibility};
use manylights_metrics::RadianceImage;
use manylights_path_tracer::Settings;
use manylights_scene::builtin::integrating_sphere::{ALBEDO, INTENSITY, RADIUS};
use manylights_scene::{Light, Scene};
use manylights_vpl::Vpl;

const TRANSPORT: Transport = Transport::Indirect { bounces: 1, visibility: Visibility::Ignored };

fn vpl(scene: &Scene, resolution: [u32; 2], lights: u64) -> RadianceImage {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let camera = &scene.cameras[0];
    let on_gpu = GpuFrame::new(&gpu, scene, camera, resolution).expect("the scene fits");
    let gpu = Some(&on_gpu);
    let frame = Frame { scene, camera, resolution, transport: TRANSPORT, seed: 0, gpu };
    let lights = lights.to_string();
    let parameters = Parameters::new(Vpl.parameters(), [("lights", &*lights)]).expect("in range");
    let mut run = Vpl.prepare(&frame, &parameters).expect("vpl renders the scene");
    while !run.step().expect("a step").finished() {}
    run.resolve().expect("a picture")
}

/// One bounce in a closed Lambertian sphere with a light at its centre: ρ²I/(πR²) everywhere.
#[test]
fn integrating_sphere() {
    let scene = manylights_scene::load("integrating-sphere", None).expect("built in");
    let expected = ALBEDO * ALBEDO * INTENSITY / (std::f32::consts::PI * RADIUS * RADIUS);
    let image = vpl(&scene, [64, 64], 4096);
    let mut values: Vec<_> = image.pixels.iter().map(|pixel| pixel[1]).collect();
    values.sort_by(f32::total_cmp);
    let median = values[values.len() / 2];
    println!("median {median}, closed form {expected}");
    assert!((median / expected - 1.0).abs() < 0.01, "median {median}, closed form {expected}");
}

/// On a Lambertian scene the error falls with the count, towards the reference whose last segment
/// ignores visibility.
///
/// Lights lie on a grid of spacing h ∝ count^(−1/2). Pixels within h of a light see its 1/d² instead
/// of the mean over its cell: a share ∝ h of those next to edges is wrong by as much as it is bright,
/// so the RMSE falls with h^(1/2), to a half for 16 times the lights. The bound leaves a factor 1.5.
#[test]
fn converges_to_the_reference_without_visibility() {
    converges(&manylights_scene::load("cornell", None).expect("built in"));
}

#[test]
fn converges_in_parallel_light() {
    let mut scene = manylights_scene::load("cornell", None).expect("built in");
    // Through the open front.
    let direction = Vec3::new(0.3, -0.5, -1.0).normalize();
    scene.lights = vec![Light::Directional { direction, irradiance: Vec3::splat(3.0) }];
    converges(&scene);
}

fn converges(scene: &Scene) {
    let resolution = [48, 48];
    let settings = Settings { transport: TRANSPORT, resolution, seed: 0, samples: 2048 };
    let reference =
        manylights_path_tracer::render(scene, &scene.cameras[0], &settings, None, &mut |_| {})
            .expect("a reference");
    let errors = [64, 1024, 16_384, 262_144].map(|lights| {
        let image = vpl(scene, resolution, lights);
        manylights_metrics::compare_linear(&image, &reference.image).expect("comparable").rmse
    });
    println!("RMSE {errors:?}, noise floor {}", reference.noise_floor);
    for pair in errors.windows(2) {
        assert!(pair[1] < 0.75 * pair[0], "{errors:?}");
    }
    assert!(errors[3] < 2.0 * reference.noise_floor, "{errors:?}, {}", reference.noise_floor);
}
