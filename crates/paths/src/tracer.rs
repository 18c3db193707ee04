//! Radiance along light paths.

use glam::Vec3;
use manylights_scene::bvh::{Bvh, Hit, Ray};
use manylights_scene::light::Illumination;
use manylights_scene::{Light, Scene, SurfacePoint};
use manylights_scene::{Transport, Visibility};

use crate::beams::Beams;
use crate::emitters::Emitters;
use crate::lobe::Lobes;
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

/// A scene made ready for one transport.
pub struct Tracer<'a> {
    scene: &'a Scene,
    bvh: Bvh,
    emitters: Emitters,
    beams: Option<Beams<'a>>,
    /// Direct illumination counts at these vertices of a path; the primary hit is vertex 0.
    first: u32,
    last: u32,
    visibility: Visibility,
}

/// The walk of one pixel through one slice. Counts its rays.
pub struct Walk<'a> {
    tracer: &'a Tracer<'a>,
    sampler: Sampler,
    /// Cast so far.
    pub rays: u64,
}

/// Direct illumination by one point-like light.
struct Lit {
    light: usize,
    at: Illumination,
    radiance: Vec3,
}

impl<'a> Tracer<'a> {
    /// Builds what rays are cast against.
    pub fn new(scene: &'a Scene, transport: Transport) -> Self {
        let (first, last, visibility) = match transport {
            Transport::Direct => (0, 0, Visibility::Traced),
            Transport::Indirect { bounces, visibility } => (1, bounces, visibility),
            Transport::All => (0, u32::MAX, Visibility::Traced),
        };
        Self {
            scene,
            bvh: Bvh::build(scene),
            emitters: Emitters::new(scene),
            beams: if last > 0 { Beams::new(scene) } else { None },
            first,
            last,
            visibility,
        }
    }

    /// Whether there is anything to sample: direct light from point-like lights is exact.
    pub fn is_random(&self) -> bool {
        let lit = !self.scene.lights.is_empty() && self.last > 0;
        lit || !self.emitters.is_empty()
    }

    /// The first hit along a ray.
    pub fn closest(&self, ray: &Ray) -> Option<Hit> {
        self.bvh.closest(ray)
    }

    /// What the camera sees at a primary hit.
    pub fn primary(&self, hit: Hit, direction: Vec3) -> SurfacePoint {
        self.scene.surface(hit.triangle, hit.u, hit.v, direction).facing(-direction)
    }

    /// A walk over these sample points.
    pub fn walk(&'a self, sampler: Sampler) -> Walk<'a> {
        Walk { tracer: self, sampler, rays: 0 }
    }
}

impl Walk<'_> {
    /// The part of the radiance that needs no sampling: emission and point-like lights seen directly.
    pub fn exact(&mut self, point: &SurfacePoint, to_viewer: Vec3) -> Vec3 {
        if self.tracer.first > 0 {
            return Vec3::ZERO;
        }
        let mut radiance = point.emission;
        self.lit(point, to_viewer, |lit| radiance += lit.radiance);
        radiance
    }

    /// One sample of the remaining radiance.
    pub fn sample(&mut self, point: &SurfacePoint, to_viewer: Vec3, index: u32) -> Vec3 {
        let beam = match &self.tracer.beams {
            Some(beams) => self.beam(beams, point, to_viewer, index),
            None => Vec3::ZERO,
        };
        let path = match self.tracer.visibility {
            Visibility::Traced => self.path(*point, to_viewer, index),
            Visibility::Ignored => self.through(point, to_viewer, index),
        };
        path + beam
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
            // Whether the next ray of the path looks for emitters, too.
            let searches =
                counts && (point.brdf.has_specular() || !tracer.emitters.are_far(point.position));
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
            if searches && next.emission != Vec3::ZERO {
                let density = area_density(scatter.density, &point, &next);
                let weight = density / (density + tracer.emitters.density(&next));
                radiance += throughput * weight * next.emission;
            }
            if depth == tracer.last {
                break;
            }
            let beams = if depth == 0 { tracer.beams.as_ref() } else { None };
            let density = area_density(scatter.density, &point, &next);
            self.lit(&next, -scatter.direction, |lit| {
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
            self.lit(&next, -scatter.direction, |lit| {
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
        if self.tracer.visibility == Visibility::Ignored {
            return true;
        }
        if point.geometric_normal.dot(next.position - point.position) <= 0.0 {
            return false;
        }
        self.rays += 1;
        let [from, to] = [point, next].map(|point| [point.position, point.geometric_normal]);
        self.tracer.bvh.sees(from, to)
    }

    /// Direct illumination by emissive triangles through a point on one of them; `shared` where a
    /// direction drawn from the surface may find it, too, and counts with the other part of the
    /// balance heuristic (Veach 1997, eq. 9.8).
    fn emitter(
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
        let cos_emitter = -emitter.normal.dot(direction);
        if cos_emitter <= 0.0 || point.geometric_normal.dot(direction) <= 0.0 {
            return Vec3::ZERO;
        }
        let reflected = lobes.reflect(direction);
        if reflected == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let target = self.tracer.bvh.shifted(emitter.position, emitter.normal);
        if self.occluded(&Ray::between(self.origin(point, direction), target)) {
            return Vec3::ZERO;
        }
        let geometry = cos_emitter / distance2;
        let competing = if shared { lobes.density(direction) * geometry } else { 0.0 };
        let density = emitter.density + competing;
        reflected * emitter.radiance * (geometry / density)
    }

    /// Calls `visit` for each point-like light that illuminates `point`.
    fn lit(&mut self, point: &SurfacePoint, to_viewer: Vec3, mut visit: impl FnMut(Lit)) {
        for (light, source) in self.tracer.scene.lights.iter().enumerate() {
            let at = source.illuminate(point.position);
            let radiance = reflected(point, to_viewer, &at);
            if radiance == Vec3::ZERO {
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

/// Radiance towards `to_viewer` of a point that a light illuminates; zero where the light is behind
/// either normal.
fn reflected(point: &SurfacePoint, to_viewer: Vec3, at: &Illumination) -> Vec3 {
    let cos = point.normal.dot(at.to_light);
    if cos <= 0.0 || point.geometric_normal.dot(at.to_light) <= 0.0 || at.irradiance == Vec3::ZERO {
        return Vec3::ZERO;
    }
    point.brdf.eval(point.normal, to_viewer, at.to_light) * at.irradiance * cos
}

/// A density over solid angle at `from` as one over area at `to`, m⁻².
fn area_density(density: f32, from: &SurfacePoint, to: &SurfacePoint) -> f32 {
    let offset = to.position - from.position;
    let distance2 = offset.length_squared();
    density * to.geometric_normal.dot(offset).abs() / (distance2 * distance2.sqrt())
}

/// Weight of a camera path of area density `density` against the path from the light.
fn beam_weight(beams: Option<&Beams<'_>>, density: f32, point: &SurfacePoint, lit: &Lit) -> f32 {
    match beams {
        Some(beams) => density / (density + beams.density(lit.light, point, &lit.at)),
        None => 1.0,
    }
}
