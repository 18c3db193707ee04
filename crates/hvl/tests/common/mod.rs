//! Single surfaces and lights; pictures on the adapter and with the oracle.

use std::sync::LazyLock;

use glam::{DVec3, Quat, Vec3};
use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord};
use manylights_hvl::{
    Horizon, Hvl, Settings, VirtualSphere, gather, oracle, rounded, virtual_spheres,
};
use manylights_method::{Frame, Method, Parameters};
use manylights_metrics::RadianceImage;
use manylights_reflectance::{Damping, Form};
use manylights_scene::{Brdf, Lobe};
use manylights_scene::{Transport, Visibility};
use manylights_virtual_lights::{RadiusRule, VirtualLight, VirtualLights, scene_maps};

pub(crate) static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

pub(crate) const SETTINGS: Settings = Settings {
    lights: 256,
    bands: 5,
    form: Form::Full,
    emission_bands: 0,
    damping: Damping::None,
    radius: RadiusRule::FieldOfView,
    scale: 1.0,
    horizon: Horizon::Smooth,
};

pub(crate) const FORMS: [Form; 2] = [Form::Full, Form::Zonal];

pub(crate) struct Picture {
    pub(crate) image: RadianceImage,
    pub(crate) surfaces: Vec<SurfaceRecord>,
    pub(crate) eye: DVec3,
    pub(crate) lights: Vec<VirtualSphere>,
}

impl Picture {
    /// By the oracle, negative pixels shown as 0.
    pub(crate) fn oracle(&self, settings: &Settings) -> Vec<DVec3> {
        let truth = |surface| oracle::radiance(surface, self.eye, &self.lights, settings);
        self.surfaces.iter().map(|surface| truth(surface).max(DVec3::ZERO)).collect()
    }
}

/// A picture with the parameters as texts, and with the settings that they mean.
pub(crate) fn render(
    scene: &str,
    resolution: [u32; 2],
    texts: &[(&str, &str)],
    settings: &Settings,
    visibility: Visibility,
    seed: u64,
) -> Picture {
    let scene = manylights_scene::load(scene, None).expect("built in");
    let camera = &scene.cameras[0];
    let on_gpu = GpuFrame::new(&GPU, &scene, camera, resolution).expect("the scene fits");
    let frame = Frame {
        scene: &scene,
        camera,
        resolution,
        transport: Transport::Indirect { bounces: 1, visibility },
        seed,
        gpu: Some(&on_gpu),
    };
    let parameters =
        Parameters::new(VirtualLights(Hvl).parameters(), texts.iter().copied()).expect("in range");
    let mut run = VirtualLights(Hvl).prepare(&frame, &parameters).expect("hvl renders the scene");
    while !run.step().expect("a step").finished() {}
    let image = run.resolve().expect("a picture");
    let surfaces = GPU.read(on_gpu.surfaces()).expect("read-back");
    let maps = scene_maps(&on_gpu, &scene, settings.lights, seed).expect("maps");
    let (lights, _) = virtual_spheres(&on_gpu, &scene, &maps, settings).expect("lights");
    Picture { image, surfaces, eye: camera.position.as_dvec3(), lights }
}

pub(crate) fn glossy(roughness: f32) -> Brdf {
    Brdf {
        diffuse: Vec3::new(0.5, 0.3, 0.2),
        f0: Vec3::splat(0.04),
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    }
}

pub(crate) fn metal(roughness: f32) -> Brdf {
    Brdf { diffuse: Vec3::ZERO, f0: Vec3::new(0.9, 0.7, 0.4), ..glossy(roughness) }
}

/// The exact Fresnel term, as fitted materials have it.
pub(crate) fn dielectric(roughness: f32) -> Brdf {
    let f0 = Vec3::new(0.05, 0.04, 0.03);
    Brdf { f0, lobe: Lobe::Dielectric { index: 1.43 }, ..glossy(roughness) }
}

pub(crate) fn surface(position: Vec3, normal: Vec3, brdf: Brdf) -> SurfaceRecord {
    SurfaceRecord::new(position, normal, brdf)
}

pub(crate) fn light(position: Vec3, normal: Vec3, brdf: Brdf, radius: f32) -> VirtualSphere {
    let incoming = (normal + 0.5 * normal.any_orthonormal_vector()).normalize();
    let flux = Vec3::ONE;
    let light = VirtualLight { position, geometric_normal: normal, normal, incoming, flux, brdf };
    rounded(&VirtualSphere { light, radius })
}

/// An oblique frame, so that no coordinate is exact.
pub(crate) fn oblique(v: Vec3) -> Vec3 {
    Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7) * v
}

/// A direction of a spiral over the sphere.
pub(crate) fn spiral(i: u32, count: u32) -> Vec3 {
    let z = (i as f32 + 0.5) / count as f32 * 2.0 - 1.0;
    let (sin, cos) = (i as f32 * 2.399_963).sin_cos();
    let r = (1.0 - z * z).sqrt();
    Vec3::new(r * cos, r * sin, z)
}

/// Receivers around the origin, where a light shines up.
fn receivers(brdf: Brdf, camera: Vec3) -> Vec<SurfaceRecord> {
    (0..512)
        .map(|i| {
            let place = spiral(i, 512) * (0.2 + 0.01 * i as f32);
            surface(oblique(place), oblique(spiral((i * 197) % 512, 512)), brdf)
        })
        .filter(|surface| surface.normal.dot(camera - surface.position) > 0.0)
        .collect()
}

/// Largest difference to the oracle over all receivers, relative to the largest true radiance.
pub(crate) fn worst(receiver: Brdf, sphere: &VirtualSphere, settings: &Settings) -> f64 {
    let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
    let surfaces = receivers(receiver, camera);
    let pixels = gather(&GPU, &surfaces, camera, &[*sphere], settings).expect("a gather");
    let (mut peak, mut worst): (f64, f64) = (0.0, 0.0);
    for (surface, pixel) in surfaces.iter().zip(pixels) {
        let truth = oracle::radiance(surface, camera.as_dvec3(), &[*sphere], settings);
        let pixel = Vec3::from(pixel);
        assert!(pixel.is_finite(), "{surface:?} {sphere:?}: {pixel}");
        peak = peak.max(truth.abs().max_element());
        worst = worst.max((pixel.as_dvec3() - truth).abs().max_element());
    }
    assert!(peak > 0.0, "nothing arrives");
    worst / peak
}
