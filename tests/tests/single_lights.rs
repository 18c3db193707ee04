//! One virtual light against one formula, in numbers that no code of a method makes.

use std::f32::consts::PI;

use glam::Vec3;
use manylights_gpu::SurfaceRecord;
use manylights_hvl::{Horizon, VirtualSphere};
use manylights_scene::Brdf;
use manylights_tests::GPU;
use manylights_virtual_lights::VirtualLight;
use manylights_vsl::Sampling;

const PLACE: Vec3 = Vec3::new(0.3, 2.0, -0.4);
const CAMERA: Vec3 = Vec3::new(0.6, 1.0, -0.2);
/// Of the light and of the receiver.
const ALBEDOS: [f32; 2] = [0.8, 0.3];

/// A Lambertian light whose two normals are far apart.
fn light() -> VirtualLight {
    VirtualLight {
        position: PLACE,
        geometric_normal: Vec3::new(0.1, -1.0, 0.3).normalize(),
        normal: Vec3::new(-0.9, -1.0, 0.8).normalize(),
        incoming: Vec3::new(0.2, -1.0, 0.5).normalize(),
        flux: Vec3::new(3.0, 2.0, 1.0),
        brdf: Brdf::lambert(Vec3::splat(ALBEDOS[0])),
    }
}

fn receiver() -> SurfaceRecord {
    let normal = Vec3::new(0.2, 1.0, 0.1).normalize();
    SurfaceRecord::new(Vec3::ZERO, normal, Brdf::lambert(Vec3::splat(ALBEDOS[1])))
}

/// Φ ρ/π ρ'/π cos cos/d², where flux leaves the light with the cosine of its geometric normal.
fn expected() -> Vec3 {
    let light = light();
    let toward = PLACE.normalize();
    let cosines = receiver().normal.dot(toward) * light.geometric_normal.dot(-toward);
    light.flux * (ALBEDOS[0] * ALBEDOS[1] / (PI * PI) * cosines / PLACE.length_squared())
}

fn assert_close(method: &str, found: [f32; 3], expected: Vec3, bound: f32) {
    let error = ((Vec3::from(found) - expected) / expected).abs().max_element();
    assert!(error < bound, "{method}: {found:?}, expected {expected}");
}

#[test]
fn flux_leaves_with_the_cosine_of_the_geometric_normal() {
    let surfaces = [receiver()];
    let settings = Default::default();
    let point = manylights_vpl::gather(&GPU, &surfaces, CAMERA, &[light()], &settings);
    assert_close("points", point.expect("a gather")[0], expected(), 1e-5);

    // The error of the limit is r²/d², below 1e-6.
    let spheres = [VirtualSphere { light: light(), radius: 1e-3 }];
    for sampling in [Sampling::Cone, Sampling::Both] {
        let settings =
            manylights_vsl::Settings { sampling, directions: 4096, ..Default::default() };
        let found = manylights_vsl::gather(&GPU, &surfaces, CAMERA, &spheres, &settings, 0);
        assert_close("samples", found.expect("a gather")[0], expected(), 1e-4);
    }
    for horizon in [Horizon::Smooth, Horizon::Exact] {
        // So many bands miss 1e-4 of a cosine.
        let settings = manylights_hvl::Settings { bands: 20, horizon, ..Default::default() };
        let found = manylights_hvl::gather(&GPU, &surfaces, CAMERA, &spheres, &settings);
        assert_close("harmonics", found.expect("a gather")[0], expected(), 1e-2);
    }
}

/// Just above the light the geometry term has no bound but the one that is set.
#[test]
fn the_clamp_bounds_each_light() {
    let light = VirtualLight { geometric_normal: Vec3::NEG_Y, normal: Vec3::NEG_Y, ..light() };
    let below = |distance: f32| {
        let brdf = receiver().brdf();
        SurfaceRecord::new(PLACE - distance * Vec3::Y, Vec3::Y, brdf)
    };
    let reflected = light.flux * (ALBEDOS[0] * ALBEDOS[1] / (PI * PI));
    for clamp in [0.5_f32, 30.0] {
        let settings = manylights_vpl::Settings { clamp: Some(clamp), ..Default::default() };
        // 1/d² beside the bound: far above, just above, just below, far below.
        for share in [1e4_f32, 1.01, 0.99, 0.1] {
            let surface = below(1.0 / (share * clamp).sqrt());
            let camera = surface.position + Vec3::Y;
            let found =
                manylights_vpl::gather(&GPU, &[surface], camera, &[light, light], &settings);
            let expected = 2.0 * reflected * clamp * share.min(1.0);
            assert_close("clamped", found.expect("a gather")[0], expected, 2e-5);
        }
    }
}
