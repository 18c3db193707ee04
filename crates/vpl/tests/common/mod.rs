//! Renders a built-in scene on the adapter and with the oracle.

use std::sync::LazyLock;

use glam::DVec3;
use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord};
use manylights_method::{Frame, Method, Parameters};
use manylights_metrics::RadianceImage;
use manylights_scene::Scene;
use manylights_scene::{Transport, Visibility};
use manylights_virtual_lights::{VirtualLights, distribute, scene_maps};
use manylights_vpl::{Settings, Vpl, oracle};

pub(crate) struct Picture {
    pub(crate) image: RadianceImage,
    pub(crate) oracle: Vec<DVec3>,
}

static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

pub(crate) fn render(scene: &str, resolution: [u32; 2], settings: &Settings) -> Picture {
    render_with_seed(scene, resolution, settings, 0)
}

pub(crate) fn render_with_seed(
    scene: &str,
    resolution: [u32; 2],
    settings: &Settings,
    seed: u64,
) -> Picture {
    let scene = manylights_scene::load(scene, None).expect("built in");
    render_scene(&scene, resolution, settings, seed)
}

pub(crate) fn render_scene(
    scene: &Scene,
    resolution: [u32; 2],
    settings: &Settings,
    seed: u64,
) -> Picture {
    let camera = &scene.cameras[0];
    let on_gpu = GpuFrame::new(&GPU, scene, camera, resolution).expect("the scene fits");
    let frame = Frame {
        scene,
        camera,
        resolution,
        transport: Transport::Indirect { bounces: 1, visibility: Visibility::Ignored },
        seed,
        gpu: Some(&on_gpu),
    };
    let texts = [
        ("lights", settings.lights.to_string()),
        ("clamp", settings.clamp.unwrap_or(0.0).to_string()),
        ("attenuation_radius", settings.attenuation_radius.unwrap_or(0.0).to_string()),
    ];
    let parameters = Parameters::new(
        VirtualLights(Vpl).parameters(),
        texts.iter().map(|(key, value)| (*key, &**value)),
    )
    .expect("in range");
    let mut run = VirtualLights(Vpl).prepare(&frame, &parameters).expect("vpl renders the scene");
    while !run.step().expect("a step").finished() {}
    let image = run.resolve().expect("a picture");

    let surfaces: Vec<SurfaceRecord> = GPU.read(on_gpu.surfaces()).expect("read-back");
    let maps = scene_maps(&on_gpu, scene, settings.lights, seed).expect("maps");
    let (lights, _) = distribute(&on_gpu, scene, &maps).expect("lights");
    let eye = camera.position.as_dvec3();
    let oracle =
        surfaces.iter().map(|surface| oracle::radiance(surface, eye, &lights, settings)).collect();
    Picture { image, oracle }
}
