//! Far triangles, for oracles.

use std::iter::Sum;
use std::ops::Mul;

use glam::DVec3;

/// The mean of a function over a triangle, by seven points: exact for polynomials of degree 5 (Radon 1948).
pub fn triangle_mean<T: Sum + Mul<f64, Output = T>>(
    corners: [DVec3; 3],
    of: impl Fn(DVec3) -> T,
) -> T {
    let root = 15.0_f64.sqrt();
    let rings =
        [-1.0, 1.0].map(|sign| ((6.0 + sign * root) / 21.0, (155.0 + sign * root) / 1200.0));
    let middle = corners.iter().sum::<DVec3>() / 3.0;
    let points = rings.into_iter().flat_map(|(share, weight)| {
        corners.map(|corner| (corner + 3.0 * share * (middle - corner), weight))
    });
    points.chain([(middle, 0.225)]).map(|(point, weight)| of(point) * weight).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ λ₁^i λ₂^j is 2 i! j!/(i + j + 2)! of the area.
    #[test]
    fn polynomials_of_degree_five_are_exact() {
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        let corners =
            [DVec3::new(0.2, 0.1, 0.5), DVec3::new(0.2, 1.1, 0.5), DVec3::new(0.2, 0.1, 1.5)];
        for i in 0..=5 {
            for j in 0..=5 - i {
                let mean = triangle_mean(corners, |p| (p.y - 0.1).powi(i) * (p.z - 0.5).powi(j));
                let truth = 2.0 * factorial(i) * factorial(j) / factorial(i + j + 2);
                assert!((mean - truth).abs() < 1e-14, "{i}, {j}: {mean} {truth}");
            }
        }
    }
}
