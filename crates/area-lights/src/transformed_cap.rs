//! Spheres by the disks of their silhouettes: `shaders/disk_irradiance.wesl` in f64.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat3, DVec3};
use manylights_paths::closed_form::sphere_irradiance;
use manylights_reflectance::transformed_cosine::TransformedCosine;

use crate::cone::Cone;
use crate::transformed_segment::Segment;

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
    let middle = cosine.apply(distance * w);
    let axes = [sideways, upwards].map(|axis| cosine.apply(sine * axis));
    // Where transform and surface share their horizon, the cap's formula has it.
    if cosine.along[0] == 0.0 {
        return ellipse(middle, axes);
    }
    // Where the horizon cuts the disk, from −1 (below it) to 1.
    let cut = (-w.z * distance / (flat * sine).max(f64::MIN_POSITIVE)).clamp(-1.0, 1.0);
    if cut == -1.0 {
        return ellipse(middle, axes);
    }
    if cut == 1.0 {
        return 0.0;
    }
    Segment { center: middle, axes, cut }.irradiance()
}

/// Of an ellipse with any two conjugate half-axes: exact above the horizon, else that of the cap of the same
/// form factor about the same axis.
fn ellipse(center: DVec3, axes: [DVec3; 2]) -> f64 {
    let Cone { frame: [.., axis], form_factor, .. } = Cone::new(center, axes);
    sphere_irradiance(axis.z.clamp(-1.0, 1.0), form_factor.sqrt().min(1.0))
}

/// Of the hemisphere about `w`, above the horizon and that of the transform, if they differ: half the sum over three great
/// circles of the arc that the other two leave, times the height of the circle's normal. Of a circle that bounds two of the
/// half-spaces, as where the point is at the sphere's centre, each has a half.
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
        let [a, b] = [n.cross(a), n.cross(b)];
        let is_twice = a == DVec3::ZERO || b == DVec3::ZERO;
        PI - if is_twice { FRAC_PI_2 } else { a.cross(b).length().atan2(a.dot(b)) }
    };
    let sum: f64 = (0..3).map(|i| arc(i) * normals[i].z).sum();
    (0.5 * sum).clamp(0.0, 2.0 * FRAC_PI_2)
}
