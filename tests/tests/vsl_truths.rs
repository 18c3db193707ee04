//! Virtual spherical lights against closed forms.

use manylights_gpu::{Gpu, GpuFrame};
use manylights_method::{Frame, Method, Parameters, Transport, Visibility};
use manylights_metrics::RadianceImage;
use manylights_scene::builtin::integrating_sphere::{ALBEDO, INTENSITY, RADIUS};
use manylights_vsl::Vsl;

const TRANSPORT: Transport = Transport::Indirect { bounces: 1, visibility: Visibility::Ignored };

fn vsl(scene: &str, settings: &[(&str, &str)]) -> RadianceImage {
    let scene = manylights_scene::load(scene, None).expect("built in");
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let (camera, resolution) = (&scene.cameras[0], [16, 16]);
    let on_gpu = GpuFrame::new(&gpu, &scene, camera, resolution).expect("the scene fits");
    let gpu = Some(&on_gpu);
    let frame = Frame { scene: &scene, camera, resolution, transport: TRANSPORT, seed: 0, gpu };
    let parameters = Parameters::new(Vsl.parameters(), settings.iter().copied()).expect("in range");
    let mut run = Vsl.prepare(&frame, &parameters).expect("vsl renders the scene");
    while !run.step().expect("a step").finished() {}
    run.resolve().expect("a picture")
}

/// Mean of the picture over the closed form, less 1: one bounce in a closed Lambertian sphere with a
/// light at its centre is ρ²I/(πR²) everywhere.
fn bias(lights: &str, samples: &str, sampling: &str, radius: &str) -> f32 {
    let expected = ALBEDO * ALBEDO * INTENSITY / (std::f32::consts::PI * RADIUS * RADIUS);
    let settings =
        [("lights", lights), ("samples", samples), ("sampling", sampling), ("radius", radius)];
    let image = vsl("integrating-sphere", &settings);
    let sum: f32 = image.pixels.iter().map(|pixel| pixel[1]).sum();
    let bias = sum / image.pixels.len() as f32 / expected - 1.0;
    println!("{lights} lights, radius {radius}, sampling {sampling}: {bias:+.2e}");
    bias
}

/// Spheres darken concave surfaces: of the directions to a light at distance d, a share is below one
/// of the two horizons where d² < 2rR, which holds for a part ∝ r/R of the lights. So the bias is of
/// first order in r, −4/(3π) r/R, halves with four times the lights, and 2 % needs radii of R/20.
#[test]
fn integrating_sphere() {
    let [coarse, fine] = ["2048", "32768"].map(|lights| bias(lights, "4", "1", "2"));
    // Six maps of 19² cells: r/R by thesis 5.10 and 5.12.
    let angle = std::f32::consts::SQRT_2 * std::f32::consts::FRAC_PI_2 / 19.0;
    let expected = -4.0 / (3.0 * std::f32::consts::PI) * (angle + angle.powi(3) / 3.0);
    assert!((coarse / expected - 1.0).abs() < 0.15, "{coarse}, {expected}");
    assert!((3.0..5.0).contains(&(coarse / fine)), "{coarse}, {fine}");
    for (sampling, radius) in [("1", "0"), ("1", "1"), ("0", "2"), ("2", "2")] {
        let bias = bias("32768", "4", sampling, radius);
        assert!(bias.abs() < 0.02, "sampling {sampling}, radius {radius}: {bias}");
    }
    assert!(fine.abs() < 0.02, "{fine}");
}
