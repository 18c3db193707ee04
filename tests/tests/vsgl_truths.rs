//! Virtual spherical Gaussian lights against closed forms.

use glam::Vec3;
use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord};
use manylights_method::{Frame, Method, Parameters, Transport, Visibility};
use manylights_scene::builtin::integrating_sphere::{ALBEDO, INTENSITY, RADIUS};
use manylights_vsgl::{Settings, SpecularLobe, Vsgl, gaussian_lights, oracle};

const TRANSPORT: Transport = Transport::Indirect { bounces: 1, visibility: Visibility::Ignored };

/// Mean of the picture over the closed form, less 1, of the adapter and of the oracle: one bounce in a
/// closed Lambertian sphere with a light at its centre is ρ²I/(πR²) everywhere.
fn bias(lights: u64, texels: u32) -> [f64; 2] {
    let scene = manylights_scene::load("integrating-sphere", None).expect("built in");
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let (camera, resolution) = (&scene.cameras[0], [12, 12]);
    let on_gpu = GpuFrame::new(&gpu, &scene, camera, resolution).expect("the scene fits");
    let of_frame = Some(&on_gpu);
    let frame =
        Frame { scene: &scene, camera, resolution, transport: TRANSPORT, seed: 0, gpu: of_frame };
    let texts = [("lights", lights.to_string()), ("texels", texels.to_string())];
    let settings = texts.iter().map(|(key, value)| (*key, &**value));
    let parameters = Parameters::new(Vsgl.parameters(), settings).expect("in range");
    let mut run = Vsgl.prepare(&frame, &parameters).expect("vsgl renders the scene");
    while !run.step().expect("a step").finished() {}
    let image = run.resolve().expect("a picture");

    let settings = Settings { lights, texels, lobe: SpecularLobe::Filtered };
    let (lights, _) = gaussian_lights(&on_gpu, &scene, &settings, 0).expect("lights");
    let surfaces: Vec<SurfaceRecord> = gpu.read(on_gpu.surfaces()).expect("read-back");
    let eye = camera.position.as_dvec3();
    let truth = surfaces.iter().map(|surface| oracle::radiance(surface, eye, &lights, &settings));
    let truth: f64 = truth.map(|radiance| radiance.y).sum();
    let sum: f64 = image.pixels.iter().map(|pixel| Vec3::from(*pixel).as_dvec3().y).sum();

    let expected = ALBEDO * ALBEDO * INTENSITY / (std::f32::consts::PI * RADIUS * RADIUS);
    let bias = [sum, truth].map(|sum| sum / f64::from(expected) / surfaces.len() as f64 - 1.0);
    println!("{} lights of {texels}² texels: {bias:+.4?}", lights.len());
    bias
}

/// In the sphere every receiver sees all lights under all angles, and cos over d² is constant. The
/// lobe of sharpness 2.29 that replaces the cosine, over the constant d²/cos of a sphere, gives
/// ½ ∫ exp(λ(c − 1)) π/I(λ) dc/c·… : the mean over the sphere of lobe/cosine.
#[test]
fn integrating_sphere() {
    for (lights, texels) in [(600, 4), (2400, 4), (2400, 1), (9600, 2)] {
        let [adapter, oracle] = bias(lights, texels);
        assert!((adapter - oracle).abs() < 1e-5, "{adapter} {oracle}");
    }
}
