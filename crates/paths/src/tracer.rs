//! Radiance along light paths.

mod direct;

use glam::Vec3;
use manylights_scene::bvh::{Bvh, Hit, Ray};
use manylights_scene::{Scene, SurfacePoint};
use manylights_scene::{Transport, Visibility};

use crate::area_lights::AreaLights;
use crate::beams::Beams;
use crate::emitters::Emitters;
use crate::illumination::{area_density, beam_weight, may_arrive, reflected};
use crate::lobe::{Lobes, Scatter};
use crate::sampler::Sampler;

/// Bounces after which Russian roulette may end a path.
const ROULETTE_FROM: u32 = 3;
/// Highest probability of survival: ends paths in scenes that absorb nothing.
const MAX_SURVIVAL: f32 = 0.95;

/// Group of sample points for the emitter seen from the primary hit.
const GROUP_EMITTER: u32 = 0;
/// Group of sample points for the path that starts at a light.
const GROUP_BEAM: u32 = 1;
/// First of the groups of bounces.
const GROUP_BOUNCES: u32 = 2;
/// Group of sample points for lights sampled by solid angle, above all bounces.
const GROUP_AREA_LIGHT: u32 = u32::MAX;
/// Group of sample points for directions that look for them.
const GROUP_AREA_LIGHT_SEARCH: u32 = u32::MAX - 1;

/// A scene made ready for one transport.
pub struct Tracer<'a> {
    scene: &'a Scene,
    bvh: Bvh,
    emitters: Emitters,
    /// Of direct light: those that are no surfaces, and where visibility is ignored all others.
    area_lights: AreaLights,
    beams: Option<Beams<'a>>,
    /// Whether the camera sees emission.
    emission: bool,
    /// Of the direct light of point-like lights at the primary hit, where it counts.
    exact: Option<Visibility>,
    /// Illumination counts at these vertices of a sampled path; the primary hit is vertex 0.
    first: u32,
    last: u32,
    /// Of the last segment of a sampled path.
    visibility: Visibility,
}

/// The walk of one pixel through one slice. Counts its rays.
pub struct Walk<'a> {
    tracer: &'a Tracer<'a>,
    sampler: Sampler,
    /// Cast so far.
    pub rays: u64,
}

impl<'a> Tracer<'a> {
    /// Builds what rays are cast against.
    pub fn new(scene: &'a Scene, transport: Transport) -> Self {
        let traced = Visibility::Traced;
        let (exact, first, last, visibility) = match transport {
            Transport::Direct { visibility } => (Some(visibility), 0, 0, visibility),
            Transport::Indirect { bounces, visibility } => (None, 1, bounces, visibility),
            Transport::DirectAndIndirect { visibility } => (Some(traced), 1, 1, visibility),
            Transport::All => (Some(traced), 0, u32::MAX, traced),
        };
        Self {
            scene,
            bvh: Bvh::build(scene),
            emitters: Emitters::new(scene),
            area_lights: area_lights(scene, transport),
            beams: if last > 0 { Beams::new(scene) } else { None },
            emission: transport == Transport::All,
            exact,
            first,
            last,
            visibility,
        }
    }

    /// Whether there is anything to sample: direct light from point-like lights is exact.
    pub fn is_random(&self) -> bool {
        let lit = !self.scene.lights.is_empty() && self.last > 0;
        lit || !self.emitters.is_empty() || !self.area_lights.is_empty()
    }

    /// The first hit along a ray.
    pub fn closest(&self, ray: &Ray) -> Option<Hit> {
        self.bvh.closest(ray)
    }

    /// What the camera sees at a primary hit.
    pub fn primary(&self, hit: Hit, direction: Vec3) -> SurfacePoint {
        self.scene.surface(hit.triangle, hit.u, hit.v, direction).facing(-direction)
    }

    /// Whether directions that are drawn from a surface look for emitters, beside points drawn on
    /// these.
    fn searches(&self, point: &SurfacePoint) -> bool {
        point.brdf.has_specular() || !self.emitters.are_far(point.position)
    }

    /// Weight of the emission at a point that a direction found: the balance heuristic. Zero where
    /// nothing is emitted.
    fn found(&self, scatter: &Scatter, from: &SurfacePoint, next: &SurfacePoint) -> f32 {
        if next.emission == Vec3::ZERO {
            return 0.0;
        }
        let density = area_density(scatter.density, from, next);
        let two_sided = self.scene.material_of(next.triangle).two_sided;
        density / (density + self.emitters.density(next, two_sided))
    }

