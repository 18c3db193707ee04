//! Virtual lights with shadows: every pixel sums what its shadow rays let through.

use glam::{DVec3, Vec3};
use manylights_gpu::{Center, Shadows, SurfaceRecord};
use manylights_method::Method;
use manylights_scene::Visibility;
use manylights_tests::Stage;
use manylights_virtual_lights::{VirtualLights, distribute, scene_maps};
use manylights_vpl::Vpl;
use manylights_vsgl::{Vsgl, gaussian_lights};

/// Compares a picture with sums of an oracle over the lights that a pixel sees, on Lambertian and on
/// glossy surfaces.
fn pixels_sum_what_they_see<L: Copy>(
    method: &dyn Method,
    parameters: &[(&str, &str)],
    lights: impl Fn(&Stage) -> Vec<L>,
    center: impl Fn(&L) -> Center,
    radiance: impl Fn(&SurfaceRecord, DVec3, &[L]) -> DVec3,
) {
    for name in ["cornell", "trio"] {
        let stage = Stage::builtin(name, [32, 24]);
        let picture = stage.picture(method, parameters, Visibility::Traced, 0);
        // The kernel gathers those on Lambertian surfaces first, but a sum has no order.
        let (lights, surfaces) = (lights(&stage), stage.surfaces());
        let centers: Vec<_> = lights.iter().map(&center).collect();
        let shadows = Shadows::new(&stage.on_gpu, &stage.scene).expect("the hierarchy fits");
        let occluded = shadows.occluded_lights(&centers).expect("a pass");
        let share =
            occluded.iter().filter(|occluded| **occluded).count() as f64 / occluded.len() as f64;
        assert!(share > 0.05 && share < 0.95, "{share} occluded: a weak test");
        let eye = stage.scene.cameras[0].position.as_dvec3();
        let truth = |(pixel, surface): (usize, &SurfaceRecord)| {
            let pairs = lights.iter().zip(occluded.chunks(surfaces.len()));
            let seen = pairs.filter(|(_, occluded)| !occluded[pixel]).map(|(light, _)| *light);
            radiance(surface, eye, &seen.collect::<Vec<_>>())
        };
        let truth: Vec<_> = surfaces.iter().enumerate().map(truth).collect();
        let peak = truth.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
        assert!(peak > 0.0);
        for (pixel, truth) in picture.pixels.iter().zip(&truth) {
            let error = (Vec3::from(*pixel).as_dvec3() - truth).abs().max_element();
            assert!(error < 1e-5 * peak, "{name}: {pixel:?}, {truth}");
        }
    }
}

/// More of them than a batch of shadow rays.
#[test]
fn points() {
    pixels_sum_what_they_see(
        &VirtualLights(Vpl),
        &[("lights", "400")],
        |stage| {
            let maps = scene_maps(&stage.on_gpu, &stage.scene, 400, 0).expect("maps");
            distribute(&stage.on_gpu, &stage.scene, &maps).expect("lights").0
        },
        |light| Center::from(light),
        |surface, eye, lights| {
            manylights_vpl::oracle::radiance(surface, eye, lights, &Default::default())
        },
    );
}

#[test]
fn gaussians() {
    let settings = manylights_vsgl::Settings { lights: 300, texels: 5, ..Default::default() };
    pixels_sum_what_they_see(
        &VirtualLights(Vsgl),
        &[("lights", "300"), ("texels", "5")],
        |stage| {
            let maps = scene_maps(&stage.on_gpu, &stage.scene, 300, 0).expect("maps");
            gaussian_lights(&stage.on_gpu, &stage.scene, &maps, &settings).expect("lights").0
        },
        |light| Center::new(light.center, light.geometric_normal),
        |surface, eye, lights| manylights_vsgl::oracle::radiance(surface, eye, lights, &settings),
    );
}
