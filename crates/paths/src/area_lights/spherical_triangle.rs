//! A triangle as a set of directions.
//!
//! Sampled as Arvo 1995 does: the arc AB and a point Ĉ on the arc AC bound a triangle of the wanted share
//! of the solid angle, and the arc BĈ is sampled by the height of its caps about B. His form takes Ĉ from
//! angles at the corners, which lose all digits of small triangles; here the half vector of A and Ĉ comes
//! from the solid angle's tangent (van Oosterom and Strackee 1983): with h = A + k C,
//!
//! tan(Ω̂/2) = k |A, B, C| / (1 + A·B + k (A·C + B·C)), and Ĉ = 2 (A·h) h/h·h − A.

use glam::DVec3;

/// The directions in which a triangle shows its front.
#[derive(Clone, Copy, Debug)]
pub(super) struct SphericalTriangle {
    /// Unit directions A, B, C; counter-clockwise seen from the point.
    corners: [DVec3; 3],
    /// |A, B, C|, A·C + B·C, 1 + A·B.
    terms: [f64; 3],
    /// Ω/2.
    half_solid_angle: f64,
    /// Normals of the planes through the edges, turned inwards.
    edges: [DVec3; 3],
    /// Across the triangle, away from the point; not unit.
    normal: DVec3,
    /// Of the triangle's plane along `normal`, in its lengths.
    height: f64,
}

impl SphericalTriangle {
    /// Corners from the point, counter-clockwise seen from the front. `None` where the point is not in
    /// front, or all corners lie below the horizon of `normal`.
    pub(super) fn new([a, b, c]: [DVec3; 3], normal: DVec3) -> Option<Self> {
        if [a, b, c].iter().all(|corner| normal.dot(*corner) <= 0.0) {
            return None;
        }
        // Of the back; differences first, so that small and far triangles keep their digits.
        let back = (c - a).cross(b - a);
        let height = a.dot(back);
        if height <= 0.0 {
            return None;
        }
        let lengths = [a, b, c].map(DVec3::length);
        // In the order in which their determinant is positive.
        let corners = [a / lengths[0], c / lengths[2], b / lengths[1]];
        let determinant = height / lengths.iter().product::<f64>();
        let [a, b, c] = corners;
        let terms = [determinant, a.dot(c) + b.dot(c), 1.0 + a.dot(b)];
        let half_solid_angle = determinant.atan2(terms[1] + terms[2]);
        let edges = [cross(a, b), cross(b, c), cross(c, a)];
        Some(Self { corners, terms, half_solid_angle, edges, normal: back, height })
    }

    pub(super) fn solid_angle(&self) -> f64 {
        2.0 * self.half_solid_angle
    }

    pub(super) fn sample(&self, [u, v]: [f64; 2]) -> DVec3 {
        let [a, b, c] = self.corners;
        let [determinant, with_c, with_b] = self.terms;
        let (sine, cosine) = (u * self.half_solid_angle).sin_cos();
        let half = a * (determinant * cosine - with_c * sine) + c * (with_b * sine);
        let along = 2.0 * a.dot(half) / half.length_squared();
        let end = along * half - a;
        // 1 − cos of the arc from B to Ĉ, and of the part of it that is asked for.
        let whole = 0.5 * b.distance_squared(end);
        let part = v * whole;
        let ratio = if whole > 0.0 { v * (2.0 - part) / (2.0 - whole) } else { 0.0 };
        let beyond = ratio.sqrt();
        (b * (1.0 - part - beyond * (1.0 - whole)) + beyond * end).normalize()
    }

    pub(super) fn contains(&self, direction: DVec3) -> bool {
        self.edges.iter().all(|edge| edge.dot(direction) >= 0.0)
    }

    pub(super) fn distance(&self, direction: DVec3) -> f64 {
        self.height / self.normal.dot(direction)
    }
}

/// a × b of nearly equal directions, by their difference.
fn cross(a: DVec3, b: DVec3) -> DVec3 {
    a.cross(b - a)
}
