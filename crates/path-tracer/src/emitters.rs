//! Emissive triangles, sampled by area.

use glam::Vec3;
use manylights_scene::{Scene, SurfacePoint};

/// A point on an emissive triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EmitterPoint {
    pub(crate) position: Vec3,
    /// Unit, on the side that emits.
    pub(crate) normal: Vec3,
    /// W·m⁻²·sr⁻¹.
    pub(crate) radiance: Vec3,
    /// Density over area, m⁻².
    pub(crate) density: f32,
}

/// The emissive triangles of a scene.
#[derive(Debug)]
pub(crate) struct Emitters {
    triangles: Vec<Emitter>,
    /// Upper ends of the triangles' shares of the power; the last is 1.
    shares: Vec<f32>,
    /// Sum of area × mean radiance.
    power: f32,
    /// Of a sphere around all of them.
    center: Vec3,
    radius: f32,
}

#[derive(Debug)]
struct Emitter {
    corners: [Vec3; 3],
    normal: Vec3,
    radiance: Vec3,
}

impl Emitters {
    pub(crate) fn new(scene: &Scene) -> Self {
        let triangles: Vec<_> = scene
            .emissive_triangles()
            .map(|triangle| Emitter {
                corners: scene.corners(triangle),
                normal: scene.geometric_normal(triangle),
                radiance: scene.material_of(triangle).emission,
            })
            .collect();
        let mut power = 0.0;
        let running: Vec<f64> = triangles
            .iter()
            .map(|emitter| {
                power += f64::from(emitter.area() * mean(emitter.radiance));
                power
            })
            .collect();
        let shares = running.iter().map(|sum| (sum / power) as f32).collect();
        let corners = || triangles.iter().flat_map(|emitter: &Emitter| emitter.corners);
        let low = corners().fold(Vec3::INFINITY, Vec3::min);
        let high = corners().fold(Vec3::NEG_INFINITY, Vec3::max);
        let (center, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
        Self { triangles, shares, power: power as f32, center, radius }
    }

    /// Whether a point is so far from all of them (a diameter from their centre) that sampling them by
    /// area suffices for a Lambertian surface there: 1/d² varies by less than 9 over them, and a
    /// direction drawn from the surface finds them too rarely to help.
    pub(crate) fn are_far(&self, point: Vec3) -> bool {
        (point - self.center).length_squared() > 4.0 * self.radius * self.radius
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// A point on a triangle chosen by power, uniform on it.
    pub(crate) fn sample(&self, [u, v]: [f32; 2]) -> EmitterPoint {
        let index = self.shares.partition_point(|&share| share <= u).min(self.shares.len() - 1);
        let below = if index == 0 { 0.0 } else { self.shares[index - 1] };
        let u = ((u - below) / (self.shares[index] - below)).clamp(0.0, 1.0);
        let emitter = &self.triangles[index];
        let [a, b, c] = emitter.corners;
        let (s, t) = square_to_triangle(u, v);
        EmitterPoint {
            position: a + s * (b - a) + t * (c - a),
            normal: emitter.normal,
            radiance: emitter.radiance,
            density: mean(emitter.radiance) / self.power,
        }
    }

    /// Density over area with which [`Self::sample`] finds a point that emits, m⁻².
    pub(crate) fn density(&self, point: &SurfacePoint) -> f32 {
        mean(point.emission) / self.power
    }
}

impl Emitter {
    fn area(&self) -> f32 {
        let [a, b, c] = self.corners;
        0.5 * (b - a).cross(c - a).length()
    }
}

fn mean(radiance: Vec3) -> f32 {
    radiance.element_sum() / 3.0
}

/// The area-preserving map of low distortion of Heitz 2019, "A Low-Distortion Map Between Triangle
/// and Square".
fn square_to_triangle(u: f32, v: f32) -> (f32, f32) {
    if v > u { (0.5 * u, v - 0.5 * u) } else { (u - 0.5 * v, 0.5 * v) }
}
