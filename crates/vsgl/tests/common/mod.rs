//! Renders a built-in scene on the adapter and with the oracle; single surfaces, texels and lobes.

use std::sync::LazyLock;

use bytemuck::Zeroable;
use glam::{DMat3, DVec3, Vec3};
use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord};
use manylights_harmonics::quadrature::sphere_nodes;
use manylights_method::{Frame, Method, Parameters};
use manylights_metrics::RadianceImage;
use manylights_scene::presets::PRESETS;
use manylights_scene::{Brdf, Scene};
use manylights_scene::{Transport, Visibility};
use manylights_virtual_lights::{LitTexel, VirtualLights, scene_maps};
use manylights_vsgl::{
    Approximation, GaussianLight, GaussianLobe, Settings, Vsgl, gaussian_lights, oracle,
};

pub(crate) static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

pub(crate) const SETTINGS: Settings =
    Settings { lights: 256, texels: 6, lobe: Approximation::Filtered, cut_behind: false };
pub(crate) const THESIS: Settings = Settings { lobe: Approximation::Thesis, ..SETTINGS };
pub(crate) const CUT: Settings = Settings { cut_behind: true, ..SETTINGS };
pub(crate) const VARIANTS: [Settings; 3] = [SETTINGS, THESIS, CUT];

pub(crate) struct Picture {
    pub(crate) image: RadianceImage,
    pub(crate) lights: Vec<GaussianLight>,
    pub(crate) oracle: Vec<DVec3>,
}

pub(crate) fn render(scene: &str, resolution: [u32; 2], settings: &Settings, seed: u64) -> Picture {
    let scene = manylights_scene::load(scene, None).expect("built in");
    render_scene(&scene, resolution, settings, seed)
}

/// A built-in scene with fitted materials, in turn: lobes with the exact Fresnel term.
pub(crate) fn fitted(scene: &str) -> Scene {
    let mut scene = manylights_scene::load(scene, None).expect("built in");
    let presets = FITTED.iter().cycle();
    for (material, name) in scene.materials.iter_mut().zip(presets) {
        *material = material.clone().with_brdf(preset(name));
    }
    scene
}

/// Rough and smooth, of indices 1.05 to 3.8.
pub(crate) const FITTED: [&str; 4] = ["white-fabric", "gold-paint", "teflon", "red-phenolic"];

pub(crate) fn preset(name: &str) -> Brdf {
    PRESETS.iter().find(|preset| preset.name == name).expect("a preset").brdf()
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
    let mut run =
        VirtualLights(Vsgl).prepare(&frame, &parameters(settings)).expect("vsgl renders the scene");
    while !run.step().expect("a step").finished() {}
    let image = run.resolve().expect("a picture");
    let passes: Vec<_> = run.pass_times().iter().map(|time| time.pass).collect();
    assert_eq!(passes, ["distribute", "filter", "place", "gather", "submit"]);

    let surfaces: Vec<SurfaceRecord> = GPU.read(on_gpu.surfaces()).expect("read-back");
    let maps = scene_maps(&on_gpu, scene, settings.lights, seed).expect("maps");
    let (lights, _) = gaussian_lights(&on_gpu, scene, &maps, settings).expect("lights");
    let eye = camera.position.as_dvec3();
    let oracle =
        surfaces.iter().map(|surface| oracle::radiance(surface, eye, &lights, settings)).collect();
    Picture { image, lights, oracle }
}

fn parameters(settings: &Settings) -> Parameters {
    let lobe = match settings.lobe {
        Approximation::Thesis => "thesis",
        Approximation::Filtered => "filtered",
    };
    let texts = [
        ("lights", settings.lights.to_string()),
        ("texels", settings.texels.to_string()),
        ("lobe", lobe.to_owned()),
        ("behind", if settings.cut_behind { "cut" } else { "sent" }.to_owned()),
    ];
    Parameters::new(
        VirtualLights(Vsgl).parameters(),
        texts.iter().map(|(key, value)| (*key, &**value)),
    )
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

pub(crate) fn lobe(position: Vec3, axis: Vec3, sharpness: f32, variance: f32) -> GaussianLobe {
    GaussianLobe {
        position,
        variance,
        axis: axis.normalize(),
        sharpness,
        power: Vec3::ONE,
        padding: 0.0,
    }
}

/// Directions and weights times a Gaussian of amplitude 1 about `axis`.
pub(crate) fn weighted(axis: DVec3, sharpness: f64, count: usize) -> Vec<(DVec3, f64)> {
    let (a, b) = axis.any_orthonormal_pair();
    let frame = DMat3::from_cols(a, b, axis);
    let cut = (1.0 - 12.0 / sharpness).max(-1.0);
    let ranges = [[-1.0, cut], [cut, 1.0]].into_iter().filter(|[low, high]| high > low);
    let nodes = ranges.flat_map(|range| sphere_nodes(count, range));
    nodes
        .map(|(w, weight)| {
            let w = DVec3::from_array(w);
            (frame * w, weight * (-0.5 * sharpness * (w - DVec3::Z).length_squared()).exp())
        })
        .collect()
}

/// At this cosine to z, in the x-z plane.
pub(crate) fn at(cosine: f64) -> DVec3 {
    DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine)
}
