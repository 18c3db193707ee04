//! Polygons and two-sided lights in scene files.

use std::f32::consts::{PI, TAU};

use glam::{Vec3, vec3};
use manylights_scene::AreaLight::{self, Triangle};
use proptest::prelude::*;

use crate::common;
use crate::light_sets::{CLOUD, HEAD, PANEL, RING, set, with};

const RADIANCE: Vec3 = vec3(3.0, 2.0, 1.0);

fn lights(text: &str) -> Vec<AreaLight> {
    common::load_text(&format!("{HEAD}{text}"))
        .unwrap_or_else(|error| panic!("{error}"))
        .area_lights
}

fn polygon(corners: &[Vec3], more: &str) -> Vec<AreaLight> {
    let corners: Vec<_> = corners.iter().map(|c| format!("[{}, {}, {}]", c.x, c.y, c.z)).collect();
    let corners = corners.join(", ");
    lights(&format!(
        "[[light]]\nkind = \"polygon\"\ncorners = [{corners}]\nradiance = [3, 2, 1]\n{more}"
    ))
}

/// Twice the area, along the front's normal.
fn area(corners: &[Vec3]) -> Vec3 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| (*a - corners[0]).cross(*b - corners[0])).sum()
}

/// All of them face as the polygon does, have corners of it alone and its area in sum.
fn check(corners: &[Vec3], two_sided: bool) {
    let more = if two_sided { "two_sided = true" } else { "" };
    let lights = polygon(corners, more);
    let whole = area(corners);
    let mut sum = 0.0;
    for light in &lights {
        let Triangle { corners: own, radiance, two_sided: both } = *light else {
            panic!("{light:?}")
        };
        assert_eq!((radiance, both), (RADIANCE, two_sided));
        assert!(own.iter().all(|corner| corners.contains(corner)), "{own:?} {corners:?}");
        let along = area(&own).dot(whole.normalize());
        assert!(along > 0.0, "{own:?} of {corners:?}");
        sum += along;
    }
    assert!(lights.len() <= corners.len() - 2, "{}", lights.len());
    // None overlap: those of one front that did would have more.
    assert!((sum / whole.length() - 1.0).abs() < 1e-4, "{sum} {}: {corners:?}", whole.length());
}

#[test]
fn polygons_become_triangles() {
    let outlines: [&[(f32, f32)]; 4] = [
        &[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)],
        &[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)],
        // An L, and a comb.
        &[(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)],
        &[(0.0, 0.0), (5.0, 0.0), (5.0, 3.0), (4.0, 1.0), (3.0, 3.0), (2.0, 1.0), (1.0, 3.0)],
    ];
    for outline in outlines {
        // In a plane of its own, from its front and from its back.
        let (right, up) = (vec3(0.6, 0.0, 0.8), vec3(0.0, 1.0, 0.0));
        let place = |&(x, y): &(f32, f32)| vec3(1.0, 2.0, 3.0) + x * right + y * up;
        let mut corners: Vec<Vec3> = outline.iter().map(place).collect();
        check(&corners, false);
        corners.reverse();
        check(&corners, true);
    }
}

/// A needle is none of zero area.
#[test]
fn narrow_polygons_are_lights() {
    check(&[vec3(0.0, 1.0, 0.0), vec3(1.0, 1.0, 0.0), vec3(1.0, 1.0, 1e-4)], false);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn stars_of_any_shape_become_triangles(
        radii in prop::collection::vec(0.1_f32..3.0, 4..40),
        normal in prop::array::uniform3(-1.0_f32..1.0),
        center in prop::array::uniform3(-50.0_f32..50.0),
    ) {
        let normal = (Vec3::from(normal) + 1e-3).normalize();
        let (x, y) = normal.any_orthonormal_pair();
        let count = radii.len() as f32;
        let corner = |(i, radius): (usize, &f32)| {
            let (sin, cos) = (TAU * i as f32 / count).sin_cos();
            Vec3::from(center) + *radius * (cos * x + sin * y)
        };
        let corners: Vec<Vec3> = radii.iter().enumerate().map(corner).collect();
        check(&corners, false);
    }
}

/// The same power from twice the area: half of the radiance.
#[test]
fn sets_of_triangles_may_shine_from_both_sides() {
    let sets =
        [set(RING, "triangles"), set(CLOUD, "triangles"), with(PANEL, "triangles", "count = 8")];
    for text in sets {
        let one = lights(&text);
        let both = lights(&format!("{text}two_sided = true\n"));
        assert_eq!(lights(&format!("{text}two_sided = false\n")), one);
        for (one, both) in one.iter().zip(&both) {
            let [
                Triangle { corners: a, two_sided: false, .. },
                Triangle { corners: b, two_sided: true, .. },
            ] = [one, both]
            else {
                panic!("{one:?} {both:?}")
            };
            assert_eq!(a, b);
            assert!((one.radiance() - 2.0 * both.radiance()).length() < 1e-6 * one.radiance().x);
            assert!((one.power() - both.power()).length() < 1e-5, "{one:?}");
        }
    }
    let triangle = |two_sided| Triangle {
        corners: [Vec3::ZERO, Vec3::X, Vec3::Y],
        radiance: Vec3::ONE,
        two_sided,
    };
    assert_eq!(triangle(false).power(), Vec3::splat(0.5 * PI));
    assert_eq!(triangle(true).power(), 2.0 * triangle(false).power());
}

/// Of a named material, and of all materials of a part.
#[test]
fn materials_may_emit_from_both_sides() {
    let emitters = |text: &str| {
        let scene = common::load_text(text).unwrap_or_else(|error| panic!("{error}"));
        let both = |light: &AreaLight| matches!(light, Triangle { two_sided: true, .. });
        let lights: Vec<_> = scene.all_area_lights().collect();
        (lights.len(), lights.iter().filter(|light| both(light)).count())
    };
    let material = format!("{HEAD}[material.white]\nemission = [1, 1, 1]\n");
    let (count, both) = emitters(&material);
    assert!(count > 0 && both == 0, "{count} {both}");
    assert_eq!(emitters(&format!("{material}two_sided = true\n")), (count, count));
    // A preset replaces neither.
    assert_eq!(
        emitters(&format!("{material}two_sided = true\npreset = \"teflon\"\n")),
        (count, count)
    );
    let part = format!(
        "{HEAD}[[part]]\nsource = \"builtin:trio\"\nmaterial = {{ emission = [1, 1, 1], two_sided = true }}"
    );
    let (count, both) = emitters(&part);
    assert!(count > 100 && both == count, "{count} {both}");
}
