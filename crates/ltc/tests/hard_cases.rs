//! Places and shapes where other code fails: everything finite, nothing negative.

use crate::common::{GPU, glossy, metal, oblique, receivers, sphere, spiral, triangle};
use glam::Vec3;
use manylights_gpu::SurfaceRecord;
use manylights_ltc::{LightRecord, gather, oracle};
use manylights_scene::Brdf;

const UNIT: [Vec3; 3] =
    [Vec3::new(-0.4, 0.1, -0.3), Vec3::new(0.6, -0.1, -0.2), Vec3::new(-0.1, 0.2, 0.7)];

fn brdfs() -> [Brdf; 5] {
    [Brdf::lambert(Vec3::splat(0.7)), glossy(0.03), glossy(0.5), metal(0.1), metal(1.0)]
}

/// Radiances of all surfaces; asserts that all are finite, none is negative, and none more than two lobes reflect of
/// a light all around.
fn radiances(surfaces: &[SurfaceRecord], camera: Vec3, light: LightRecord) -> Vec<Vec3> {
    let pixels = gather(&GPU, surfaces, camera, &[light]).expect("a gather");
    let radiance = |(surface, pixel): (&SurfaceRecord, [f32; 3])| {
        let value = Vec3::from(pixel);
        let truth = oracle::radiance(surface, camera.as_dvec3(), &[light]);
        let what = format!("{light:?} on {surface:?}: {value}, {truth}");
        assert!(value.is_finite() && truth.is_finite(), "{what}");
        assert!(value.min_element() >= 0.0 && truth.min_element() >= 0.0, "{what}");
        assert!(value.max_element() <= 2.1 && truth.max_element() <= 2.1, "{what}");
        value
    };
    surfaces.iter().zip(pixels).map(radiance).collect()
}

/// Surfaces at a place, in all orientations that a camera beside them sees.
fn at(place: Vec3, camera: Vec3, brdf: Brdf) -> Vec<SurfaceRecord> {
    let normals = (0..60).map(|i| oblique(spiral(i, 60, -1.0).as_vec3()));
    let axes = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z];
    let surfaces = normals.chain(axes).map(|normal| SurfaceRecord::new(place, normal, brdf));
    surfaces.filter(|surface| surface.normal.dot(camera - place) > 0.0).collect()
}

/// The point on the segment between two vertices, at a vertex, in the triangle, in its plane, and a hair beside.
#[test]
fn points_on_triangles_and_beside() {
    let [a, b, c] = UNIT;
    let middle = (a + b + c) / 3.0;
    let normal = (b - a).cross(c - a).normalize();
    let places =
        [a, b, 0.5 * (a + b), a + 0.3 * (c - a), middle, a + 2.0 * (b - a), 3.0 * middle - 2.0 * a];
    for brdf in brdfs() {
        for place in places {
            for hair in [0.0, 1e-7, -1e-7, 1e-4, -1e-4] {
                for beside in [normal, a - b] {
                    let place = place + hair * beside;
                    let camera = place + Vec3::new(0.3, 2.0, 0.1);
                    for two_sided in [false, true] {
                        radiances(&at(place, camera, brdf), camera, triangle(UNIT, two_sided));
                    }
                }
            }
        }
    }
}

/// A square on both sides of the point, through whose middle runs the diagonal of two triangles.
#[test]
fn opposite_vertices() {
    let corners = [Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 1.0)];
    for brdf in brdfs() {
        for place in [Vec3::ZERO, Vec3::new(0.5, 0.0, 0.0), Vec3::new(1e-8, -1e-8, 1e-8)] {
            let camera = Vec3::new(0.2, 1.0, 2.0);
            radiances(&at(place, camera, brdf), camera, triangle(corners, true));
        }
    }
}

#[test]
fn zero_areas_needles_huge_and_far_triangles() {
    let [a, b, c] = UNIT;
    let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
    for brdf in brdfs() {
        let surfaces = receivers(brdf, camera);
        for flat in [[a, a, a], [a, b, b], [a, b, 0.5 * (a + b)], [Vec3::ZERO; 3]] {
            let values = radiances(&surfaces, camera, triangle(flat, true));
            let most = values.iter().map(|value| value.max_element()).fold(0.0, f32::max);
            assert!(most < 1e-3, "{flat:?}: {most}");
        }
        for scale in [1e-30_f32, 1e-12, 1e-6, 1e3, 1e6, 1e10, 1e18] {
            radiances(&surfaces, camera, triangle(UNIT.map(|corner| scale * corner), true));
        }
        for width in [1e-3, 1e-6, 1e-12] {
            let needle = [a, b, a + width * (c - a)];
            radiances(&surfaces, camera, triangle(needle, true));
            let across = [10.0 * a - 9.0 * b, 10.0 * b - 9.0 * a, a + width * (c - a)];
            radiances(&surfaces, camera, triangle(across, true));
        }
        for distance in [1e2, 1e5, 1e10] {
            for i in 0..10 {
                let offset = distance * spiral(i, 10, -1.0).as_vec3();
                radiances(&surfaces, camera, triangle(UNIT.map(|corner| corner + offset), true));
            }
        }
    }
}

