//! Virtual spherical Gaussian lights against closed forms, and their shadows against the host's rays.

use glam::{DVec3, Vec3};
use manylights_gpu::{Center, Gpu, GpuFrame, Shadows, SurfaceRecord};
use manylights_method::{Frame, Method, Parameters, Transport, Visibility};
use manylights_metrics::RadianceImage;
use manylights_scene::builtin::integrating_sphere::{ALBEDO, INTENSITY, RADIUS};
use manylights_scene::{Brdf, Scene};
use manylights_vsgl::oracle::DIFFUSE_SHARPNESS;
use manylights_vsgl::{GaussianLight, Lobe, Settings, SpecularLobe, Vsgl, gaussian_lights, oracle};

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

/// Irradiance, in units of the exitance, that a plane covered by lights receives from itself: a Gaussian
/// of places is not flat, so half of each lies above the plane. Point lights give none.
fn self_illumination() -> f64 {
    let brdf = Brdf::lambert(Vec3::ONE);
    let lobe = |position| Lobe {
        position,
        // Squares of one metre.
        variance: 1.0 / 12.0,
        axis: Vec3::Y,
        sharpness: DIFFUSE_SHARPNESS as f32,
        power: Vec3::ONE,
        padding: 0.0,
    };
    let places =
        (-40..=40).flat_map(|x| (-40..=40).map(move |z| Vec3::new(x as f32, 0.0, z as f32)));
    let lights: Vec<_> = places
        .map(|center| GaussianLight {
            diffuse: lobe(center),
            specular: Lobe { power: Vec3::ZERO, ..lobe(center) },
            center,
            geometric_normal: Vec3::Y,
        })
        .collect();
    let radiances = (0..36).map(|i| {
        let [x, z] = [i % 6, i / 6].map(|i| (i as f32 + 0.5) / 6.0 - 0.5);
        let surface = SurfaceRecord {
            position: Vec3::new(x, 0.0, z),
            alpha: brdf.alpha,
            normal: Vec3::Y,
            f90: brdf.lobe.slot(),
            diffuse: brdf.diffuse,
            triangle: 0,
            f0: brdf.f0,
            material: 0,
        };
        oracle::radiance(&surface, DVec3::Y, &lights, &settings(1, 1)).y
    });
    radiances.sum::<f64>() / 36.0 * std::f64::consts::PI
}

/// Point lights in a sphere arrive with cos² over d², which is constant. Here the lobe G/∫G stands for
/// cos/π, and its mean over the sphere, 2∫₀¹ π G/∫G dc = 1/(1 + e^{−λ}), is the lobe's power in front of
/// its surface: the rest is lost, 9.2 %. What lights close by add along the surface does not vanish
/// either, since it depends on their number alone. So the bias stays with any number of lights.
#[test]
fn integrating_sphere() {
    let lost = 1.0 / (1.0 + DIFFUSE_SHARPNESS.exp());
    let gained = self_illumination();
    let limit = gained - lost;
    println!("lost {lost:.4}, gained {gained:.4}");
    let biases = [(150, 4), (2400, 4), (9600, 1)].map(|(lights, texels)| bias(lights, texels));
    for [adapter, oracle] in biases {
        assert!((adapter - oracle).abs() < 1e-5, "{adapter} {oracle}");
    }
    // Where the sphere bends away, at √(2Rs), lights close by end: as a share that falls with the fourth
    // root of their number.
    let [few, some, many] = biases.map(|[adapter, _]| (adapter - limit).abs());
    assert!(some < 0.5 * few && many < 0.75 * some && many < 0.02, "{biases:?} {limit}");
}

/// As in visibility.rs, for the centres of these lights.
#[test]
fn pixels_sum_what_they_see() {
    for name in ["cornell", "trio"] {
        let scene = manylights_scene::load(name, None).expect("built in");
        let frame = frame_of(&scene, [32, 24]);
        let settings = settings(300, 5);
        let picture = vsgl(&scene, &frame, Visibility::Traced, &settings);
        let (lights, _) = gaussian_lights(&frame, &scene, &settings, 0).expect("lights");
        let surfaces: Vec<SurfaceRecord> = frame.gpu().read(frame.surfaces()).expect("a G-buffer");
        let centers: Vec<_> =
            lights.iter().map(|light| Center::new(light.center, light.geometric_normal)).collect();
        let shadows = Shadows::new(&frame, &scene).expect("the hierarchy fits");
        let hidden = shadows.hidden_lights(&frame, &centers).expect("a pass");
        let share = hidden.iter().filter(|hidden| **hidden).count() as f64 / hidden.len() as f64;
        assert!(share > 0.05 && share < 0.95, "{share} hidden: a weak test");
        let eye = scene.cameras[0].position.as_dvec3();
        let truth: Vec<_> = (0..surfaces.len())
            .map(|pixel| {
                let pairs = lights.iter().zip(hidden.chunks(surfaces.len()));
                let seen = pairs.filter(|(_, hidden)| !hidden[pixel]).map(|(light, _)| *light);
                oracle::radiance(&surfaces[pixel], eye, &seen.collect::<Vec<_>>(), &settings)
            })
            .collect();
        let peak = truth.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
        for (pixel, truth) in picture.pixels.iter().zip(&truth) {
            let error = (Vec3::from(*pixel).as_dvec3() - truth).abs().max_element();
            assert!(error < 1e-5 * peak, "{name}: {pixel:?}, {truth}");
        }
    }
}
