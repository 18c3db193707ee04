//! Disks that the horizon cuts: `shaders/segment_irradiance.wesl` in f64.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::cone::Cone;

/// Of the radius, within which two chords are one.
const ONE_CHORD: f64 = 1e-5;

/// What of a disk lies on one side of a chord, behind a transform: an ellipse about `center` with the conjugate half-axes
/// x and y, above y = `cut`.
pub(crate) struct Segment {
    pub(crate) center: DVec3,
    pub(crate) axes: [DVec3; 2],
    pub(crate) cut: f64,
}

impl Segment {
    /// Irradiance of its part above the horizon: half the integral of r × dr/r² around it, upwards. Counter-clockwise as
    /// seen against the centre.
    pub(crate) fn irradiance(&self) -> f64 {
        let Self { center, axes: [x, y], cut } = *self;
        let width = ((1.0 - cut) * (1.0 + cut)).sqrt();
        let (first, last) = ([width, cut], [-width, cut]);
        let cone = Cone::new(center, [x, y]);
        let arc = |from: [f64; 2], to: [f64; 2]| {
            let is_long = from[0] * to[1] - from[1] * to[0] < 0.0;
            cone.arc([from, to].map(|place| self.at(place)), is_long)
        };
        let along = |from: [f64; 2], to: [f64; 2]| edge(self.at(from), self.at(to));
        let [up_first, up_last] = [first, last].map(|place| self.at(place).z);
        // On the chord of the horizon what is above ends at one point of the circle and begins again at another.
        let horizon = [x.z, y.z];
        let slope = x.z.hypot(y.z).max(f64::MIN_POSITIVE);
        let (toward, off) = (horizon.map(|height| height / slope), -center.z / slope);
        let half = ((1.0 - off) * (1.0 + off)).max(0.0).sqrt();
        let on_chord = |s: f64| [off * toward[0] - s * toward[1], off * toward[1] + s * toward[0]];
        let (exit, entry) = (on_chord(half), on_chord(-half));
        let level = |from: [f64; 2], to: [f64; 2]| {
            let [a, b] = [from, to].map(|place| self.at(place).normalize());
            2.0 * (a - b).length().atan2((a + b).length())
        };
        let is_up = up_first > 0.0;
        let sum = if is_up != (up_last > 0.0) {
            let share = up_first / (up_first - up_last);
            let meet = [first[0] + share * (last[0] - first[0]), cut];
            if is_up {
                arc(first, exit) + level(exit, meet) + along(meet, first)
            } else {
                arc(entry, last) + along(last, meet) + level(meet, entry)
            }
        } else {
            // Where both chords are one, rounding must not decide.
            let margin = if is_up { ONE_CHORD } else { -ONE_CHORD } * toward[1];
            let crosses = off.abs() < 1.0 && off * toward[1] > cut + margin;
            match (is_up, crosses) {
                (true, false) => arc(first, last) + along(last, first),
                (true, true) => {
                    arc(first, exit) + level(exit, entry) + arc(entry, last) + along(last, first)
                }
                (false, true) => arc(entry, exit) + level(exit, entry),
                (false, false) => 0.0,
            }
        };
        0.5 * sum
    }

    fn at(&self, [px, py]: [f64; 2]) -> DVec3 {
        self.center + px * self.axes[0] + py * self.axes[1]
    }
}

/// The angle between two directions times the height of the normal of their plane.
fn edge(a: DVec3, b: DVec3) -> f64 {
    let normal = a.cross(b);
    let length = normal.length();
    if length == 0.0 { 0.0 } else { length.atan2(a.dot(b)) * normal.z / length }
}

impl Cone {
    /// ∫ r × dr/r², upwards, from one direction on the cone to another. In the frame of its axes, at height 1, it is
    /// (A cos ψ, B sin ψ, 1), and r² = p cos² ψ + q sin² ψ with p = 1 + A², q = 1 + B².
    fn arc(&self, ends: [DVec3; 2], is_long: bool) -> f64 {
        let [a, b] = self.half_axes;
        let [[c0, s0], [c1, s1]] = ends.map(|end| {
            let [x, y, _] = self.frame.map(|axis| axis.dot(end));
            DVec2::new(b * x, a * y).normalize_or_zero().to_array()
        });
        let (p, q) = (1.0 + a * a, 1.0 + b * b);
        let difference = (a * a - b * b).max(0.0);
        // −B ∫ cos/r² = −B atanh(g sin)/(g p) between the ends, g² = (A² − B²)/p.
        let g = (difference / p).sqrt().max(1e-8);
        let t = g * (s1 - s0) / (1.0 - g * g * s0 * s1);
        let along_x = -b * t.atanh() / (g * p);
        // −A ∫ sin/r² = A atan(h cos)/(h q), h² = (A² − B²)/q.
        let h = (difference / q).sqrt().max(1e-8);
        let along_y = a * (h * (c1 - c0)).atan2(1.0 + h * h * c0 * c1) / (h * q);
        // AB ∫ 1/r² = AB/√(pq) times the angle of (√p cos, √q sin).
        let sine = (p * q).sqrt() * (c0 * s1 - s0 * c1);
        let cosine = p * c0 * c1 + q * s0 * s1;
        // Rounding tells no short arc from a whole turn.
        let angle = if cosine > 0.0 && sine.abs() < 1e-4 * cosine {
            sine / cosine + if is_long { TAU } else { 0.0 }
        } else {
            sine.atan2(cosine).rem_euclid(TAU)
        };
        let along_axis = a * b / (p * q).sqrt() * angle;
        let integral = [along_x, along_y, along_axis];
        self.frame.iter().zip(integral).map(|(axis, along)| axis.z * along).sum()
    }
}
