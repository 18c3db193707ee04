//! Renders a built-in scene on the adapter and with the oracle; single surfaces and lights.

use std::sync::LazyLock;

use glam::{DVec3, Vec3};
use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord};
use manylights_method::{Frame, Method, Parameters};
use manylights_metrics::RadianceImage;
use manylights_scene::{Brdf, Lobe};
use manylights_scene::{Transport, Visibility};
use manylights_virtual_lights::{RadiusRule, VirtualLight, VirtualLights, scene_maps};
use manylights_vsl::{Sampling, Settings, VirtualSphere, Vsl, oracle, virtual_spheres};

pub(crate) static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

pub(crate) const SETTINGS: Settings = Settings {
    lights: 256,
    directions: 9,
    sampling: Sampling::Both,
    radius: RadiusRule::FieldOfView,
    scale: 1.0,
};

pub(crate) struct Picture {
    pub(crate) image: RadianceImage,
    pub(crate) surfaces: Vec<SurfaceRecord>,
    pub(crate) eye: DVec3,
    pub(crate) lights: Vec<VirtualSphere>,
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
    let parameters = parameters(settings);
    let mut run = VirtualLights(Vsl).prepare(&frame, &parameters).expect("vsl renders the scene");
    while !run.step().expect("a step").finished() {}
    let image = run.resolve().expect("a picture");
    let passes: Vec<_> = run.pass_times().iter().map(|time| time.pass).collect();
    assert_eq!(passes, ["distribute", "radius", "place", "gather", "submit"]);

    let surfaces: Vec<SurfaceRecord> = GPU.read(on_gpu.surfaces()).expect("read-back");
    let maps = scene_maps(&on_gpu, &scene, settings.lights, seed).expect("maps");
    let (lights, _) = virtual_spheres(&on_gpu, &scene, &maps, settings).expect("lights");
    let eye = camera.position.as_dvec3();
    let truth = |(pixel, surface)| oracle::radiance(pixel, surface, eye, &lights, settings, seed);
    let oracle = surfaces.iter().enumerate().map(truth).collect();
    Picture { image, surfaces, eye, lights, oracle }
}

fn parameters(settings: &Settings) -> Parameters {
    let sampling = match settings.sampling {
        Sampling::Brdf => "brdf",
        Sampling::Cone => "cone",
        Sampling::Both => "both",
    };
    let radius = match settings.radius {
        RadiusRule::NearestNeighbours => "neighbours",
        RadiusRule::MapNeighbours => "r1",
        RadiusRule::FieldOfView => "r2",
        RadiusRule::Fixed => "fixed",
    };
    let texts = [
        ("lights", settings.lights.to_string()),
        ("directions", settings.directions.to_string()),
        ("sampling", sampling.to_owned()),
        ("radius", radius.to_owned()),
        ("scale", settings.scale.to_string()),
    ];
    Parameters::new(
        VirtualLights(Vsl).parameters(),
        texts.iter().map(|(key, value)| (*key, &**value)),
    )
    .expect("in range")
}

pub(crate) fn light(position: Vec3, normal: Vec3, brdf: Brdf, radius: f32) -> VirtualSphere {
    let incoming = (normal + 0.5 * normal.any_orthonormal_vector()).normalize();
    let (geometric_normal, flux) = (normal, Vec3::ONE);
    // Tells the two normals apart.
    let normal = (normal + 0.2 * normal.any_orthonormal_vector()).normalize();
    let light = VirtualLight { position, geometric_normal, normal, incoming, flux, brdf };
    VirtualSphere { light, radius }
}

pub(crate) fn glossy(roughness: f32) -> Brdf {
    Brdf {
        diffuse: Vec3::splat(0.5),
        f0: Vec3::splat(0.04),
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    }
}
