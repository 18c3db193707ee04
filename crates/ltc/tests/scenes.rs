//! Whole pictures, and what is declined.

use crate::common::{GPU, glossy, spiral};
use glam::{Vec3, Vec3Swizzles};
use manylights_area_lights::AreaLights;
use manylights_gpu::{GpuFrame, SurfaceRecord};
use manylights_ltc::{LightRecord, Ltc, oracle};
use manylights_method::{Error, Frame, Method, Parameters};
use manylights_metrics::RadianceImage;
use manylights_scene::{AreaLight, Brdf, Lobe, Scene, Transport, Visibility};

/// The built-in `trio` under triangles and spheres.
fn scene() -> Scene {
    let mut scene = manylights_scene::load("trio", None).expect("built in");
    scene.lights.clear();
    let light = |i: u32| {
        let center = 2.5 * spiral(i, 6, 0.0).as_vec3().xzy();
        let radiance = Vec3::new(4.0, 3.0, 2.0);
        if i.is_multiple_of(2) {
            return AreaLight::Sphere { center, radius: 0.1 + 0.1 * i as f32, radiance };
        }
        let corners = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| center + 0.6 * axis);
        AreaLight::Triangle { corners, radiance, two_sided: i == 3 }
    };
    scene.area_lights = (0..6).map(light).collect();
    scene
}

fn render(scene: &Scene) -> Result<(RadianceImage, Vec<SurfaceRecord>), Error> {
    let (camera, resolution) = (&scene.cameras[0], [24, 18]);
    let on_gpu = GpuFrame::new(&GPU, scene, camera, resolution)?;
    let transport = Transport::Direct { visibility: Visibility::Ignored };
    let frame = Frame { scene, camera, resolution, transport, seed: 0, gpu: Some(&on_gpu) };
    let method = AreaLights(Ltc);
    let parameters = Parameters::new(method.parameters(), []).expect("none");
    let mut run = method.prepare(&frame, &parameters)?;
    while !run.step()?.finished() {}
    assert_eq!(run.counters(), [("lights", scene.all_area_lights().count() as u64)]);
    let surfaces = GPU.read(on_gpu.surfaces())?;
    Ok((run.resolve()?, surfaces))
}

#[test]
fn pictures_of_triangles_and_spheres() {
    let scene = scene();
    let lights: Vec<_> = scene.all_area_lights().map(|light| LightRecord::new(&light)).collect();
    let (image, surfaces) = render(&scene).expect("a picture");
    let eye = scene.cameras[0].position.as_dvec3();
    let truths: Vec<_> =
        surfaces.iter().map(|surface| oracle::radiance(surface, eye, &lights)).collect();
    let peak = truths.iter().map(|truth| truth.max_element()).fold(0.0, f64::max);
    for (&pixel, truth) in image.pixels.iter().zip(&truths) {
        let error = (Vec3::from(pixel).as_dvec3() - truth).abs().max_element() / peak;
        assert!(error < 2e-4, "{pixel:?} for {truth}: {error:e}");
    }
    assert!(peak > 0.0);
}

#[test]
fn lights_of_one_kind() {
    for keep in [0, 1] {
        let mut scene = scene();
        scene.area_lights = scene.area_lights.into_iter().skip(keep).step_by(2).collect();
        let (image, _) = render(&scene).expect("a picture");
        assert!(image.pixels.as_flattened().iter().any(|value| *value > 0.0));
    }
}

#[test]
fn lobes_that_the_fit_does_not_know_are_declined() {
    let mut scene = scene();
    let exact = Brdf { lobe: Lobe::Dielectric { index: 1.43 }, ..glossy(0.4) };
    scene.materials[0].given = Some(exact);
    match render(&scene) {
        Err(Error::Declined(reason)) => {
            assert!(reason.contains("Schlick") && !reason.contains('\n'), "{reason}");
        }
        other => panic!("{:?}", other.map(|_| "rendered")),
    }
}
