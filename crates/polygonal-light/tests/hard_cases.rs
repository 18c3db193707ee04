//! Needles, points on edges' lines, in the plane, at corners, next to and far from triangles.

use crate::common::{GPU, exact, glossy, metal, oblique, spiral, surface};
use crate::exact::{CAMERA, triangle};
use glam::Vec3;
use manylights_polygonal_light::{Edges, gather, oracle};
use manylights_scene::{AreaLight, Brdf};

/// Largest difference to the oracle at a point, for many normals, over what a square of the triangle's size
/// that faces the point covers of the hemisphere.
fn error_at(place: Vec3, lights: &[AreaLight], edges: Edges, brdf: Brdf) -> f64 {
    let normals = (0..24).map(|i| spiral(i, 24, -1.0).as_vec3()).filter(|n| n.dot(CAMERA) > 0.0);
    let surfaces: Vec<_> = normals.map(|normal| surface(place, normal, brdf)).collect();
    let pixels = gather(&GPU, &surfaces, CAMERA, lights, &exact(edges)).expect("a gather");
    let size =
        lights.iter().map(|light| 2.0 * light.power().max_element().sqrt()).fold(0.0, f32::max);
    let AreaLight::Triangle { corners, .. } = lights[0] else { panic!("a triangle") };
    let [a, b, c] = corners;
    let size = size.max((b - a).length()).max((c - a).length());
    let distance = (place - (a + b + c) / 3.0).length();
    let covered = f64::from(size * size / (size * size + distance * distance));
    let difference = |(surface, pixel): (_, [f32; 3])| {
        let truth = oracle::radiance(surface, CAMERA.as_dvec3(), lights, &exact(edges));
        let pixel = Vec3::from(pixel);
        assert!(pixel.is_finite(), "{place}, {lights:?}: {pixel}");
        (pixel.as_dvec3() - truth).abs().max_element() / covered
    };
    surfaces.iter().zip(pixels).map(difference).fold(0.0, f64::max)
}

/// In an oblique frame, of radiance 1 from both sides.
fn oblique_triangle(corners: [[f32; 3]; 3]) -> AreaLight {
    let corners = corners.map(|corner| oblique(Vec3::from(corner)));
    AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: true }
}

fn brdfs() -> [Brdf; 3] {
    [Brdf::lambert(Vec3::splat(0.7)), glossy(0.4), metal(0.3)]
}

/// Above its inside, edges, corners and the lines of its edges, at any height, on both sides.
#[test]
fn next_to_a_triangle() {
    let light = oblique_triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 0.8, 0.0]]);
    for brdf in brdfs() {
        let mut worst = 0.0_f64;
        for [x, y] in
            [[0.4, 0.3], [0.5, 0.0], [0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.15, 0.4], [-0.1, 0.2]]
        {
            for height in [1e-4, 1e-3, 1e-2, 0.1, 1.0, 5.0, 7.0_f32] {
                for height in [height, -height] {
                    let place = oblique(Vec3::new(x, y, height));
                    let error = error_at(place, &[light], Edges::Own, brdf);
                    // A rounded point is that much of its height beside.
                    let bound = 1e-5 + f64::from(f32::EPSILON / height.abs());
                    assert!(error < bound, "{x}, {y}, {height}: {error:e}");
                    worst = worst.max(error / bound);
                }
            }
        }
        println!("{worst:.2} of the bound");
    }
}

/// In the plane nothing is seen: not outside, not on the light itself.
#[test]
fn in_the_plane() {
    let light = oblique_triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 0.8, 0.0]]);
    for brdf in brdfs() {
        for [x, y] in
            [[0.4, 0.3], [0.5, 0.0], [0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [-0.1, 0.2], [50.0, 3.0]]
        {
            let surface =
                surface(oblique(Vec3::new(x, y, 0.0)), oblique(Vec3::new(0.3, 0.9, 0.2)), brdf);
            let pixel =
                gather(&GPU, &[surface], CAMERA, &[light], &exact(Edges::Own)).expect("a gather");
            let most = pixel[0].into_iter().map(f32::abs).fold(0.0, f32::max);
            assert!(most <= 1e-6, "{x}, {y}: {most:e}");
        }
    }
}

/// Along the line between opposite corners of a square in two triangles, whose common edge covers nearly a half
/// circle, and beside.
#[test]
fn between_opposite_corners() {
    let [a, b, c, d] = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    let lights = [oblique_triangle([a, b, c]), oblique_triangle([a, c, d])];
    for brdf in brdfs() {
        for edges in [Edges::Own, Edges::Shared] {
            for height in [1e-4, 1e-3, 0.1_f32] {
                for beside in [0.0, 1e-4, 1e-2] {
                    let place = oblique(Vec3::new(0.3 + beside, 0.3 - beside, height));
                    let error = error_at(place, &lights, edges, brdf);
                    let bound = 1e-5 + f64::from(f32::EPSILON / height);
                    assert!(error < bound, "{height}, {beside}, {edges:?}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn needles_huge_and_far_ones() {
    for brdf in brdfs() {
        for (width, height) in [(1e-2, 1.0), (1e-4, 1.0), (1e-6, 1.0), (1e-4, 1e-2), (1e-6, 0.1)] {
            let needle = oblique_triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, width, 0.0]]);
            for [x, y] in [[0.5, 0.0], [0.2, 0.4], [3.0, 0.0], [30.0, 0.0]] {
                let place = oblique(Vec3::new(x, y, height));
                let error = error_at(place, &[needle], Edges::Own, brdf);
                assert!(error < 1e-5, "{width}, {height}, {x}, {y}: {error:e}");
            }
        }
        for size in [1e-6, 1e-3, 1e3, 1e6_f32] {
            let light = oblique_triangle(
                [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]]
                    .map(|c: [f32; 3]| c.map(|c| c * size)),
            );
            for distance in [1e-3, 0.1, 2.0, 1e3, 1e5] {
                let place = oblique(size * distance * Vec3::new(0.3, 0.2, 0.9));
                let error = error_at(place, &[light], Edges::Own, brdf);
                assert!(error < 1e-4, "{size}, {distance}: {error:e}");
            }
        }
    }
}

/// From the front alone.
#[test]
fn one_sided_triangles_have_a_dark_back() {
    let [one, two] = [false, true].map(triangle);
    let AreaLight::Triangle { corners: [a, b, c], .. } = one else { panic!("a triangle") };
    let normal = (b - a).cross(c - a).normalize();
    for distance in [0.5, 3.0, 20.0] {
        let at = |side: f32, light| {
            let surface =
                surface(side * distance * normal, -side * normal, Brdf::lambert(Vec3::ONE));
            let camera = surface.position - side * normal;
            gather(&GPU, &[surface], camera, &[light], &exact(Edges::Own)).expect("a gather")[0][0]
        };
        assert!(at(1.0, one) > 0.0);
        assert_eq!(at(1.0, one), at(1.0, two));
        assert_eq!(at(-1.0, one), 0.0);
        assert!(at(-1.0, two) > 0.0);
    }
}

#[test]
fn no_area_no_light() {
    let [a, b] = [Vec3::ZERO, Vec3::X];
    let light =
        AreaLight::Triangle { corners: [a, b, 0.5 * b], radiance: Vec3::ONE, two_sided: true };
    let surface = surface(Vec3::Y, -Vec3::Y, Brdf::lambert(Vec3::ONE));
    for edges in [Edges::Own, Edges::Shared] {
        let pixels = gather(&GPU, &[surface], CAMERA, &[light], &exact(edges)).expect("a gather");
        assert_eq!(pixels, [[0.0; 3]]);
    }
}