    /// A walk over these sample points.
    pub fn walk(&'a self, sampler: Sampler) -> Walk<'a> {
        Walk { tracer: self, sampler, rays: 0 }
    }
}

impl Walk<'_> {
    /// The part of the radiance that needs no sampling: emission that the camera sees, and the direct
    /// light of point-like lights.
    pub fn exact(&mut self, point: &SurfacePoint, to_viewer: Vec3) -> Vec3 {
        let mut radiance = if self.tracer.emission { point.emission } else { Vec3::ZERO };
        if let Some(visibility) = self.tracer.exact {
            self.lit(point, to_viewer, visibility, |lit| radiance += lit.radiance);
        }
        radiance
    }

    /// The sum of the first `count` samples of the remaining radiance, at most [`SLICE`](crate::SLICE).
    pub fn samples(&mut self, point: &SurfacePoint, to_viewer: Vec3, count: u32) -> Vec3 {
        if !self.tracer.area_lights.are_finite() {
            return Vec3::NAN;
        }
        match (self.tracer.visibility, self.tracer.last) {
            (Visibility::Ignored, 0) => self.unhidden(point, to_viewer, count),
            _ => (0..count).map(|index| self.sample(point, to_viewer, index)).sum(),
        }
    }

    fn sample(&mut self, point: &SurfacePoint, to_viewer: Vec3, index: u32) -> Vec3 {
        let beam = match &self.tracer.beams {
            Some(beams) => self.beam(beams, point, to_viewer, index),
            None => Vec3::ZERO,
        };
        let path = match self.tracer.visibility {
            Visibility::Traced => self.path(*point, to_viewer, index),
            Visibility::Ignored => self.through(point, to_viewer, index),
        };
        if self.tracer.area_lights.is_empty() {
            return path + beam;
        }
        path + beam + self.behind_surfaces(point, to_viewer, index)
    }

    /// A path from the camera.
    fn path(&mut self, mut point: SurfacePoint, mut to_viewer: Vec3, index: u32) -> Vec3 {
        let tracer = self.tracer;
        let emitters = !tracer.emitters.is_empty();
        let mut emitter_numbers = if emitters && tracer.first == 0 {
            self.sampler.group(GROUP_EMITTER, index)
        } else {
            [0.0; 2] // not used
        };
        let mut radiance = Vec3::ZERO;
        let mut throughput = Vec3::ONE;
        for depth in 0..=tracer.last {
            let lobes = Lobes::new(&point, to_viewer);
            let counts = emitters && depth >= tracer.first;
            let searches = counts && tracer.searches(&point);
            if counts {
                radiance += throughput * self.emitter(&lobes, &point, emitter_numbers, searches);
            }
            if depth == tracer.last && !searches {
                break;
            }
            let (numbers, next_numbers) = self.bounce_numbers(depth, index);
            let Some(scatter) = lobes.sample(numbers) else { break };
            if point.geometric_normal.dot(scatter.direction) <= 0.0 {
                break;
            }
            throughput *= scatter.weight;
            if !self.survives(&mut throughput, depth, index) {
                break;
            }
            let Some(next) = self.next(&point, scatter.direction) else { break };
            if searches {
                radiance += throughput * tracer.found(&scatter, &point, &next) * next.emission;
            }
            if depth == tracer.last {
                break;
            }
            let beams = if depth == 0 { tracer.beams.as_ref() } else { None };
            let density = area_density(scatter.density, &point, &next);
            self.lit(&next, -scatter.direction, Visibility::Traced, |lit| {
                radiance += throughput * lit.radiance * beam_weight(beams, density, &next, &lit);
            });
            (point, to_viewer, emitter_numbers) = (next, -scatter.direction, next_numbers);
        }
        radiance
    }

    /// A path of one bounce whose last segment passes through everything.
    fn through(&mut self, point: &SurfacePoint, to_viewer: Vec3, index: u32) -> Vec3 {
        let tracer = self.tracer;
        let (numbers, next_numbers) = self.bounce_numbers(0, index);
        let Some(scatter) = Lobes::new(point, to_viewer).sample(numbers) else { return Vec3::ZERO };
        let mut radiance = Vec3::ZERO;
        let ray = Ray::new(self.origin(point, scatter.direction), scatter.direction);
        self.rays += 1;
        tracer.bvh.all_hits(&ray, |hit| {
            let next = tracer.scene.surface(hit.triangle, hit.u, hit.v, scatter.direction);
            let density = area_density(scatter.density, point, &next);
            self.lit(&next, -scatter.direction, Visibility::Traced, |lit| {
                radiance += lit.radiance * beam_weight(tracer.beams.as_ref(), density, &next, &lit);
            });
            if !tracer.emitters.is_empty() {
                let lobes = Lobes::new(&next, -scatter.direction);
                radiance += self.emitter(&lobes, &next, next_numbers, false);
            }
        });
        scatter.weight * radiance
    }

