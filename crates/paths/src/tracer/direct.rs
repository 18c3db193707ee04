//! What reaches a vertex straight from lights: points, emissive triangles, lights with a surface.

use glam::{DVec3, Vec3};
use manylights_scene::bvh::Ray;
use manylights_scene::{Light, SurfacePoint, Visibility};

use super::{GROUP_AREA_LIGHT, GROUP_AREA_LIGHT_SEARCH, Walk};
use crate::area_lights::AreaLit;
use crate::illumination::{Lit, may_arrive, reflected};
use crate::lobe::Lobes;

impl Walk<'_> {
    /// The sum of `count` samples of the direct light of all lights with a surface, which nothing hides.
    pub(super) fn unhidden(&self, point: &SurfacePoint, to_viewer: Vec3, count: u32) -> Vec3 {
        let lobes = Lobes::new(point, to_viewer);
        let sampler = self.sampler;
        let numbers: Vec<_> =
            (0..count).map(|index| sampler.group(GROUP_AREA_LIGHT, index)).collect();
        // A Lambertian lobe varies too little over the directions of a light for its own to help.
        let searching = if point.brdf.has_specular() { 0..count } else { 0..0 };
        let scatters: Vec<_> = searching
            .map(|index| lobes.sample(sampler.group(GROUP_AREA_LIGHT_SEARCH, index)))
            .collect();
        self.tracer.area_lights.unhidden(&lobes, point, &numbers, &scatters).as_vec3()
    }

    /// One sample of the direct light of lights that are no surfaces, behind those that are: one of the
    /// lights, and one direction drawn from the reflectance.
    pub(super) fn behind_surfaces(
        &mut self,
        point: &SurfacePoint,
        to_viewer: Vec3,
        index: u32,
    ) -> Vec3 {
        let lights = &self.tracer.area_lights;
        let lobes = Lobes::new(point, to_viewer);
        let searches = point.brdf.has_specular();
        let numbers = self.sampler.group(GROUP_AREA_LIGHT, index);
        let mut radiance = DVec3::ZERO;
        if let Some(lit) = lights.sample(&lobes, point, numbers, searches) {
            radiance += self.arriving(point, &lit);
        }
        let numbers = self.sampler.group(GROUP_AREA_LIGHT_SEARCH, index);
        if let Some(scatter) = lobes.sample(numbers).filter(|_| searches) {
            for lit in lights.found(point, &scatter) {
                radiance += self.arriving(point, &lit);
            }
        }
        radiance.as_vec3()
    }

    /// What surfaces let through. A light that lies on one is in front of it: the ray ends before.
    fn arriving(&mut self, point: &SurfacePoint, lit: &AreaLit) -> DVec3 {
        if lit.radiance == DVec3::ZERO || !may_arrive(point, lit.direction, Visibility::Traced) {
            return DVec3::ZERO;
        }
        let reach = lit.distance - self.tracer.bvh.shift();
        let target = point.position + reach * lit.direction;
        let ray = Ray::between(self.origin(point, lit.direction), target);
        if reach > 0.0 && self.occluded(&ray) { DVec3::ZERO } else { lit.radiance }
    }

    /// Direct illumination by emissive triangles through a point on one of them; `shared` where a
    /// direction drawn from the surface may find it, too, and counts with the other part of the
    /// balance heuristic (Veach 1997, eq. 9.8).
    pub(super) fn emitter(
        &mut self,
        lobes: &Lobes<'_>,
        point: &SurfacePoint,
        numbers: [f32; 2],
        shared: bool,
    ) -> Vec3 {
        let emitter = self.tracer.emitters.sample(numbers);
        let offset = emitter.position - point.position;
        let distance2 = offset.length_squared();
        // No direction: neither normal faces it.
        if distance2 == 0.0 {
            return Vec3::ZERO;
        }
        let direction = offset / distance2.sqrt();
        let towards = -emitter.normal.dot(direction);
        let side = if emitter.two_sided { towards.signum() } else { 1.0 };
        let cos_emitter = side * towards;
        if cos_emitter <= 0.0 || !may_arrive(point, direction, Visibility::Traced) {
            return Vec3::ZERO;
        }
        let reflected = lobes.reflect(direction);
        if reflected == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let target = self.tracer.bvh.shifted(emitter.position, side * emitter.normal);
        if self.occluded(&Ray::between(self.origin(point, direction), target)) {
            return Vec3::ZERO;
        }
        let geometry = cos_emitter / distance2;
        let competing = if shared { lobes.density(direction) * geometry } else { 0.0 };
        let density = emitter.density + competing;
        reflected * emitter.radiance * (geometry / density)
    }

    /// Calls `visit` for each point-like light that illuminates `point`.
    pub(super) fn lit(
        &mut self,
        point: &SurfacePoint,
        to_viewer: Vec3,
        visibility: Visibility,
        mut visit: impl FnMut(Lit),
    ) {
        for (light, source) in self.tracer.scene.lights.iter().enumerate() {
            let at = source.illuminate(point.position);
            if !may_arrive(point, at.to_light, visibility) {
                continue;
            }
            let radiance = reflected(point, to_viewer, &at);
            if radiance == Vec3::ZERO {
                continue;
            }
            if visibility == Visibility::Ignored {
                visit(Lit { light, at, radiance });
                continue;
            }
            let origin = self.origin(point, at.to_light);
            let ray = match *source {
                Light::Point { position, .. } | Light::Spot { position, .. } => {
                    Ray::between(origin, position)
                }
                Light::Directional { direction, .. } => Ray::new(origin, -direction),
            };
            if !self.occluded(&ray) {
                visit(Lit { light, at, radiance });
            }
        }
    }
}