/// From the back a one-sided triangle sends nothing; from both sides two-sided ones send what one-sided ones of
/// either orientation send together.
#[test]
fn back_faces() {
    let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
    let [a, b, c] = UNIT;
    let normal = (b - a).cross(c - a);
    for brdf in brdfs() {
        let surfaces = receivers(brdf, camera);
        let front = radiances(&surfaces, camera, triangle(UNIT, false));
        let back = radiances(&surfaces, camera, triangle([a, c, b], false));
        let both = radiances(&surfaces, camera, triangle(UNIT, true));
        for (i, surface) in surfaces.iter().enumerate() {
            let side = (surface.position - a).dot(normal);
            let dark = if side > 0.0 { back[i] } else { front[i] };
            assert_eq!(dark, Vec3::ZERO, "{surface:?}");
            let error = (front[i] + back[i] - both[i]).abs().max_element();
            assert!(error <= 2e-4 * both[i].max_element().max(1e-3), "{surface:?}: {error}");
        }
    }
}

/// Tiny, huge, around the point, with the point on them, in its plane, behind it.
#[test]
fn spheres_everywhere() {
    for brdf in brdfs() {
        for i in 0..24 {
            let camera = Vec3::new(0.3, 2.0, 0.1);
            let surfaces = at(Vec3::ZERO, camera, brdf);
            for radius in [1e-20_f32, 1e-6, 1e-3, 0.5, 1.0, 1.0 + 1e-6, 3.0, 1e10] {
                radiances(&surfaces, camera, sphere(spiral(i, 24, -1.0).as_vec3(), radius));
            }
        }
        let camera = Vec3::new(0.3, 2.0, 0.1);
        for center in [Vec3::ZERO, 1e-20 * Vec3::X, Vec3::X, Vec3::Y, -Vec3::Y] {
            for radius in [1e-30, 1.0, 1e10] {
                radiances(&at(Vec3::ZERO, camera, brdf), camera, sphere(center, radius));
            }
        }
    }
}

/// There the hemisphere about the normal is seen, as from beside the centre to within the turn of its direction.
#[test]
fn at_the_centre_of_a_sphere() {
    let camera = Vec3::new(2.0, 3.0, 0.5);
    let up = oblique(Vec3::new(0.1, 0.9, 0.3)).normalize();
    for brdf in brdfs() {
        let surfaces = [Vec3::ZERO, 1e-3 * up - 1e-6 * up.any_orthonormal_vector()]
            .map(|place| SurfaceRecord::new(-place, up, brdf));
        let light = sphere(Vec3::ZERO, 0.5);
        let values = radiances(&surfaces, camera, light);
        let truths = surfaces
            .map(|surface| oracle::radiance(&surface, camera.as_dvec3(), &[light]).as_vec3());
        for other in [values[1], truths[0], truths[1]] {
            let error = (values[0] - other).abs().max_element();
            assert!(error < 5e-3, "{brdf:?}: {values:?}, {truths:?}");
        }
    }
}

/// What f64 knows of spheres and triangles falls with the square of the distance, at any distance.
#[test]
fn the_oracle_of_far_lights() {
    let camera = Vec3::new(0.3e13, 7e13, 0.2e13);
    let toward = oblique(Vec3::new(0.4, 0.8, 0.2)).normalize();
    let normal = (toward + 0.4 * Vec3::X).normalize();
    for brdf in brdfs() {
        for light in [triangle(UNIT, true), sphere(Vec3::ZERO, 0.5)] {
            let at = |distance: f32| {
                let surface = SurfaceRecord::new(-distance * toward, normal, brdf);
                let covered = 1.0 / f64::from(distance).powi(2);
                oracle::radiance(&surface, camera.as_dvec3(), &[light]) / covered
            };
            let limit = at(1e4);
            for distance in [1e5, 1e6, 1e7] {
                let error = ((at(distance) - limit) / limit).abs().max_element();
                assert!(error < 1e-3, "{distance}, {brdf:?}, {light:?}: {error:e}");
            }
        }
    }
}

/// Grazing views, where transforms are most askew.
#[test]
fn grazing_views() {
    for brdf in [glossy(0.03), metal(0.1), metal(0.5), metal(1.0)] {
        for height in [1e-6_f32, 1e-4, 1e-2] {
            let camera = Vec3::new(1.0, 0.0, height);
            let surfaces = [SurfaceRecord::new(Vec3::ZERO, Vec3::Z, brdf)];
            for i in 0..60 {
                let offset = spiral(i, 60, -0.5).as_vec3();
                for size in [1e-3, 0.3, 2.0] {
                    let corners = UNIT.map(|corner| size * corner + offset);
                    radiances(&surfaces, camera, triangle(corners, true));
                    radiances(&surfaces, camera, sphere(offset, 0.4 * size));
                }
            }
        }
    }
}
