//! Virtual spherical and harmonics virtual lights integrate the same sphere: the samples of the one and
//! the bands of the other have one limit.

use glam::{DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_harmonics::quadrature::sphere_nodes;
use manylights_hvl::{Horizon, Settings};
use manylights_scene::{Brdf, Lobe};
use manylights_virtual_lights::{VirtualLight, VirtualSphere};
use manylights_vsl::oracle::Receiver;

fn glossy(roughness: f32) -> Brdf {
    let alpha = roughness * roughness;
    let (diffuse, f0) = (Vec3::splat(0.5), Vec3::splat(0.04));
    Brdf { diffuse, f0, lobe: Lobe::Schlick { f90: 1.0 }, alpha }
}

/// A sphere that faces the origin from well above the horizon.
fn sphere(radius: f32) -> VirtualSphere {
    let position = Vec3::new(0.4, 1.0, 0.1);
    let normal = -position.normalize();
    let brdf = Brdf::lambert(Vec3::ONE);
    let (geometric_normal, incoming, flux) = (normal, normal, Vec3::ONE);
    let light = VirtualLight { position, geometric_normal, normal, incoming, flux, brdf };
    VirtualSphere { light, radius }
}

/// What infinitely many samples of a virtual spherical light give.
fn by_samples(surface: &SurfaceRecord, camera: DVec3, sphere: &VirtualSphere) -> DVec3 {
    let receiver = Receiver::new(surface, camera);
    let cone = receiver.cone(sphere).expect("the sphere is somewhere");
    let (a, b) = cone.axis.any_orthonormal_pair();
    let nodes = sphere_nodes(48, [1.0 - cone.height, 1.0]).into_iter();
    let (sum, solid_angle) = nodes.fold((DVec3::ZERO, 0.0), |(sum, all), ([x, y, z], weight)| {
        let w = x * a + y * b + z * cone.axis;
        (sum + weight * receiver.integrand(&sphere.light, w), all + weight)
    });
    sum * (cone.falloff / solid_angle)
}

#[test]
fn more_bands_approach_more_samples() {
    let camera = DVec3::new(-0.9, 1.0, 0.2);
    // Measured, less what the cone's extent makes: up to 4.6e-3, 8.5e-3, 1.3e-3; in one direction, so that
    // ten bands may miss more than five.
    let bands_miss = [(5, 6e-3), (10, 1e-2), (20, 2e-3)];
    for (name, brdf) in [
        ("Lambert", Brdf::lambert(Vec3::splat(0.5))),
        ("GGX 1.0", glossy(1.0)),
        ("GGX 0.6", glossy(0.6)),
    ] {
        let surface = SurfaceRecord::new(Vec3::ZERO, Vec3::Y, brdf);
        for radius in [0.3_f32, 0.1, 0.01] {
            let sphere = sphere(radius);
            let truth = by_samples(&surface, camera, &sphere);
            let sine = f64::from(radius) / sphere.light.position.as_dvec3().length();
            for (bands, miss) in bands_miss {
                let settings = Settings { bands, horizon: Horizon::Exact, ..Settings::default() };
                let value =
                    manylights_hvl::oracle::radiance(&surface, camera, &[sphere], &settings);
                let error = ((value - truth) / truth).abs().max_element();
                println!("{name}, radius {radius}, {bands} bands: {error:.1e}");
                // A harmonics virtual light takes the emission at its centre. The cosine there is 1, over
                // the cone sine²/4 less on average.
                let bound = miss + 0.3 * sine * sine;
                assert!(error < bound, "{name}, radius {radius}, {bands} bands: {error:e}");
            }
        }
    }
}
