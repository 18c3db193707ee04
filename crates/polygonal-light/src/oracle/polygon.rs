//! Exact triangles by coefficients: sums over their edges about directions in space, in f64, at any distance.

use glam::DVec3;
use manylights_harmonics::count;
use manylights_harmonics::polygon::PolygonProjection;
use manylights_reflectance::Receiver;
use manylights_scene::AreaLight;

/// Of all lights that are triangles; those in whose plane the point lies send nothing.
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
        let seen = corners.map(|corner| corner.as_dvec3() - position);
        let [a, b, c] = seen;
        // Positive as seen from behind.
        let volume = a.dot((b - a).cross(c - a));
        if volume == 0.0 || (volume > 0.0 && !two_sided) {
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