    /// A path of one bounce that starts at a light.
    fn beam(
        &mut self,
        beams: &Beams<'_>,
        point: &SurfacePoint,
        to_viewer: Vec3,
        index: u32,
    ) -> Vec3 {
        let tracer = self.tracer;
        let (light, ray) = beams.sample(self.sampler.group(GROUP_BEAM, index));
        self.rays += 1;
        let Some(hit) = tracer.bvh.closest(&ray) else { return Vec3::ZERO };
        let next = tracer.scene.surface(hit.triangle, hit.u, hit.v, ray.direction);
        let offset = next.position - point.position;
        let distance2 = offset.length_squared();
        // No direction: neither normal faces it.
        if distance2 == 0.0 {
            return Vec3::ZERO;
        }
        let to_next = offset / distance2.sqrt();
        let cos_next = -next.geometric_normal.dot(to_next);
        if cos_next <= 0.0 {
            return Vec3::ZERO;
        }
        let at = tracer.scene.lights[light].illuminate(next.position);
        let lobes = Lobes::new(point, to_viewer);
        if !may_arrive(&next, at.to_light, Visibility::Traced) {
            return Vec3::ZERO;
        }
        let radiance = reflected(&next, -to_next, &at) * lobes.reflect(to_next);
        if radiance == Vec3::ZERO || !self.connected(point, &next) {
            return Vec3::ZERO;
        }
        let density = lobes.density(to_next) * cos_next / distance2;
        let own = beams.density(light, &next, &at);
        radiance * (cos_next / (distance2 * (density + own)))
    }

    /// Whether the segment of a path that starts at a light may carry light to `point`.
    fn connected(&mut self, point: &SurfacePoint, next: &SurfacePoint) -> bool {
        let visibility = self.tracer.visibility;
        if visibility == Visibility::Ignored {
            return true;
        }
        if !may_arrive(point, next.position - point.position, visibility) {
            return false;
        }
        self.rays += 1;
        let [from, to] = [point, next].map(|point| [point.position, point.geometric_normal]);
        self.tracer.bvh.sees(from, to)
    }

    /// The numbers that choose a direction at a vertex, and those for a point on an emitter as the
    /// next vertex sees it, where there are any: stratified together.
    fn bounce_numbers(&self, depth: u32, index: u32) -> ([f32; 2], [f32; 2]) {
        let group = GROUP_BOUNCES + depth;
        if self.tracer.emitters.is_empty() || depth >= self.tracer.last {
            return (self.sampler.group(group, index), [0.0; 2]);
        }
        let [a, b, c, d] = self.sampler.group(group, index);
        ([a, b], [c, d])
    }

    /// Russian roulette on the throughput; unbiased.
    fn survives(&mut self, throughput: &mut Vec3, depth: u32, index: u32) -> bool {
        if self.tracer.last != u32::MAX || depth < ROULETTE_FROM {
            return true;
        }
        let survival = throughput.max_element().min(MAX_SURVIVAL);
        if self.sampler.independent(depth, index) >= survival {
            return false;
        }
        *throughput /= survival;
        true
    }

    fn next(&mut self, point: &SurfacePoint, direction: Vec3) -> Option<SurfacePoint> {
        self.rays += 1;
        let hit = self.tracer.bvh.closest(&Ray::new(self.origin(point, direction), direction))?;
        Some(self.tracer.scene.surface(hit.triangle, hit.u, hit.v, direction))
    }

    fn occluded(&mut self, ray: &Ray) -> bool {
        self.rays += 1;
        self.tracer.bvh.occluded(ray)
    }

    /// Origin of a ray that leaves `point` in `direction`, on whichever side that is.
    fn origin(&self, point: &SurfacePoint, direction: Vec3) -> Vec3 {
        let side = point.geometric_normal.dot(direction).signum();
        self.tracer.bvh.shifted(point.position, side * point.geometric_normal)
    }
}

/// The lights with a surface that a transport samples by solid angle.
fn area_lights(scene: &Scene, transport: Transport) -> AreaLights {
    let analytic = scene.area_lights.iter().map(|light| (*light, None));
    match transport {
        Transport::Direct { visibility: Visibility::Traced } => AreaLights::new(analytic),
        Transport::Direct { visibility: Visibility::Ignored } => {
            let none = std::iter::repeat_n(None, scene.area_lights.len());
            let triangles = none.chain(scene.emissive_triangles().map(Some));
            AreaLights::new(scene.all_area_lights().zip(triangles))
        }
        _ => AreaLights::default(),
    }
}
