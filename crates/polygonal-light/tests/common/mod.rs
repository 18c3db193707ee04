//! Single surfaces and lights; pictures on the adapter.

use std::sync::LazyLock;

use glam::{DVec3, Quat, Vec3, Vec3Swizzles};
use manylights_area_lights::AreaLights;
use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord};
use manylights_method::{Error, Frame, Method, Parameters};
use manylights_metrics::RadianceImage;
use manylights_polygonal_light::{
    Approximation, Edges, Narrow, PolygonalLights, Settings, TriangleForm,
};
use manylights_scene::{AreaLight, Brdf, Lobe, Scene, Transport, Visibility};

pub(crate) static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

pub(crate) fn settings(form: TriangleForm) -> Settings {
    let approximation = Approximation::Sphere(form);
    Settings { bands: 9, approximation, narrow: Narrow::Decline }
}

pub(crate) fn exact(edges: Edges) -> Settings {
    let approximation = Approximation::Exact(edges);
    Settings { bands: 9, approximation, narrow: Narrow::Decline }
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

/// A specular lobe without its Fresnel term.
pub(crate) fn mirror_like(roughness: f32) -> Brdf {
    Brdf { diffuse: Vec3::ZERO, f0: Vec3::ONE, ..glossy(roughness) }
}

pub(crate) fn surface(position: Vec3, normal: Vec3, brdf: Brdf) -> SurfaceRecord {
    SurfaceRecord::new(position, normal, brdf)
}

/// An oblique frame, so that no coordinate is exact.
pub(crate) fn oblique(v: Vec3) -> Vec3 {
    Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7) * v
}

/// A direction of a spiral over the part of the sphere from z = `lowest` up.
pub(crate) fn spiral(i: u32, count: u32, lowest: f64) -> DVec3 {
    let z = 1.0 - (1.0 - lowest) * (f64::from(i) + 0.5) / f64::from(count);
    let (sin, cos) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
    let r = ((1.0 - z) * (1.0 + z)).sqrt();
    DVec3::new(r * cos, r * sin, z)
}

/// The built-in `trio` under triangles that face its middle, its narrowest lobe widened to roughness 0.3.
pub(crate) fn scene(lights: u32) -> Scene {
    let mut scene = manylights_scene::load("trio", None).expect("built in");
    scene.lights.clear();
    for material in &mut scene.materials {
        material.roughness = material.roughness.max(0.3);
    }
    let triangle = |i: u32| {
        let center = 2.5 * spiral(i, lights, 0.0).as_vec3().xzy();
        let (right, up) = center.normalize().any_orthonormal_pair();
        let size = 0.2 + 0.6 * (i as f32 / lights as f32);
        let corners = [right - up, -right - up, up].map(|corner| center + size * corner);
        let radiance = Vec3::new(1.0, 0.8, 0.6) * (20.0 / lights as f32);
        AreaLight::Triangle { corners, radiance, two_sided: i % 2 == 1 }
    };
    scene.area_lights = (0..lights).map(triangle).collect();
    scene
}

pub(crate) const DIRECT: Transport = Transport::Direct { visibility: Visibility::Ignored };

/// The picture of a scene's first camera, and what its pixels see.
pub(crate) fn render(
    scene: &Scene,
    resolution: [u32; 2],
    texts: &[(&str, &str)],
    transport: Transport,
) -> Result<(RadianceImage, Vec<SurfaceRecord>), Error> {
    let camera = &scene.cameras[0];
    let on_gpu = GpuFrame::new(&GPU, scene, camera, resolution)?;
    let gpu = Some(&on_gpu);
    let frame = Frame { scene, camera, resolution, transport, seed: 0, gpu };
    let method = AreaLights(PolygonalLights);
    let parameters = Parameters::new(method.parameters(), texts.iter().copied());
    let mut run = method.prepare(&frame, &parameters.expect("in range"))?;
    while !run.step()?.finished() {}
    let surfaces = GPU.read(on_gpu.surfaces())?;
    Ok((run.resolve()?, surfaces))
}
