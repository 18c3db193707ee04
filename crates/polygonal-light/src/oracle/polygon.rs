//! Exact triangles by coefficients: sums over their edges about directions in space, in f64; far ones by points.

use glam::DVec3;
use manylights_area_lights::triangle_mean;
use manylights_harmonics::count;
use manylights_harmonics::polygon::PolygonProjection;
use manylights_reflectance::Receiver;
use manylights_scene::AreaLight;

/// Sizes from which on the sums over edges, which lose digits with the square of the distance, know less (1e-9)
/// than seven points.
const FAR: f64 = 300.0;

/// Distance from a triangle's plane, in sizes, to which nearer points are moved, on their side.
const LEAST_HEIGHT: f64 = 1e-5;

/// Corners as seen from a point, which is moved where it is in the triangle's plane or next to it; the plane itself
/// is of the back.
pub(super) fn off_plane(corners: [DVec3; 3]) -> [DVec3; 3] {
    let [a, b, c] = corners;
    // Without area it sends nothing.
    let Some(normal) = (b - a).cross(c - a).try_normalize() else { return corners };
    let height = -normal.dot(a);
    let magnitude = height.abs().max(LEAST_HEIGHT * size(&corners));
    let moved = if height > 0.0 { magnitude - height } else { -magnitude - height };
    corners.map(|corner| corner - moved * normal)
}

/// Diameter of the sphere around corners about the middle of the box that holds them.
fn size(corners: &[DVec3; 3]) -> f64 {
    let [a, b, c] = *corners;
    let center = 0.5 * (a.min(b).min(c) + a.max(b).max(c));
    2.0 * corners.iter().map(|corner| corner.distance(center)).fold(0.0, f64::max)
}

/// Of all lights that are triangles.
pub(super) fn reflected(
    receiver: &Receiver,
    position: DVec3,
    lights: &[AreaLight],
    bands: usize,
) -> DVec3 {
    let projection = PolygonProjection::<f64>::new(bands);
    let mut coefficients = vec![0.0; count(bands)];
    let mut gradients = vec![[0.0; 3]; count(bands)];
    let mut sum = DVec3::ZERO;
    for light in lights {
        let AreaLight::Triangle { corners, radiance, two_sided } = *light else { continue };
        let seen = off_plane(corners.map(|corner| corner.as_dvec3() - position));
        let [a, b, c] = seen;
        // Positive as seen from behind.
        let volume = a.dot((b - a).cross(c - a));
        if volume == 0.0 || (volume > 0.0 && !two_sided) {
            continue;
        }
        if is_far(&seen) {
            sum += radiance.as_dvec3() * of_points(receiver, seen, volume.abs(), bands);
            continue;
        }
        let mut sums = projection.zero();
        let in_frame = |corner: DVec3| receiver.frame.map(|axis| axis.dot(corner));
        projection.add(&seen.map(in_frame), volume.signum(), &mut sums);
        projection.coefficients(&sums, &mut coefficients, &mut gradients);
        sum += radiance.as_dvec3() * receiver.product(&coefficients);
    }
    sum
}

fn is_far([a, b, c]: &[DVec3; 3]) -> bool {
    let size = (b - a).length().max((c - a).length()).max((c - b).length());
    (a + b + c).length() > 3.0 * FAR * size
}

/// `volume` is six times that of triangle and point.
fn of_points(receiver: &Receiver, corners: [DVec3; 3], volume: f64, bands: usize) -> DVec3 {
    let (scales, normal) = (vec![1.0; bands], receiver.frame[2]);
    let mean = triangle_mean(corners, |point| {
        let direction = point.normalize();
        let diffuse = receiver.diffuse_product(normal.dot(direction), &scales);
        let specular = receiver.specular_product(direction, &scales);
        (receiver.lambert * diffuse + specular) / point.length().powi(3)
    });
    0.5 * volume * mean
}
