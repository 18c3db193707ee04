//! Sets of lights with a surface: `[[lights]]`.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use serde::Deserialize;

use super::arrangement::{self, Arrangement, Pose};
use super::checks::{LENGTHS, direction, number, position, radiance, vector};
use super::document::Document;
use super::light::add_area_lights;
use super::panel::{self, Panel};
use super::picture;
use super::random::Random;
use crate::{AreaLight, LoadError, Scene, image_file};

/// Most lights with a surface in a scene.
const MAX_LIGHTS: usize = 1 << 20;

/// Lights of one shape, size and power. Which of the optional keys there are depends on the
/// arrangement.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightSetSpec {
    arrangement: Arrangement,
    of: Shape,
    count: u32,
    /// Of a cloud's places, and of the turn of a ring and a shell.
    seed: Option<u64>,
    /// Metres.
    center: [f32; 3],
    /// Of the ring or the shell, metres.
    radius: Option<f32>,
    /// Sides of the cloud's box along x, y and z, or of the panel to its right and up, metres.
    extent: Option<Vec<f32>>,
    /// Axis of the ring, or the direction that the panel faces.
    normal: Option<[f32; 3]>,
    /// Towards the panel's top.
    up: Option<[f32; 3]>,
    /// Radius of a sphere or circumradius of a triangle, metres.
    size: Option<f32>,
    /// Of the whole set, W.
    power: [f32; 3],
    /// Of the panel: a PNG or JPEG file.
    picture: Option<String>,
    /// Of triangles: whether their backs shine, too.
    two_sided: Option<bool>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Shape {
    Spheres,
    Triangles,
}

impl LightSetSpec {
    /// Appends the lights to the scene.
    pub(super) fn add(
        &self,
        scene: &mut Scene,
        document: &Document,
        place: &str,
    ) -> Result<(), LoadError> {
        self.check_count(scene, place)?;
        self.check_keys(place)?;
        let power = radiance(place, "power", self.power)?;
        let lights = self.lights(scene, document, place)?;
        let area: f64 = lights.iter().map(|light| f64::from(light.area())).sum();
        let mean = power.as_dvec3() / (PI * area);
        let bright =
            |light: AreaLight| light.with_radiance((light.radiance().as_dvec3() * mean).as_vec3());
        add_area_lights(scene, place, lights.into_iter().map(bright))
    }

    /// The lights, of the mean radiance 1.
    fn lights(
        &self,
        scene: &mut Scene,
        document: &Document,
        place: &str,
    ) -> Result<Vec<AreaLight>, LoadError> {
        let random = &mut Random::new(self.seed.unwrap_or_default());
        let center = position(place, "center", self.center)?.as_dvec3();
        let poses = match self.arrangement {
            Arrangement::Ring => {
                let normal = self.normal(place)?;
                arrangement::ring(self.count, center, self.radius(place)?, normal, random)
            }
            Arrangement::Shell => {
                arrangement::shell(self.count, center, self.radius(place)?, random)
            }
            Arrangement::Cloud => {
                let sides = DVec3::from(self.extent(place)?);
                arrangement::cloud(self.count, center, sides, random)
            }
            Arrangement::Panel => return self.panel(center, scene, document, place),
        };
        let size = number(place, "size", self.needed("size", self.size, place)?, LENGTHS)?;
        Ok(poses.iter().map(|pose| self.light(pose, size)).collect())
    }

    /// Lights after the panel's picture, or all alike.
    fn panel(
        &self,
        center: DVec3,
        scene: &mut Scene,
        document: &Document,
        place: &str,
    ) -> Result<Vec<AreaLight>, LoadError> {
        let of_a_texel = match self.of {
            Shape::Spheres => 1,
            Shape::Triangles => 2,
        };
        let texels = panel::texels(self.count, of_a_texel, place)?;
        let normal = self.normal(place)?;
        let up = vector(place, "up", self.up.unwrap_or(Vec3::Y.into()))?;
        let across = direction(place, "up", up)?.as_dvec3().cross(normal);
        let parallel = || {
            let problem = "up is parallel to normal";
            LoadError::new(place, problem, "give the direction of the panel's top as `up`")
        };
        // What single precision leaves of parallel directions.
        let right = Some(across).filter(|across| across.length() > 1e-6).ok_or_else(parallel)?;
        let right = right.normalize();
        let sides = self.extent(place)?;
        let panel = Panel { center, right, up: normal.cross(right), sides, texels };
        let lights: Vec<_> = match self.of {
            Shape::Spheres => panel.spheres().collect(),
            Shape::Triangles => panel.triangles(self.two_sided()).collect(),
        };
        let Some(name) = &self.picture else { return Ok(lights) };
        let path = document.located(name)?;
        let picture = image_file::load(&path).map_err(|error| error.within(place))?;
        scene.sources.push(path);
        picture::tinted(lights, &picture, texels).ok_or_else(|| {
            let problem = format!("the picture `{name}` is black");
            LoadError::new(place, problem, "use one that shines somewhere")
        })
    }

