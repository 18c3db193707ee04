//! Triangles and panels of size 1 in a frame whose z is the normal of the front; it looks down on the receivers.

use glam::{Quat, Vec3};
use manylights_scene::AreaLight;

use crate::families::{DOWN, Family};

pub(crate) const CORNERS: [Vec3; 3] =
    [Vec3::new(-0.4, -0.3, 0.0), Vec3::new(0.6, -0.3, 0.0), Vec3::new(-0.1, 0.5, 0.0)];

/// Cells a side of a panel.
const CELLS: u32 = 3;

pub(crate) fn in_world(place: Vec3) -> Vec3 {
    Quat::from_rotation_arc(Vec3::Z, DOWN.normalize()) * place
}

pub(crate) fn light(corners: [Vec3; 3], radiance: f32, two_sided: bool) -> AreaLight {
    AreaLight::Triangle { corners, radiance: Vec3::splat(radiance), two_sided }
}

/// A square of diameter 1 of 2 · `CELLS`² triangles.
pub(crate) fn panel(radiance: fn(u32, u32) -> f32) -> Vec<AreaLight> {
    let place = |x: u32, y: u32| {
        let [x, y] = [x, y].map(|i| (i as f32 / CELLS as f32 - 0.5) * 0.5_f32.sqrt());
        Vec3::new(x, y, 0.0)
    };
    let cell = |(x, y)| {
        let [a, b, c, d] =
            [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)].map(|(x, y)| place(x, y));
        [[a, b, c], [a, c, d]].map(|corners| light(corners, radiance(x, y), true))
    };
    (0..CELLS).flat_map(|y| (0..CELLS).map(move |x| (x, y))).flat_map(cell).collect()
}

pub(crate) fn texture(x: u32, y: u32) -> f32 {
    0.1 + ((x * 5 + y * 7) % 9) as f32 / 4.0
}

/// As `in_world` has it.
pub(crate) fn turned(lights: Vec<AreaLight>, turn: impl Fn(Vec3) -> Vec3) -> Vec<AreaLight> {
    let turned = |light| match light {
        AreaLight::Triangle { corners, radiance, two_sided } => {
            AreaLight::Triangle { corners: corners.map(&turn), radiance, two_sided }
        }
        sphere => sphere,
    };
    lights.into_iter().map(turned).collect()
}

pub(crate) fn family(
    name: &'static str,
    lights: Vec<AreaLight>,
    size: f32,
    places: Vec<Vec3>,
) -> Family {
    let places = places.into_iter().map(in_world).collect();
    Family::new(name, (turned(lights, in_world), size), places)
}

pub(crate) fn two_sided() -> Vec<AreaLight> {
    vec![light(CORNERS, 1.0, true)]
}
