//! Cones over ellipses: `shaders/cone.wesl` in f64.

use glam::DVec3;

/// An elliptic cone.
pub(crate) struct Cone {
    /// Long and short axis, and that of the cone, right-handed.
    pub(crate) frame: [DVec3; 3],
    /// At height 1.
    pub(crate) half_axes: [f64; 2],
    /// About the axis.
    pub(crate) form_factor: f64,
}

impl Cone {
    /// Over an ellipse with any two conjugate half-axes, from the eigenvectors of its dual.
    pub(crate) fn new(center: DVec3, [a, b]: [DVec3; 2]) -> Self {
        let outer = |i: usize, k: usize| center[i] * center[k] - a[i] * a[k] - b[i] * b[k];
        let dual = [0, 1, 2].map(|i| [0, 1, 2].map(|k| outer(i, k)));
        let [(axis, kappa), (_, short), (long_axis, long)] = eigenvectors(dual);
        let axis = if axis.dot(center) < 0.0 { -axis } else { axis };
        let half_axes = [long, short].map(|value| ((-value).max(0.0) / kappa).sqrt());
        // √(κ₁κ₂/((κ − κ₁)(κ − κ₂))) with κκ₁κ₂ = det²: of small ellipses κ₁ and κ₂ themselves have no digits left.
        let apart = (kappa - short) * (kappa - long);
        let form_factor = center.dot(a.cross(b)).abs() / (kappa * apart).sqrt();
        Self { frame: [long_axis, axis.cross(long_axis), axis], half_axes, form_factor }
    }
}

/// Of a symmetric matrix, with their values, the largest first (Jacobi 1846).
fn eigenvectors(mut matrix: [[f64; 3]; 3]) -> [(DVec3, f64); 3] {
    let mut axes = [DVec3::X, DVec3::Y, DVec3::Z];
    for (p, q) in [(0, 1), (1, 2), (0, 2)].into_iter().cycle().take(36) {
        let angle = 0.5 * (2.0 * matrix[p][q]).atan2(matrix[q][q] - matrix[p][p]);
        let (sin, cos) = angle.sin_cos();
        for row in &mut matrix {
            (row[p], row[q]) = (cos * row[p] - sin * row[q], sin * row[p] + cos * row[q]);
        }
        let [first, second] = [matrix[p], matrix[q]];
        matrix[p] = [0, 1, 2].map(|k| cos * first[k] - sin * second[k]);
        matrix[q] = [0, 1, 2].map(|k| sin * first[k] + cos * second[k]);
        (axes[p], axes[q]) = (cos * axes[p] - sin * axes[q], sin * axes[p] + cos * axes[q]);
    }
    let mut pairs = [0, 1, 2].map(|i| (axes[i], matrix[i][i]));
    pairs.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    pairs
}