    /// Of the radiance 1 and this radius, metres; a triangle points to the frame's top.
    fn light(&self, pose: &Pose, size: f32) -> AreaLight {
        let Pose { center, right, up } = *pose;
        let half_width = 0.5 * 3_f64.sqrt();
        let corner = |x: f64, y: f64| (center + f64::from(size) * (x * right + y * up)).as_vec3();
        match self.of {
            Shape::Spheres => {
                AreaLight::Sphere { center: center.as_vec3(), radius: size, radiance: Vec3::ONE }
            }
            Shape::Triangles => AreaLight::Triangle {
                corners: [corner(0.0, 1.0), corner(-half_width, -0.5), corner(half_width, -0.5)],
                radiance: Vec3::ONE,
                two_sided: self.two_sided(),
            },
        }
    }

    fn two_sided(&self) -> bool {
        self.two_sided.unwrap_or_default()
    }

    fn radius(&self, place: &str) -> Result<f64, LoadError> {
        let radius = self.needed("radius", self.radius, place)?;
        Ok(number(place, "radius", radius, LENGTHS)?.into())
    }

    fn normal(&self, place: &str) -> Result<DVec3, LoadError> {
        let normal = vector(place, "normal", self.needed("normal", self.normal, place)?)?;
        Ok(direction(place, "normal", normal)?.as_dvec3().normalize())
    }

    /// As many sides as the arrangement has.
    fn extent<const N: usize>(&self, place: &str) -> Result<[f64; N], LoadError> {
        let sides = self.needed("extent", self.extent.as_ref(), place)?;
        let Ok(sides): Result<[f32; N], _> = sides[..].try_into() else {
            let problem = format!("extent has {} sides", sides.len());
            return Err(LoadError::new(place, problem, format!("give it {N}")));
        };
        for side in sides {
            number(place, "extent", side, LENGTHS)?;
        }
        Ok(sides.map(f64::from))
    }

    fn needed<T>(&self, key: &str, value: Option<T>, place: &str) -> Result<T, LoadError> {
        let name = self.arrangement.name();
        let missing =
            || LoadError::new(place, format!("a {name} needs `{key}`"), format!("add `{key}`"));
        value.ok_or_else(missing)
    }

    fn check_count(&self, scene: &Scene, place: &str) -> Result<(), LoadError> {
        let rest = MAX_LIGHTS.saturating_sub(scene.area_lights.len());
        if (1..=rest).contains(&(self.count as usize)) {
            return Ok(());
        }
        let problem = format!("count = {} is out of range", self.count);
        let remedy = format!("use a number from 1; a scene has at most {MAX_LIGHTS} such lights");
        Err(LoadError::new(place, problem, remedy))
    }

    /// Refuses keys that the arrangement or the shape does not have.
    fn check_keys(&self, place: &str) -> Result<(), LoadError> {
        if self.two_sided.is_some() && matches!(self.of, Shape::Spheres) {
            let problem = "spheres have no `two_sided`";
            return Err(LoadError::new(place, problem, "remove `two_sided`"));
        }
        let keys = [
            ("seed", self.seed.is_some()),
            ("radius", self.radius.is_some()),
            ("extent", self.extent.is_some()),
            ("normal", self.normal.is_some()),
            ("up", self.up.is_some()),
            ("size", self.size.is_some()),
            ("picture", self.picture.is_some()),
        ];
        let known = self.arrangement.keys();
        match keys.iter().find(|(key, present)| *present && !known.contains(key)) {
            Some((key, _)) => {
                let problem = format!("a {} has no `{key}`", self.arrangement.name());
                Err(LoadError::new(place, problem, format!("remove `{key}`")))
            }
            None => Ok(()),
        }
    }
}
