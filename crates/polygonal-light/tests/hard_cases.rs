//! Needles, points on edges' lines, in the plane, at corners, next to and far from triangles.

use crate::common::{GPU, exact, glossy, metal, oblique, spiral, surface};
use crate::exact::{CAMERA, triangle};
use glam::{DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_polygonal_light::{Edges, Narrow, Settings, gather, oracle};
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

/// Settings for all lobes: bands, and transformed cosines for narrow ones.
fn with_lobes(edges: Edges) -> [(Settings, Brdf); 4] {
    let transformed = Settings { narrow: Narrow::Transformed, ..exact(edges) };
    let [lambert, glossy_one, metal] = brdfs().map(|brdf| (exact(edges), brdf));
    [lambert, glossy_one, metal, (transformed, glossy(0.15))]
}

fn pixel(surface: SurfaceRecord, lights: &[AreaLight], settings: &Settings) -> DVec3 {
    let pixel = gather(&GPU, &[surface], CAMERA, lights, settings).expect("a gather");
    let pixel = Vec3::from(pixel[0]);
    assert!(pixel.is_finite(), "{lights:?}: {pixel}");
    pixel.as_dvec3()
}

/// Places in the plane: inside, outside, far; at corners, on an edge and on its line, where 1e-5 sizes are known in
/// f32 to 6e-3 of them. And the bound there.
const IN_PLANE: [([f32; 2], f64); 7] = [
    ([0.4, 0.3], 1e-5),
    ([-0.1, 0.2], 1e-5),
    ([50.0, 3.0], 1e-5),
    ([0.0, 0.0], ON_EDGE),
    ([1.0, 0.0], ON_EDGE),
    ([0.5, 0.0], ON_EDGE),
    ([2.0, 0.0], ON_EDGE),
];
const ON_EDGE: f64 = 1e-3;

/// In the plane and within 1e-5 sizes of it a light is what it is from there, on either side: it fills half
/// of the directions inside, and nothing jumps on the way to the plane.
#[test]
fn next_to_the_plane() {
    // Of size 1.08, of coordinates that have no rounding, so that the side is known.
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.25, 0.75, 0.0]].map(Vec3::from);
    let light = AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: true };
    for (settings, brdf) in with_lobes(Edges::Own) {
        let (normal, mut worst) = (Vec3::new(0.3, 0.9, 0.2).normalize(), 0.0_f64);
        for ([x, y], bound) in IN_PLANE {
            for side in [1.0, -1.0_f32] {
                let at = |height: f32| {
                    let surface = surface(Vec3::new(x, y, side * height), normal, brdf);
                    let truth = oracle::radiance(&surface, CAMERA.as_dvec3(), &[light], &settings);
                    (pixel(surface, &[light], &settings), truth)
                };
                let (there, _) = at(1.1e-5);
                let heights = [1e-30, 1e-12, 1e-8, 1e-7, 1e-6, 5e-6, 1e-5];
                for height in heights {
                    let (found, truth) = at(height);
                    let error = (found - truth).abs().max_element();
                    worst = worst.max(error / bound);
                    assert!(error < bound, "{x}, {y}, {height} of {side}: {found} {truth}");
                    let step = (found - there).abs().max_element();
                    assert!(step < 2.0 * bound, "{x}, {y}, {height} of {side}: {found} {there}");
                }
            }
            // The plane is of the back.
            let surface = surface(Vec3::new(x, y, 0.0), normal, brdf);
            let behind = SurfaceRecord { position: surface.position - 1e-7 * Vec3::Z, ..surface };
            let step = pixel(surface, &[light], &settings) - pixel(behind, &[light], &settings);
            assert!(step.abs().max_element() < bound, "{x}, {y}: {step}");
        }
        println!("{worst:.2} of the bound");
        let one_sided = AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: false };
        let inside = surface(Vec3::new(0.4, 0.3, 0.0), normal, brdf);
        assert_eq!(pixel(inside, &[one_sided], &settings), DVec3::ZERO);
        assert!(pixel(inside, &[light], &settings).max_element() > 0.01);
    }
}

/// In an oblique plane the side is that of rounding, and one of both is what the oracle has a hair beside.
#[test]
fn in_an_oblique_plane() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 0.8, 0.0]];
    let light = oblique_triangle(corners);
    for (settings, brdf) in with_lobes(Edges::Own) {
        for ([x, y], bound) in IN_PLANE {
            let at = |height: f32| {
                let place = oblique(Vec3::new(x, y, height));
                surface(place, oblique(Vec3::new(0.3, 0.9, 0.2).normalize()), brdf)
            };
            let found = pixel(at(0.0), &[light], &settings);
            let beside = [1e-6, -1e-6].map(|height| {
                let truth = oracle::radiance(&at(height), CAMERA.as_dvec3(), &[light], &settings);
                (truth - found).abs().max_element()
            });
            assert!(beside[0].min(beside[1]) < bound, "{x}, {y}: {beside:?}");
        }
    }
}

/// A square in 32 triangles, whose own sizes are a fraction of its own; upright and in an oblique plane, within
/// whose rounding the side is another.
#[test]
fn own_and_shared_edges_agree_next_to_the_plane() {
    let turns: [fn(Vec3) -> Vec3; 2] = [|v| v, oblique];
    let heights = [0.0, 1e-7, 1e-6, 3e-6, 5e-6, 1e-5, 2e-5, -1e-6, -5e-6];
    for (turn, heights) in turns.into_iter().zip([&heights[..], &heights[2..]]) {
        let place = |x: u32, y: u32| turn(Vec3::new(x as f32, y as f32, 0.0) * 0.25);
        let square: Vec<_> = (0..16)
            .flat_map(|cell| {
                let (x, y) = (cell % 4, cell / 4);
                let [a, b, c, d] =
                    [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)].map(|(x, y)| place(x, y));
                [[a, b, c], [a, c, d]]
            })
            .map(|corners| AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: true })
            .collect();
        let normal = turn(Vec3::new(0.3, 0.9, 0.2).normalize());
        let edges = with_lobes(Edges::Own).into_iter().zip(with_lobes(Edges::Shared));
        for ((own, brdf), (shared, _)) in edges {
            for [x, y] in [[0.55, 0.35], [0.3, 0.9], [1.5, 0.4], [-2.0, 3.0]] {
                for &height in heights {
                    let surface = surface(turn(Vec3::new(x, y, height)), normal, brdf);
                    let [own, shared] =
                        [own, shared].map(|settings| pixel(surface, &square, &settings));
                    let difference = (own - shared).abs().max_element();
                    assert!(difference < 4e-5, "{x}, {y}, {height}: {own} {shared}");
                }
            }
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
