//! Virtual spherical Gaussian lights against closed forms, and their shadows against the host's rays.

use glam::Vec3;
use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord};
use manylights_method::{Frame, Method, Parameters, Transport, Visibility};
use manylights_metrics::RadianceImage;
use manylights_scene::Scene;
use manylights_scene::builtin::integrating_sphere::{ALBEDO, INTENSITY, RADIUS};
use manylights_scene::bvh::Bvh;
use manylights_vsgl::oracle::DIFFUSE_SHARPNESS;
use manylights_vsgl::{Settings, SpecularLobe, Vsgl, gaussian_lights, oracle};

fn settings(lights: u64, texels: u32) -> Settings {
    Settings { lights, texels, lobe: SpecularLobe::Filtered }
}

fn frame_of(scene: &Scene, resolution: [u32; 2]) -> GpuFrame {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    GpuFrame::new(&gpu, scene, &scene.cameras[0], resolution).expect("the scene fits")
}

fn vsgl(
    scene: &Scene,
    on_gpu: &GpuFrame,
    visibility: Visibility,
    settings: &Settings,
) -> RadianceImage {
    let (camera, resolution) = (&scene.cameras[0], on_gpu.resolution());
    let transport = Transport::Indirect { bounces: 1, visibility };
    let frame = Frame { scene, camera, resolution, transport, seed: 0, gpu: Some(on_gpu) };
    let texts = [("lights", settings.lights.to_string()), ("texels", settings.texels.to_string())];
    let texts = texts.iter().map(|(key, value)| (*key, &**value));
    let parameters = Parameters::new(Vsgl.parameters(), texts).expect("in range");
    let mut run = Vsgl.prepare(&frame, &parameters).expect("vsgl renders the scene");
    while !run.step().expect("a step").finished() {}
    run.resolve().expect("a picture")
}

/// Mean of the picture over the closed form, less 1, of the adapter and of the oracle: one bounce in a
/// closed Lambertian sphere with a light at its centre is ρ²I/(πR²) everywhere.
fn bias(lights: u64, texels: u32) -> [f64; 2] {
    let scene = manylights_scene::load("integrating-sphere", None).expect("built in");
    let frame = frame_of(&scene, [12, 12]);
    let settings = settings(lights, texels);
    let image = vsgl(&scene, &frame, Visibility::Ignored, &settings);
    let (lights, _) = gaussian_lights(&frame, &scene, &settings, 0).expect("lights");
    let surfaces: Vec<SurfaceRecord> = frame.gpu().read(frame.surfaces()).expect("a G-buffer");
    let eye = scene.cameras[0].position.as_dvec3();
    let truth = surfaces.iter().map(|surface| oracle::radiance(surface, eye, &lights, &settings));
    let truth: f64 = truth.map(|radiance| radiance.y).sum();
    let sum: f64 = image.pixels.iter().map(|pixel| f64::from(pixel[1])).sum();
    let expected = ALBEDO * ALBEDO * INTENSITY / (std::f32::consts::PI * RADIUS * RADIUS);
    let bias = [sum, truth].map(|sum| sum / f64::from(expected) / surfaces.len() as f64 - 1.0);
    println!("{} lights of {texels}² texels: {bias:+.4?}", lights.len());
    bias
}

/// Point lights in a sphere arrive with cos² over d², which is constant. Here the lobe G/∫G stands for
/// cos/π, and its mean over the sphere, 2∫₀¹ π G/∫G dc = 1/(1 + e^{−λ}), is the lobe's power in front of
/// its surface: closed scenes lose the rest, 9.2 %, and no number of lights brings it back.
#[test]
fn integrating_sphere() {
    let limit = 1.0 / (1.0 + (-DIFFUSE_SHARPNESS).exp()) - 1.0;
    println!("limit {limit:+.4}");
    let mut distances = Vec::new();
    for (lights, texels) in [(150, 4), (600, 4), (2400, 1), (9600, 1)] {
        let [adapter, oracle] = bias(lights, texels);
        assert!((adapter - oracle).abs() < 1e-5, "{adapter} {oracle}");
        distances.push((adapter - limit).abs());
    }
    assert!(distances[3] < 0.02 && distances[3] < distances[0], "{distances:?}");
}

/// As in visibility.rs, for the centres of these lights: every pixel is the oracle's sum over those that
/// the host's rays find visible, up to rays that graze an edge.
#[test]
fn shadows_agree_with_the_host() {
    for name in ["cornell", "trio"] {
        let scene = manylights_scene::load(name, None).expect("built in");
        let frame = frame_of(&scene, [48, 36]);
        let settings = settings(300, 5);
        let picture = vsgl(&scene, &frame, Visibility::Traced, &settings);
        let (lights, _) = gaussian_lights(&frame, &scene, &settings, 0).expect("lights");
        let surfaces: Vec<SurfaceRecord> = frame.gpu().read(frame.surfaces()).expect("a G-buffer");
        let bvh = Bvh::build(&scene);
        let eye = scene.cameras[0].position.as_dvec3();
        let (mut hidden, mut pairs, mut wrong) = (0, 0, 0);
        for (surface, pixel) in surfaces.iter().zip(&picture.pixels) {
            if surface.triangle == SurfaceRecord::NO_TRIANGLE {
                assert_eq!(*pixel, [0.0; 3]);
                continue;
            }
            let front = scene.geometric_normal(surface.triangle);
            let normal = if front.dot(surface.normal) >= 0.0 { front } else { -front };
            let here = [surface.position, normal];
            let sees = |light: &manylights_vsgl::GaussianLight| {
                bvh.sees(here, [light.center, light.geometric_normal])
            };
            let visible: Vec<_> = lights.iter().copied().filter(sees).collect();
            hidden += lights.len() - visible.len();
            pairs += lights.len();
            let expected = oracle::radiance(surface, eye, &visible, &settings).as_vec3();
            let difference = (Vec3::from(*pixel) - expected).abs().max_element();
            wrong += usize::from(difference > 2e-4 * expected.max_element().max(1e-3));
        }
        let share = wrong as f64 / surfaces.len() as f64;
        println!("{name}: {wrong} pixels differ, {hidden} of {pairs} pairs hidden");
        assert!(hidden > pairs / 20 && hidden < pairs, "{hidden} of {pairs} hidden: a weak test");
        assert!(share <= 0.004, "{name}: {wrong} pixels differ");
    }
}
