//! Paths past triangles and panels, of size 1 where nothing else is said, in their frame.

use glam::Vec3;

use crate::families::{Family, beside, decades, line};
use crate::shapes::{CORNERS, family, in_world, light, panel, texture, turned, two_sided};

pub(crate) fn triangles() -> Vec<Family> {
    [far(), near(), planes(), narrow(), panels(), sizes(), horizons()]
        .into_iter()
        .flatten()
        .collect()
}

fn far() -> Vec<Family> {
    let toward = Vec3::new(0.3, 0.2, 0.9);
    let between = |near: f32, far: f32| line(near * toward, far * toward);
    let decades = || decades(Vec3::ZERO, toward, [0.0, 6.0]);
    vec![
        family("far triangle, 1 to 1e6 sizes", two_sided(), 1.0, decades()),
        family("far panel of differing radiances, 1 to 1e6 sizes", panel(texture), 1.0, decades()),
        family("across 8 sizes of a triangle", two_sided(), 1.0, between(7.5, 10.5)),
        family(
            "across 8 sizes of a panel of differing radiances",
            panel(texture),
            1.0,
            between(7.5, 9.0),
        ),
        family("across 100 sizes of a triangle", two_sided(), 1.0, between(95.0, 130.0)),
    ]
}

fn near() -> Vec<Family> {
    let [a, b, _] = CORNERS;
    let toward = Vec3::new(0.3, 0.2, 0.9);
    let down_to_ten_thousandth = |place| decades(place, toward, [-4.0, 0.0]);
    let line_of_edge = b + (b - a);
    let in_plane = [a, b, 0.5 * (a + b), line_of_edge, Vec3::new(0.1, 0.0, 0.0), -2.0 * Vec3::Y];
    let within = in_plane.into_iter().flat_map(|place| {
        let heights = [0.0, 1e-30, -1e-30, 1e-12, -1e-12, 1e-8, -1e-8, 1e-7, -1e-7, 1e-6, -1e-6];
        heights.map(|height| place + height * Vec3::Z)
    });
    vec![
        family(
            "onto a triangle, 1e-4 to 1 sizes",
            two_sided(),
            1.0,
            down_to_ten_thousandth(0.1 * Vec3::X),
        ),
        family("to a vertex, 1e-4 to 1 sizes", two_sided(), 1.0, down_to_ten_thousandth(b)),
        family("to the middle of an edge", two_sided(), 1.0, down_to_ten_thousandth(0.5 * (a + b))),
        family(
            "to the line of an edge, beside it",
            two_sided(),
            1.0,
            down_to_ten_thousandth(line_of_edge),
        ),
        family("in the plane and up to 1e-6 sizes beside", two_sided(), 1.0, within.collect())
            .scattered(),
    ]
}

fn planes() -> Vec<Family> {
    let through = |x: f32| line(Vec3::new(x, 0.1, -0.5), Vec3::new(x, 0.1, 0.5));
    let one_sided = || vec![light(CORNERS, 1.0, false)];
    vec![
        family("across the plane beside a two-sided triangle", two_sided(), 1.0, through(1.5)),
        family("across the plane beside a one-sided triangle", one_sided(), 1.0, through(1.5)),
        family("through a two-sided triangle", two_sided(), 1.0, through(0.1)),
        family("through a one-sided triangle", one_sided(), 1.0, through(0.1)),
    ]
}

fn narrow() -> Vec<Family> {
    let needle =
        |width: f32| vec![light([-0.5 * Vec3::X, 0.5 * Vec3::X, width * Vec3::Y], 1.0, true)];
    let across = |height| line(Vec3::new(0.1, -1.0, height), Vec3::new(0.1, 1.0, height));
    let along = |height| line(Vec3::new(-1.0, 0.0, height), Vec3::new(1.0, 0.0, height));
    let nothing = vec![light([-0.5 * Vec3::X, 0.5 * Vec3::X, 0.125 * Vec3::X], 1.0, true)];
    let collapsed = vec![light([0.1 * Vec3::X; 3], 1.0, true)];
    vec![
        family("over a needle 1e-4 wide, at 0.1", needle(1e-4), 1.0, across(0.1)),
        family("along a needle 1e-4 wide, at 0.01", needle(1e-4), 1.0, along(0.01)),
        family("over a needle 1e-6 wide, at 0.01", needle(1e-6), 1.0, across(0.01)),
        family("no area: corners on a line", nothing, 1.0, along(0.1)),
        family("no area: one corner thrice", collapsed, 1.0, along(0.1)),
    ]
}

fn panels() -> Vec<Family> {
    let [a, b, c, d] = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]
        .map(|[x, y]| Vec3::new(x, y, 0.0) * 0.5_f32.sqrt());
    let square = |other| vec![light([a, b, c], 1.0, true), light([a, c, d], other, true)];
    let up = 1e-3 * Vec3::Z;
    let place = 0.3 * c;
    let hair = 0.01 * (b - d);
    let over = |height: f32| line(Vec3::new(-0.6, -0.5, height), Vec3::new(0.6, 0.55, height));
    vec![
        family(
            "between opposite corners of a square, at 1e-3",
            square(1.0),
            1.0,
            line(a + up, c + up),
        ),
        family(
            "across that diagonal by 1e-2",
            square(1.0),
            1.0,
            line(place - hair + up, place + hair + up),
        ),
        family(
            "across that of two radiances",
            square(0.3),
            1.0,
            line(place - hair + up, place + hair + up),
        ),
        family("over a panel of equal triangles, at 0.1", panel(|_, _| 1.0), 1.0, over(0.1)),
        family("over a panel of differing radiances, at 0.1", panel(texture), 1.0, over(0.1)),
        family("over a panel of differing radiances, at 1e-3", panel(texture), 1.0, over(1e-3)),
    ]
}

fn sizes() -> Vec<Family> {
    let of_size = |size: f32| vec![light(CORNERS.map(|corner| size * corner), 1.0, true)];
    let low = |y: f32| Vec3::new(0.2, y, 1.0);
    vec![
        family(
            "under a triangle 1e4 m large, at 1 m",
            of_size(1e4),
            1e4,
            line(low(-3.0), low(3.0)),
        ),
        family("across its edge", of_size(1e4), 1e4, line(low(-3010.0), low(-2990.0))),
        Family::new(
            "triangle of 1e-7 m at 1 m",
            (turned(of_size(1e-7), in_world), 1e-7),
            line(beside(-0.8), beside(-0.1)),
        ),
    ]
}

fn horizons() -> Vec<Family> {
    let sinking = |name| {
        Family::new(name, (turned(two_sided(), in_world), 1.0), line(beside(-0.8), beside(0.8)))
    };
    // Upright, at right angles to the receiver's plane.
    let upright = |name, from, to| {
        let turn = |place: Vec3| 0.6 * Vec3::new(place.z, place.y, -place.x);
        Family::new(name, (turned(panel(texture), turn), 0.6), line(beside(from), beside(to)))
    };
    vec![
        sinking("sinking through the receiver's plane"),
        sinking("the same, scene 1e-3 units large").scaled(1e-3),
        sinking("the same, scene 1e4 units large").scaled(1e4),
        upright("upright panel through the receiver's plane", -0.5, 0.5),
        upright("upright panel, from just below the horizon down", 0.2122, 0.5),
    ]
}
