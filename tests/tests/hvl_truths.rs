//! Harmonics virtual lights against a closed form.

use manylights_gpu::{Gpu, GpuFrame};
use manylights_hvl::Hvl;
use manylights_method::{Frame, Method, Parameters, Transport, Visibility};
use manylights_scene::builtin::integrating_sphere::{ALBEDO, INTENSITY, RADIUS};

/// One bounce in a closed Lambertian sphere with a light at its centre: ρ²I/(πR²) everywhere.
#[test]
fn integrating_sphere() {
    let transport = Transport::Indirect { bounces: 1, visibility: Visibility::Ignored };
    let scene = manylights_scene::load("integrating-sphere", None).expect("built in");
    let expected = ALBEDO * ALBEDO * INTENSITY / (std::f32::consts::PI * RADIUS * RADIUS);
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let camera = &scene.cameras[0];
    let resolution = [32, 32];
    let on_gpu = GpuFrame::new(&gpu, &scene, camera, resolution).expect("the scene fits");
    for radius in ["0", "1", "2", "3"] {
        let scale = if radius == "3" { 0.02 * RADIUS } else { 1.0 };
        let texts = [
            ("lights", "4096".to_owned()),
            ("radius", radius.to_owned()),
            ("scale", scale.to_string()),
        ];
        let parameters =
            Parameters::new(Hvl.parameters(), texts.iter().map(|(key, value)| (*key, &**value)))
                .expect("in range");
        let gpu = Some(&on_gpu);
        let frame = Frame { scene: &scene, camera, resolution, transport, seed: 0, gpu };
        let mut run = Hvl.prepare(&frame, &parameters).expect("hvl renders the scene");
        while !run.step().expect("a step").finished() {}
        let image = run.resolve().expect("a picture");
        let mut values: Vec<_> = image.pixels.iter().map(|pixel| pixel[1]).collect();
        values.sort_by(f32::total_cmp);
        let median = values[values.len() / 2];
        println!("radius {radius}: median {median}, closed form {expected}");
        assert!((median / expected - 1.0).abs() < 0.02, "radius {radius}: {median}, {expected}");
    }
}
