//! What forms tend to, many bands and many small triangles: the light itself.

use std::f64::consts::PI;

use crate::common::{settings, surface};
use crate::study::square;
use glam::{DVec3, Vec3};
use manylights_paths::closed_form::polygon_irradiance;
use manylights_polygonal_light::{Settings, TriangleForm, oracle};
use manylights_scene::{AreaLight, Brdf};

/// The square of side 1 about the origin in 2k² triangles whose front is z.
fn lights(k: u32) -> Vec<AreaLight> {
    let light = |corners: [[f64; 3]; 3]| {
        let corners = corners.map(|corner| DVec3::from(corner).as_vec3());
        AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: false }
    };
    square(k).into_iter().map(light).collect()
}

/// Of a form in thirty bands, over receivers above, below and beside the horizon of which the square lies: the
/// largest error, relative to the largest truth.
fn error(form: TriangleForm, k: u32) -> f64 {
    let lights = lights(k);
    let receivers = [
        ([0.1, 0.2, 0.9], [0.0, 0.0, -1.0]),
        ([0.4, -0.7, 1.1], [0.2, 0.3, -0.9]),
        ([0.9, 0.3, 0.8], [0.8, 0.1, -0.1]),
        ([0.0, 0.1, 1.5], [1.0, 0.2, 0.1]),
        ([0.3, 0.1, 1.0], [0.1, 0.2, 0.9]),
        ([0.3, 0.1, -1.0], [0.1, 0.2, 0.9]),
    ];
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    let corners = corners.map(|[x, y]| DVec3::new(x, y, 0.0));
    let (mut largest, mut worst) = (0.0_f64, 0.0_f64);
    for (place, normal) in receivers {
        let normal = Vec3::from(normal).normalize();
        let receiver = surface(Vec3::from(place), normal, Brdf::lambert(Vec3::ONE));
        let camera = receiver.position.as_dvec3() + 3.0 * normal.as_dvec3();
        let settings = Settings { bands: 30, ..settings(form) };
        let found = PI * oracle::radiance(&receiver, camera, &lights, &settings).x;
        let seen = corners.map(|corner| (corner - receiver.position.as_dvec3()).to_array());
        let truth = polygon_irradiance(normal.as_dvec3().to_array(), &seen);
        largest = largest.max(truth);
        worst = worst.max((found - truth).abs());
    }
    worst / largest
}

/// Lambert's form; the raw sphere and the compromise as printed miss it however many triangles there are.
#[test]
fn many_small_triangles_meet_the_closed_form() {
    for form in TriangleForm::ALL {
        let errors = [1, 4, 16].map(|k| error(form, k));
        println!("{form:?}: {errors:?}");
        match form {
            TriangleForm::Sphere | TriangleForm::Compromise => {
                assert!(errors[2] > 0.05 && errors[2] > 0.9 * errors[1], "{form:?}: {errors:?}");
            }
            _ => assert!(errors[2] < 2e-3 && errors[2] < 0.1 * errors[0], "{form:?}: {errors:?}"),
        }
    }
}
