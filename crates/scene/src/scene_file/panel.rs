//! A rectangle of k × k texels as lights.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use crate::{AreaLight, LoadError};

/// k of a panel of `count` lights, so many for each of its k × k texels.
pub(super) fn texels(count: u32, of_a_texel: u32, place: &str) -> Result<u32, LoadError> {
    let texels = (count / of_a_texel).isqrt().max(1);
    let [fewer, more] = [texels, texels + 1].map(|k| of_a_texel * k * k);
    if fewer == count {
        return Ok(texels);
    }
    let form = if of_a_texel == 1 { "k²".to_owned() } else { format!("{of_a_texel} k²") };
    let problem = format!("count = {count} is not {form}, as a panel's is");
    Err(LoadError::new(place, problem, format!("use {fewer} or {more}")))
}

/// A rectangle that faces `right × up`; texels in rows from its top left, as seen from its front.
pub(super) struct Panel {
    pub(super) center: DVec3,
    /// Unit.
    pub(super) right: DVec3,
    /// Unit, orthogonal to `right`.
    pub(super) up: DVec3,
    /// Lengths along `right` and `up`, metres.
    pub(super) sides: [f64; 2],
    /// k.
    pub(super) texels: u32,
}

impl Panel {
    /// A sphere for each texel, of its area in cross-section: π r² = side · side.
    pub(super) fn spheres(&self) -> impl Iterator<Item = AreaLight> {
        let radius = (self.texel(0).area() / PI).sqrt() as f32;
        self.each().map(move |texel| {
            let center = texel.center.as_vec3();
            AreaLight::Sphere { center, radius, radiance: Vec3::ONE }
        })
    }

    /// Two triangles for each texel: that below its falling diagonal, then that above.
    pub(super) fn triangles(&self, two_sided: bool) -> impl Iterator<Item = AreaLight> {
        self.each().flat_map(move |Texel { center, right, up }| {
            let corner = |x: f64, y: f64| (center + 0.5 * (x * right + y * up)).as_vec3();
            let [top_left, bottom_right] = [corner(-1.0, 1.0), corner(1.0, -1.0)];
            let halves = [
                [top_left, corner(-1.0, -1.0), bottom_right],
                [bottom_right, corner(1.0, 1.0), top_left],
            ];
            halves.map(move |corners| AreaLight::Triangle {
                corners,
                radiance: Vec3::ONE,
                two_sided,
            })
        })
    }

    fn each(&self) -> impl Iterator<Item = Texel> {
        (0..self.texels * self.texels).map(|index| self.texel(index))
    }

    fn texel(&self, index: u32) -> Texel {
        let step = 1.0 / f64::from(self.texels);
        let [right, up] = [self.sides[0] * self.right, self.sides[1] * self.up];
        let across = (f64::from(index % self.texels) + 0.5) * step - 0.5;
        let down = (f64::from(index / self.texels) + 0.5) * step - 0.5;
        Texel {
            center: self.center + across * right - down * up,
            right: step * right,
            up: step * up,
        }
    }
}

struct Texel {
    center: DVec3,
    /// From its left to its right edge.
    right: DVec3,
    /// From its bottom to its top.
    up: DVec3,
}

impl Texel {
    fn area(&self) -> f64 {
        self.right.length() * self.up.length()
    }
}
