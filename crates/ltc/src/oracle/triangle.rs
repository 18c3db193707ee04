//! Triangles.

use glam::DVec3;
use manylights_paths::closed_form::polygon_irradiance;
use manylights_reflectance::transformed_cosine::TransformedCosine;

const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// Irradiance of what a transform makes of a triangle above the horizon.
pub(super) fn irradiance(cosine: &TransformedCosine, corners: [DVec3; 3], two_sided: bool) -> f64 {
    let above = above_horizon(&corners);
    let corners: Vec<_> = above.iter().map(|&corner| cosine.apply(corner).to_array()).collect();
    let front = polygon_irradiance(UP, &corners);
    if !two_sided {
        return front;
    }
    let turned: Vec<_> = corners.into_iter().rev().collect();
    front + polygon_irradiance(UP, &turned)
}

/// Its part above the plane z = 0, corner by corner.
fn above_horizon(corners: &[DVec3]) -> Vec<DVec3> {
    let mut above = Vec::with_capacity(corners.len() + 1);
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        if a.z > 0.0 {
            above.push(*a);
        }
        if (a.z > 0.0) != (b.z > 0.0) {
            above.push((*a + a.z / (a.z - b.z) * (*b - *a)).with_z(0.0));
        }
    }
    above
}
