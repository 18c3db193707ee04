//! Sampling of [`Brdf`](manylights_scene::Brdf): a cosine lobe for the Lambertian part, GGX visible
//! normals for the specular one, mixed by their share of the reflected energy.

use std::f32::consts::{FRAC_1_PI, TAU};

use glam::{Vec2, Vec3};
use manylights_scene::SurfacePoint;

/// A direction to go on in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scatter {
    /// Unit, away from the surface.
    pub(crate) direction: Vec3,
    /// f · cos / density.
    pub(crate) weight: Vec3,
    /// Density over solid angle, sr⁻¹.
    pub(crate) density: f32,
}

/// How a surface point scatters towards `to_viewer`, with what depends on them alone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lobes<'a> {
    point: &'a SurfacePoint,
    to_viewer: Vec3,
    /// Probability of the specular lobe.
    specular: f32,
}

impl<'a> Lobes<'a> {
    #[inline]
    pub(crate) fn new(point: &'a SurfacePoint, to_viewer: Vec3) -> Self {
        let specular = point.brdf.specular_share(point.normal.dot(to_viewer));
        Self { point, to_viewer, specular }
    }

    /// A direction for two uniform numbers; `None` where nothing is reflected into it.
    pub(crate) fn sample(&self, [u, v]: [f32; 2]) -> Option<Scatter> {
        let SurfacePoint { normal, brdf, .. } = self.point;
        if self.specular == 0.0 {
            let direction = cosine([u, v], *normal);
            let density = normal.dot(direction) * FRAC_1_PI;
            // f · cos / density is the albedo, exactly, unless there is a coat in front of it.
            if !brdf.has_specular() {
                return (density > 0.0).then_some(Scatter {
                    direction,
                    weight: brdf.diffuse,
                    density,
                });
            }
            return self.weighed(direction, density);
        }
        let direction = if u < self.specular {
            self.visible_normal([u / self.specular, v])
        } else {
            let u = (u - self.specular) / (1.0 - self.specular);
            cosine([u.min(1.0 - f32::EPSILON), v], *normal)
        };
        self.weighed(direction, self.density(direction))
    }

    /// f(to_viewer, direction) · n·direction.
    pub(crate) fn reflect(&self, direction: Vec3) -> Vec3 {
        let SurfacePoint { normal, brdf, .. } = self.point;
        brdf.eval(*normal, self.to_viewer, direction) * normal.dot(direction).max(0.0)
    }

    /// Density with which [`Self::sample`] makes a direction, sr⁻¹.
    pub(crate) fn density(&self, direction: Vec3) -> f32 {
        let normal = self.point.normal;
        let cosine = (1.0 - self.specular) * normal.dot(direction).max(0.0) * FRAC_1_PI;
        if self.specular == 0.0 {
            return cosine;
        }
        cosine + self.specular * self.visible_normal_density(direction)
    }

    fn weighed(&self, direction: Vec3, density: f32) -> Option<Scatter> {
        let weight = self.reflect(direction) / density;
        (density > 0.0 && weight != Vec3::ZERO).then_some(Scatter { direction, weight, density })
    }

    /// Mirrors the viewer in a visible micro-normal, drawn as a spherical cap (Dupuy and Benyoub
    /// 2023, "Sampling Visible GGX Normals with Spherical Caps", listing 1).
    fn visible_normal(&self, [u, v]: [f32; 2]) -> Vec3 {
        let SurfacePoint { normal, brdf, .. } = self.point;
        let (x_axis, y_axis) = normal.any_orthonormal_pair();
        let local = |d: Vec3| Vec3::new(x_axis.dot(d), y_axis.dot(d), normal.dot(d));
        let viewer = local(self.to_viewer);
        let stretched = Vec3::new(brdf.alpha * viewer.x, brdf.alpha * viewer.y, viewer.z);
        let standard = stretched.normalize();
        let z = (1.0 - v) * (1.0 + standard.z) - standard.z;
        let around = (1.0 - z * z).max(0.0).sqrt() * Vec2::from_angle(TAU * u);
        let h = around.extend(z) + standard;
        let h = Vec3::new(brdf.alpha * h.x, brdf.alpha * h.y, h.z.max(0.0)).normalize_or(Vec3::Z);
        let mirrored = 2.0 * viewer.dot(h) * h - viewer;
        (mirrored.x * x_axis + mirrored.y * y_axis + mirrored.z * *normal).normalize()
    }

    /// G₁(v) D(h) / (4 n·v) of directions mirrored in visible normals (Heitz 2018, eq. 17).
    fn visible_normal_density(&self, direction: Vec3) -> f32 {
        let SurfacePoint { normal, brdf, .. } = self.point;
        let n_v = normal.dot(self.to_viewer);
        let Some(h) = (self.to_viewer + direction).try_normalize() else { return 0.0 };
        if normal.dot(h) <= 0.0 {
            return 0.0;
        }
        let a2 = brdf.alpha * brdf.alpha;
        let masking = n_v + (a2 + (1.0 - a2) * n_v * n_v).sqrt();
        brdf.distribution(*normal, h) / (2.0 * masking)
    }
}

/// A direction with density cos/π about `normal`.
fn cosine([u, v]: [f32; 2], normal: Vec3) -> Vec3 {
    let (x_axis, y_axis) = normal.any_orthonormal_pair();
    let disc = v.sqrt() * Vec2::from_angle(TAU * u);
    disc.x * x_axis + disc.y * y_axis + (1.0 - v).sqrt() * normal
}

#[cfg(test)]
mod tests;
