//! Emissive triangles, sampled by area.

use glam::Vec3;
use manylights_scene::{Scene, SurfacePoint};

/// A point on an emissive triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EmitterPoint {
    pub(crate) position: Vec3,
    /// Unit, on the front.
    pub(crate) normal: Vec3,
    /// Whether the back emits, too.
    pub(crate) two_sided: bool,
    /// W·m⁻²·sr⁻¹.
    pub(crate) radiance: Vec3,
    /// Density over area, m⁻².
    pub(crate) density: f32,
}

/// The emissive triangles of a scene.
#[derive(Debug)]
pub(crate) struct Emitters {
    triangles: Vec<Emitter>,
    /// Lower ends of the triangles' shares of the power.
    shares: Vec<f32>,
    /// Sum of area × mean radiance over all sides that emit.
    power: f32,
    /// Of a sphere around all of them.
    center: Vec3,
    radius: f32,
}

#[derive(Debug)]
struct Emitter {
    corner: Vec3,
    edges: [Vec3; 2],
    normal: Vec3,
    radiance: Vec3,
    two_sided: bool,
    /// One over the share of the power.
    scale: f32,
}

impl Emitters {
    pub(crate) fn new(scene: &Scene) -> Self {
        let mut triangles: Vec<_> =
            scene.emissive_triangles().map(|triangle| Emitter::new(scene, triangle)).collect();
        let powers: Vec<_> = triangles.iter().map(|emitter| f64::from(emitter.power())).collect();
        let total: f64 = powers.iter().sum();
        let mut below = 0.0;
        let mut shares = Vec::with_capacity(triangles.len());
        for (emitter, power) in triangles.iter_mut().zip(powers) {
            shares.push((below / total) as f32);
            emitter.scale = (total / power) as f32;
            below += power;
        }
        let corners = || triangles.iter().flat_map(Emitter::corners);
        let low = corners().fold(Vec3::INFINITY, Vec3::min);
        let high = corners().fold(Vec3::NEG_INFINITY, Vec3::max);
        let (center, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
        Self { triangles, shares, power: total as f32, center, radius }
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
        let index = self.shares.partition_point(|&share| share <= u) - 1;
        let emitter = &self.triangles[index];
        let u = ((u - self.shares[index]) * emitter.scale).min(1.0);
        let (s, t) = square_to_triangle(u, v);
        EmitterPoint {
            position: emitter.corner + s * emitter.edges[0] + t * emitter.edges[1],
            normal: emitter.normal,
            two_sided: emitter.two_sided,
            radiance: emitter.radiance,
            density: exitance(emitter.radiance, emitter.two_sided) / self.power,
        }
    }

    /// Density over area with which [`Self::sample`] finds a point that emits, m⁻²; its surface is
    /// `two_sided` or not.
    pub(crate) fn density(&self, point: &SurfacePoint, two_sided: bool) -> f32 {
        exitance(point.emission, two_sided) / self.power
    }
}

impl Emitter {
    fn new(scene: &Scene, triangle: u32) -> Self {
        let [a, b, c] = scene.corners(triangle);
        let material = scene.material_of(triangle);
        Self {
            corner: a,
            edges: [b - a, c - a],
            normal: scene.geometric_normal(triangle),
            radiance: material.emission,
            two_sided: material.two_sided,
            scale: 1.0,
        }
    }

    fn corners(&self) -> [Vec3; 3] {
        [self.corner, self.corner + self.edges[0], self.corner + self.edges[1]]
    }

    /// Area × mean radiance of the sides that emit.
    fn power(&self) -> f32 {
        let area = 0.5 * self.edges[0].cross(self.edges[1]).length();
        area * exitance(self.radiance, self.two_sided)
    }
}

/// Of all sides that emit, mean of the channels, over π.
fn exitance(radiance: Vec3, two_sided: bool) -> f32 {
    let sides = if two_sided { 2.0 } else { 1.0 };
    sides * radiance.element_sum() / 3.0
}

/// The area-preserving map of low distortion of Heitz 2019, "A Low-Distortion Map Between Triangle
/// and Square", without its branch.
fn square_to_triangle(u: f32, v: f32) -> (f32, f32) {
    let half = 0.5 * u.min(v);
    (u - half, v - half)
}
