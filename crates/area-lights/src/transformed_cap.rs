//! Spheres by the disks of their silhouettes: `shaders/disk_irradiance.wesl` in f64.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat3, DVec3};
use manylights_paths::closed_form::sphere_irradiance;
use manylights_reflectance::transformed_cosine::TransformedCosine;

/// Irradiance, sr, of what a transform makes of a cap of unit radiance above the horizon: about `w`, a unit vector in
/// the frame of normal and view, with this sine of its half-angle.
pub fn transformed_cap(cosine: &TransformedCosine, w: DVec3, sine: f64) -> f64 {
    if w.z <= -sine {
        return 0.0;
    }
    if sine >= 1.0 {
        return hemisphere(cosine, w);
    }
    let distance = ((1.0 - sine) * (1.0 + sine)).sqrt();
    let flat = w.x.hypot(w.y);
    let sideways = if flat > 0.0 { DVec3::new(-w.y, w.x, 0.0) / flat } else { DVec3::Y };
    let upwards = w.cross(sideways);
    let [mut center, mut height, mut width] = [0.0, 1.0, 1.0];
    // Where transform and surface share their horizon, the cap's formula has it.
    if cosine.along[0] != 0.0 {
        let cut = (-w.z * distance / (flat * sine).max(f64::MIN_POSITIVE)).clamp(-1.0, 1.0);
        if cut == 1.0 {
            return 0.0;
        }
        // A circle's segment, and the ellipse of its height and area.
        let area = cut.acos() - cut * ((1.0 - cut) * (1.0 + cut)).sqrt();
        [center, height] = [0.5 * (1.0 + cut), 0.5 * (1.0 - cut)];
        width = area / (PI * height);
    }
    let middle = distance * w + center * sine * upwards;
    let axes = [height * sine * upwards, width * sine * sideways].map(|axis| cosine.apply(axis));
    ellipse(cosine.apply(middle), axes)
}

/// Of an ellipse with any two conjugate half-axes: exact above the horizon, else that of the cap of the same
/// form factor about the same axis.
fn ellipse(center: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let outer = |i: usize, k: usize| center[i] * center[k] - a[i] * a[k] - b[i] * b[k];
    let dual = [0, 1, 2].map(|i| [0, 1, 2].map(|k| outer(i, k)));
    let pairs = eigenvectors(dual);
    let (axis, kappa) = pairs[0];
    let lose = |other: f64| (-other).max(0.0) / (kappa - other);
    let form_factor = (lose(pairs[1].1) * lose(pairs[2].1)).sqrt();
    let cosine = if axis.dot(center) < 0.0 { -axis.z } else { axis.z };
    sphere_irradiance(cosine.clamp(-1.0, 1.0), form_factor.sqrt().min(1.0))
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

/// Of the hemisphere about `w`, above the horizon and that of the transform, if they differ: half the sum over three great
/// circles of the arc that the other two leave, times the height of the circle's normal.
fn hemisphere(cosine: &TransformedCosine, w: DVec3) -> f64 {
    // M w for M with the inverse of `cosine`, transposed: normals of half-spaces.
    let [x, y, z] = DMat3::IDENTITY.to_cols_array_2d().map(|axis| cosine.apply(axis.into()));
    let inverse = DMat3::from_cols(x, y, z).inverse().transpose();
    let light = (inverse * w).normalize();
    if cosine.along[0] == 0.0 {
        return FRAC_PI_2 * (1.0 + light.z);
    }
    let normals = [light, (inverse * DVec3::Z).normalize(), DVec3::Z];
    let arc = |i: usize| {
        let [n, a, b] = [0, 1, 2].map(|k| normals[(i + k) % 3]);
        let [a, b] = [a, b].map(|other| (other - n.dot(other) * n).normalize_or_zero());
        if a == DVec3::ZERO || b == DVec3::ZERO {
            PI
        } else {
            PI - a.dot(b).clamp(-1.0, 1.0).acos()
        }
    };
    let sum: f64 = (0..3).map(|i| arc(i) * normals[i].z).sum();
    (0.5 * sum).clamp(0.0, 2.0 * FRAC_PI_2)
}
