//! Triangles: `shaders/triangle_irradiance.wesl` in f64; far ones by points.

use glam::DVec3;
use manylights_paths::closed_form::polygon_irradiance;
use manylights_reflectance::transformed_cosine::TransformedCosine;

use crate::triangle_mean::triangle_mean;

const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// Sizes from which on Lambert's formula, which loses digits with the square of the distance, knows less (1e-10)
/// than seven points.
const FAR: f64 = 300.0;

/// Irradiance, sr, of what a transform makes of a triangle of unit radiance above the horizon, whose corners are in
/// the frame of normal and view, counter-clockwise as seen from its front.
pub fn transformed_triangle(
    cosine: &TransformedCosine,
    corners: [DVec3; 3],
    two_sided: bool,
) -> f64 {
    let above = above_horizon(&corners);
    let corners: Vec<_> = above.iter().map(|&corner| cosine.apply(corner)).collect();
    if is_far(&corners) {
        let fan = corners[1..].windows(2);
        let signed: f64 = fan.map(|pair| of_points([corners[0], pair[0], pair[1]])).sum();
        return if two_sided { signed.abs() } else { signed.max(0.0) };
    }
    let corners: Vec<_> = corners.into_iter().map(|corner| corner.to_array()).collect();
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

fn is_far(corners: &[DVec3]) -> bool {
    let Some((&first, others)) = corners.split_first() else { return false };
    let size = others.iter().map(|corner| corner.distance(first)).fold(0.0, f64::max);
    first.length() > FAR * size
}

/// Positive from the front.
fn of_points(corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners;
    let mean = triangle_mean(corners, |point| point.z.max(0.0) / point.length_squared().powi(2));
    -0.5 * a.dot((b - a).cross(c - a)) * mean
}
