//! Renders a built-in scene on the adapter and with the oracle; single surfaces, texels and lobes.
#![allow(dead_code, reason = "each test uses its part")]

use std::sync::LazyLock;

use bytemuck::Zeroable;
use glam::{DVec3, Vec3};
use manylights_gpu::{Gpu, GpuFrame, LitTexel, SurfaceRecord};
use manylights_method::{Frame, Method, Parameters, Transport, Visibility};
use manylights_metrics::RadianceImage;
use manylights_scene::Brdf;
use manylights_vsgl::{GaussianLight, Lobe, Settings, SpecularLobe, Vsgl, gaussian_lights, oracle};

pub(crate) static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

pub(crate) const SETTINGS: Settings =
    Settings { lights: 256, texels: 6, lobe: SpecularLobe::Filtered };
pub(crate) const LOBES: [SpecularLobe; 2] = [SpecularLobe::Anisotropic, SpecularLobe::Filtered];

pub(crate) struct Picture {
    pub(crate) image: RadianceImage,
    pub(crate) surfaces: Vec<SurfaceRecord>,
    pub(crate) eye: DVec3,
    pub(crate) lights: Vec<GaussianLight>,
    pub(crate) oracle: Vec<DVec3>,
}

pub(crate) fn render(scene: &str, resolution: [u32; 2], settings: &Settings, seed: u64) -> Picture {
    let scene = manylights_scene::load(scene, None).expect("built in");
    let camera = &scene.cameras[0];
    let on_gpu = GpuFrame::new(&GPU, &scene, camera, resolution).expect("the scene fits");
    let frame = Frame {
        scene: &scene,
        camera,
        resolution,
        transport: Transport::Indirect { bounces: 1, visibility: Visibility::Ignored },
        seed,
        gpu: Some(&on_gpu),
    };
    let mut run = Vsgl.prepare(&frame, &parameters(settings)).expect("vsgl renders the scene");
    while !run.step().expect("a step").finished() {}
    let image = run.resolve().expect("a picture");
    let passes: Vec<_> = run.pass_times().iter().map(|time| time.pass).collect();
    assert_eq!(passes, ["distribute", "filter", "gather"]);

    let surfaces: Vec<SurfaceRecord> = GPU.read(on_gpu.surfaces()).expect("read-back");
    let (lights, _) = gaussian_lights(&on_gpu, &scene, settings, seed).expect("lights");
    let eye = camera.position.as_dvec3();
    let oracle =
        surfaces.iter().map(|surface| oracle::radiance(surface, eye, &lights, settings)).collect();
    Picture { image, surfaces, eye, lights, oracle }
}

fn parameters(settings: &Settings) -> Parameters {
    let lobe = match settings.lobe {
        SpecularLobe::Anisotropic => "0",
        SpecularLobe::Filtered => "1",
    };
    let texts = [
        ("lights", settings.lights.to_string()),
        ("texels", settings.texels.to_string()),
        ("lobe", lobe.to_owned()),
    ];
    Parameters::new(Vsgl.parameters(), texts.iter().map(|(key, value)| (*key, &**value)))
        .expect("in range")
}

pub(crate) fn surface(position: Vec3, normal: Vec3, brdf: Brdf) -> SurfaceRecord {
    let Brdf { diffuse, f0, lobe, alpha } = brdf;
    let f90 = lobe.slot();
    SurfaceRecord { position, alpha, normal, f90, diffuse, triangle: 0, f0, material: 0 }
}

pub(crate) fn glossy(roughness: f32) -> Brdf {
    Brdf {
        diffuse: Vec3::splat(0.5),
        f0: Vec3::splat(0.04),
        lobe: manylights_scene::Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    }
}

/// A texel on a flat surface, lit by one watt.
pub(crate) fn texel(
    position: Vec3,
    normal: Vec3,
    incoming: Vec3,
    brdf: Brdf,
) -> (SurfaceRecord, LitTexel) {
    let lit = LitTexel {
        flux: Vec3::ONE,
        variance: 0.0,
        incoming,
        padding0: 0.0,
        geometric_normal: normal,
        padding1: 0.0,
    };
    (surface(position, normal, brdf), lit)
}

pub(crate) fn empty() -> (SurfaceRecord, LitTexel) {
    let mut nothing = (SurfaceRecord::zeroed(), LitTexel::zeroed());
    nothing.0.triangle = SurfaceRecord::NO_TRIANGLE;
    nothing
}

pub(crate) fn lobe(position: Vec3, axis: Vec3, sharpness: f32, variance: f32) -> Lobe {
    Lobe { position, variance, axis: axis.normalize(), sharpness, power: Vec3::ONE, padding: 0.0 }
}
