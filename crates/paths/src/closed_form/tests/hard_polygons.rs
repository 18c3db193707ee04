//! Polygons on the receiver's horizon, through it, and with lengths whose powers leave f32.

use super::*;

const UP: [f64; 3] = [0.0, 1.0, 0.0];

/// At all lengths and in both precisions, as near as these are; `None` at a jump, where any value that a
/// polygon can have may come.
fn assert_irradiance(what: &str, normal: [f64; 3], corners: &[[f64; 3]], expected: Option<f64>) {
    for length in [1e-20, 1e-10, 1.0, 1e10, 1e18] {
        let corners: Vec<_> = corners.iter().map(|corner| corner.map(|c| length * c)).collect();
        let single: Vec<_> = corners.iter().map(|corner| corner.map(|c| c as f32)).collect();
        let found = [
            (polygon_irradiance(normal, &corners), 1e-14),
            (polygon_irradiance(normal.map(|c| c as f32), &single).into(), 1e-6),
        ];
        for (value, tolerance) in found {
            let what = format!("{what}, {length:e} m: {value}, expected {expected:?}");
            match expected {
                Some(expected) => assert!((value - expected).abs() <= tolerance, "{what}"),
                None => assert!((0.0..=PI + tolerance).contains(&value), "{what}"),
            }
        }
    }
}

/// At `height`, around the vertical axis, its front down.
fn ceiling(height: f64) -> [[f64; 3]; 4] {
    [[-1.0, height, -1.0], [1.0, height, -1.0], [1.0, height, 1.0], [-1.0, height, 1.0]]
}

/// To the receiver's side, from x = 0 to `width` and between two heights; its front to the receiver.
fn wall(width: f64, from: f64, to: f64) -> [[f64; 3]; 4] {
    [[0.0, from, -1.0], [width, from, -1.0], [width, to, -1.0], [0.0, to, -1.0]]
}

/// Lambert's sum over the edges of a wall (`wall`) that stands on the horizon: two lie in planes through
/// the receiver's normal and send nothing.
fn standing(width: f64, height: f64) -> f64 {
    let slant = height.hypot(1.0);
    0.5 * (width.atan() - (width / slant).atan() / slant)
}

#[test]
fn walls_are_cut_at_the_horizon() {
    for (width, height) in [(1.0, 1.0), (0.1, 3.0), (20.0, 0.5)] {
        let expected = standing(width, height);
        assert_irradiance("standing", UP, &wall(width, 0.0, height), Some(expected));
        // Seen edge-on by the receiver: half of it is below.
        assert_irradiance("half below", UP, &wall(width, -height, height), Some(expected));
        assert_irradiance("below", UP, &wall(width, -height, 0.0), Some(0.0));
        assert_irradiance("far below", UP, &wall(width, -height, -0.5 * height), Some(0.0));
        let back: Vec<_> = wall(width, -height, height).into_iter().rev().collect();
        assert_irradiance("back", UP, &back, Some(0.0));
    }
}

/// Lambert's sum: all four edges send the same.
#[test]
fn ceilings_near_and_far() {
    for height in [0.3, 1.0, 10.0] {
        let slant = f64::hypot(height, 1.0);
        let expected = 4.0 * (1.0 / slant).atan() / slant;
        assert_irradiance("ceiling", UP, &ceiling(height), Some(expected));
        assert_irradiance("floor below", UP, &ceiling(-height), Some(0.0));
    }
    for height in [1e-20, 1e-15] {
        assert_irradiance("near ceiling", UP, &ceiling(height), Some(PI));
    }
}

/// Where the receiver lies in the plane of a polygon: beside it nothing arrives; on it, where it is
/// parallel, the limit from the front, which is the angle that the polygon fills, halved.
#[test]
fn planes_through_the_receiver() {
    let moved = |x: f64, z: f64| ceiling(0.0).map(|[a, _, c]| [a + x, 0.0, c + z]);
    assert_irradiance("inside", UP, &moved(0.2, 0.5), Some(PI));
    assert_irradiance("on an edge", UP, &moved(1.0, 0.25), Some(0.5 * PI));
    assert_irradiance("at a vertex", UP, &moved(1.0, -1.0), Some(0.25 * PI));
    assert_irradiance("beside", UP, &moved(2.0, 0.3), Some(0.0));
    assert_irradiance("in line with an edge", UP, &moved(3.0, 1.0), Some(0.0));
    for normal in [[0.6, 0.0, 0.8], [0.0, 0.6, 0.8], [0.48, 0.6, 0.64]] {
        assert_irradiance("tilted, beside", normal, &moved(2.0, 0.3), Some(0.0));
        for (x, z) in [(0.2, 0.5), (1.0, 0.25), (1.0, -1.0)] {
            assert_irradiance("tilted, on it", normal, &moved(x, z), None);
        }
    }
}

/// Corners at very different distances: a wall that fills a quarter of the view from its foot; and corners
/// moved along their directions, which changes nothing.
#[test]
fn corners_near_and_far_at_once() {
    let near = [[0.0, 0.0, -1e-15], [1e15, 0.0, -1e-15], [0.0, 1e15, -1e-15]];
    assert_irradiance("wedge", UP, &near, Some(0.25 * PI));
    let directions = [[-0.3, 0.8, -0.6], [0.4, 0.2, -0.7], [0.1, 0.9, 0.4]];
    let lengths = [1e-15, 1.0, 1e15];
    let stretched = [0, 1, 2].map(|k| directions[k].map(|c| lengths[k] * c));
    let expected = polygon_irradiance(UP, &directions);
    assert!(expected > 0.1, "{expected}");
    assert_irradiance("stretched", UP, &stretched, Some(expected));
}
