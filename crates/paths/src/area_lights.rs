//! Direct light from lights with a surface, each sampled over the solid angle that it covers.

mod cap;
mod spherical_triangle;
mod subtended;

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use manylights_scene::{AreaLight, SurfacePoint};

use crate::lobe::{Lobes, Scatter};
use crate::sampler::rotation;
use subtended::Subtended;

/// Lights with a surface, for points that look at them.
#[derive(Debug, Default)]
pub(crate) struct AreaLights {
    lights: Vec<Source>,
    /// Lower ends of the lights' shares of the power.
    shares: Vec<f64>,
    /// W, mean of the channels.
    power: f64,
}

/// One light.
#[derive(Debug)]
struct Source {
    light: AreaLight,
    /// The triangle of the scene that it is: no point of it sees it, whatever the point's rounding says.
    triangle: Option<u32>,
    /// Of the sample points (Cranley and Patterson 1976), so that strata stay strata and lights are
    /// decorrelated.
    rotation: [f32; 2],
}

/// A direction in which a light may illuminate a point.
pub(crate) struct AreaLit {
    /// Unit, from the point.
    pub(crate) direction: Vec3,
    /// To the light's surface, metres; 0 from inside a sphere.
    pub(crate) distance: f32,
    /// Towards the viewer, divided by the density of the direction and weighed.
    pub(crate) radiance: DVec3,
}

impl AreaLights {
    /// Each with the triangle of the scene that it is, where it is one.
    pub(crate) fn new(lights: impl Iterator<Item = (AreaLight, Option<u32>)>) -> Self {
        let mut all = Self::default();
        for (index, (light, triangle)) in (0..).zip(lights) {
            let source = Source { light, triangle, rotation: rotation(index) };
            // What is dark cannot be chosen by its power.
            if source.power() != 0.0 {
                all.lights.push(source);
            }
        }
        for source in &all.lights {
            all.shares.push(all.power);
            all.power += source.power();
        }
        for share in &mut all.shares {
            *share /= all.power;
        }
        all
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    /// Whether all their numbers are: else there is no picture.
    pub(crate) fn are_finite(&self) -> bool {
        self.power.is_finite()
    }

    /// The sum over `numbers` of samples of all lights, each sampled once for each pair of numbers, where
    /// nothing hides anything. Directions drawn from the reflectance (`scatters`, as many as there are
    /// numbers, or none for a surface that needs none) gather every light that they cross; a
    /// heuristic weighs them light by light.
    pub(crate) fn unhidden(
        &self,
        lobes: &Lobes<'_>,
        point: &SurfacePoint,
        numbers: &[[f32; 2]],
        scatters: &[Option<Scatter>],
    ) -> DVec3 {
        // Also where all draws come to nothing: a weight that hangs on them is biased.
        let competes = !scatters.is_empty();
        let scatters: Vec<_> = scatters
            .iter()
            .flatten()
            .map(|scatter| (scatter, scatter.direction.as_dvec3().normalize()))
            .collect();
        let mut sum = DVec3::ZERO;
        for source in &self.lights {
            let Some(subtended) = source.seen_from(point) else { continue };
            let density = 1.0 / subtended.solid_angle();
            let mut reflected = DVec3::ZERO;
            for numbers in numbers {
                let direction = subtended.sample(rotated(*numbers, source.rotation)).as_vec3();
                reflected += reflected_over_density(lobes, direction, density, competes);
            }
            for (scatter, direction) in &scatters {
                if subtended.contains(*direction) {
                    reflected += found_over_density(scatter, density);
                }
            }
            sum += reflected * source.light.radiance().as_dvec3();
        }
        sum
    }

    /// A light chosen by power, in a direction uniform in its solid angle; `competes` where directions
    /// drawn from the reflectance find it, too.
    pub(crate) fn sample(
        &self,
        lobes: &Lobes<'_>,
        point: &SurfacePoint,
        [u, v, choice]: [f32; 3],
        competes: bool,
    ) -> Option<AreaLit> {
        let choice = f64::from(choice);
        let index = self.shares.partition_point(|&share| share <= choice).saturating_sub(1);
        let source = &self.lights[index];
        let subtended = source.seen_from(point)?;
        let direction = subtended.sample([u.into(), v.into()]);
        let density = source.power() / self.power / subtended.solid_angle();
        let reflected = reflected_over_density(lobes, direction.as_vec3(), density, competes);
        Some(AreaLit {
            direction: direction.as_vec3(),
            distance: subtended.distance(direction) as f32,
            radiance: reflected * source.light.radiance().as_dvec3(),
        })
    }

    /// The lights that a direction drawn from the reflectance crosses.
    pub(crate) fn found(
        &self,
        point: &SurfacePoint,
        scatter: &Scatter,
    ) -> impl Iterator<Item = AreaLit> {
        let direction = scatter.direction.as_dvec3().normalize();
        self.lights.iter().filter_map(move |source| {
            let subtended = source.seen_from(point).filter(|set| set.contains(direction))?;
            let density = source.power() / self.power / subtended.solid_angle();
            Some(AreaLit {
                direction: scatter.direction,
                distance: subtended.distance(direction) as f32,
                radiance: found_over_density(scatter, density) * source.light.radiance().as_dvec3(),
            })
        })
    }
}

impl Source {
    fn seen_from(&self, point: &SurfacePoint) -> Option<Subtended> {
        if self.triangle == Some(point.triangle) {
            return None;
        }
        Subtended::new(&self.light, point.position, point.normal)
    }

    /// W, mean of the channels; of f64, since that of a small or large light may leave f32. Not finite
    /// where any number of the light is not.
    fn power(&self) -> f64 {
        let radiance = self.light.radiance().as_dvec3().element_sum() / 3.0;
        match self.light {
            AreaLight::Sphere { center, .. } if !center.is_finite() => f64::NAN,
            AreaLight::Sphere { radius, .. } => {
                4.0 * PI * PI * f64::from(radius) * f64::from(radius) * radiance
            }
            AreaLight::Triangle { corners, two_sided, .. } => {
                let [a, b, c] = corners.map(Vec3::as_dvec3);
                let sides = if two_sided { 2.0 } else { 1.0 };
                0.5 * sides * PI * (b - a).cross(c - a).length() * radiance
            }
        }
    }
}

/// f · cos over the density of a direction drawn from a light, weighed where directions drawn from the
/// reflectance compete.
fn reflected_over_density(
    lobes: &Lobes<'_>,
    direction: Vec3,
    density: f64,
    competes: bool,
) -> DVec3 {
    let reflected = lobes.reflect(direction).as_dvec3() / density;
    if competes { reflected * weight(density, lobes.density(direction).into()) } else { reflected }
}

/// The same for a direction drawn from the reflectance.
fn found_over_density(scatter: &Scatter, density: f64) -> DVec3 {
    scatter.weight.as_dvec3() * weight(scatter.density.into(), density)
}

/// The power heuristic of exponent 2 (Veach 1997, section 9.2.4). By the balance heuristic a direction
/// that finds a small light would count with all that the light sends, too rarely for any estimate of the
/// variance to know.
fn weight(density: f64, other: f64) -> f64 {
    1.0 / (1.0 + (other / density).powi(2))
}

fn rotated(numbers: [f32; 2], by: [f32; 2]) -> [f64; 2] {
    [0, 1].map(|axis| (f64::from(numbers[axis]) + f64::from(by[axis])).fract())
}

#[cfg(test)]
mod tests;
