//! A specular lobe under triangles of light, by quadrature.

use glam::DVec3;
use manylights_scene::DBrdf;

/// Weights and places of the seven points of degree 5, over the mean (Radon 1948).
fn seven_points() -> [(f64, [f64; 3]); 7] {
    let root = 15.0_f64.sqrt();
    let [near, wide] = [(6.0 - root) / 21.0, (6.0 + root) / 21.0];
    let [light, heavy] = [(155.0 - root) / 1200.0, (155.0 + root) / 1200.0];
    let three = |weight: f64, p: f64| {
        let q = 1.0 - 2.0 * p;
        [(weight, [p, p, q]), (weight, [p, q, p]), (weight, [q, p, p])]
    };
    let [a, b, c] = three(light, near);
    let [d, e, f] = three(heavy, wide);
    [(0.225, [1.0 / 3.0; 3]), a, b, c, d, e, f]
}

/// Places of triangles of a size, seen from the origin at distance 1 from 10° below the horizon up, in all
/// orientations, with their fronts to it.
pub(crate) fn around(count: u32, size: f64) -> impl Iterator<Item = [DVec3; 3]> {
    (0..count).map(move |i| {
        let spiral = |i: u32, lowest: f64| {
            let z = 1.0 - (1.0 - lowest) * (f64::from(i) + 0.5) / f64::from(count);
            let (sin, cos) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
            let r = ((1.0 - z) * (1.0 + z)).sqrt();
            DVec3::new(r * cos, r * sin, z)
        };
        let center = spiral(i, -0.17);
        let (x, y) = spiral(i * 37 % count, -1.0).any_orthonormal_pair();
        let corner = |turn: f64| {
            let (sin, cos) = (f64::from(i) + turn * std::f64::consts::TAU / 3.0).sin_cos();
            center + 0.5 * size * (cos * x + sin * y)
        };
        let [a, b, c] = [0.0, 1.0, 2.0].map(corner);
        if (b - a).cross(c - a).dot(a) > 0.0 { [a, c, b] } else { [a, b, c] }
    })
}

/// ∫ f n·l over a triangle of light, for the normal z.
pub(crate) fn reflected(brdf: &DBrdf, view: DVec3, corners: [DVec3; 3]) -> f64 {
    let rule = seven_points();
    // Below the lobe's width.
    part(brdf, view, &rule, corners, 0.7 * brdf.alpha, 12)
}

fn part(
    brdf: &DBrdf,
    view: DVec3,
    rule: &[(f64, [f64; 3]); 7],
    corners: [DVec3; 3],
    width: f64,
    depth: u32,
) -> f64 {
    let [a, b, c] = corners;
    let area2 = (b - a).cross(c - a);
    let all_below = corners.iter().all(|corner| corner.z <= 0.0);
    if all_below {
        return 0.0;
    }
    let value = |[u, v, w]: [f64; 3]| {
        let place = u * a + v * b + w * c;
        let direction = place.normalize();
        if direction.z <= 0.0 {
            return 0.0;
        }
        let facing = -area2.dot(direction).min(0.0) / place.length_squared();
        0.5 * facing * direction.z * brdf.specular(DVec3::Z, view, direction).x
    };
    let size = (b - a).length().max((c - a).length()).max((c - b).length());
    let crosses = corners.iter().any(|corner| corner.z < 0.0);
    // Away from its peak a lobe is as wide as the way to it.
    let middle = (a + b + c) / 3.0;
    let mirrored = DVec3::new(-view.x, 0.0, view.z);
    let away = (middle.normalize() - mirrored).length() - size / middle.length();
    let fine = size / middle.length() < width.max(0.4 * away) && size < 0.5 * middle.length();
    if depth == 0 || (fine && (!crosses || size < 0.02)) {
        return rule.iter().map(|&(weight, place)| weight * value(place)).sum();
    }
    let [ab, bc, ca] = [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        .into_iter()
        .map(|corners| part(brdf, view, rule, corners, width, depth - 1))
        .sum()
}
