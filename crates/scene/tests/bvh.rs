//! The hierarchy against a loop over all triangles.

use glam::{DVec3, Vec3};
use manylights_scene::bvh::{Bvh, Hit, Ray};
use manylights_scene::{Material, Scene, Triangle, Vertex};
use proptest::prelude::*;

fn scene(corners: &[[Vec3; 3]]) -> Scene {
    let mut scene =
        Scene { materials: vec![Material::lambert("grey", Vec3::splat(0.5))], ..Scene::default() };
    for corners in corners {
        let first = scene.vertices.len() as u32;
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or(Vec3::Z);
        for &position in corners {
            scene.vertices.push(Vertex { position, normal, uv: glam::Vec2::ZERO });
        }
        scene.triangles.push(Triangle { vertices: [first, first + 1, first + 2], material: 0 });
    }
    scene
}

/// t, u, v by Cramer's rule in double precision.
fn intersect(ray: &Ray, corners: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    let direction = ray.direction.as_dvec3();
    let matrix = glam::DMat3::from_cols(-direction, b - a, c - a);
    matrix.inverse() * (ray.origin.as_dvec3() - a)
}

/// How far inside the triangle and the ray's range a hit is; negative outside. Both lists of hits
/// must agree where this is clear of rounding.
fn clearance(ray: &Ray, hit: DVec3) -> f64 {
    let (t, u, v) = (hit.x, hit.y, hit.z);
    let range = (t - f64::from(ray.t_min)).min(f64::from(ray.t_max) - t);
    u.min(v).min(1.0 - u - v).min(range)
}

/// Single precision, unit-sized numbers, triangles that are not slivers.
const ROUNDING: f64 = 1e-4;

fn point() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-1.0_f32..1.0).prop_map(Vec3::from_array)
}

fn soup() -> impl Strategy<Value = Vec<[Vec3; 3]>> {
    let triangle = (point(), point(), point(), 0.05_f32..0.8)
        .prop_map(|(at, b, c, size)| [at, at + size * b, at + size * c]);
    let fat = triangle.prop_filter("a sliver", |[a, b, c]| {
        let (b, c) = (*b - *a, *c - *a);
        b.cross(c).length() > 0.2 * b.length() * c.length()
    });
    prop::collection::vec(fat, 1..60)
}

fn ray() -> impl Strategy<Value = Ray> {
    let axis = (0_usize..6).prop_map(|i| if i < 3 { Vec3::AXES[i] } else { -Vec3::AXES[i - 3] });
    let direction = prop_oneof![point().prop_filter("short", |d| d.length() > 0.1), axis];
    (point(), direction, 0.0_f32..0.5, prop_oneof![Just(f32::INFINITY), 0.5_f32..2.0]).prop_map(
        |(origin, direction, t_min, t_max)| Ray { origin: 1.5 * origin, direction, t_min, t_max },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn agrees_with_a_loop(corners in soup(), ray in ray()) {
        let bvh = Bvh::build(&scene(&corners));
        let exact: Vec<_> = corners.iter().map(|&corners| intersect(&ray, corners)).collect();
        let clear: Vec<_> = exact.iter().map(|&hit| clearance(&ray, hit)).collect();

        let mut found = vec![None; corners.len()];
        bvh.all_hits(&ray, |hit| {
            assert!(found[hit.triangle as usize].replace(hit).is_none(), "visited twice");
        });
        for (triangle, hit) in found.iter().enumerate() {
            match hit {
                Some(hit) => {
                    prop_assert!(clear[triangle] > -ROUNDING, "{hit:?} is no hit");
                    let error = DVec3::new(hit.t.into(), hit.u.into(), hit.v.into()) - exact[triangle];
                    prop_assert!(error.abs().max_element() < ROUNDING * (1.0 + exact[triangle].x));
                }
                None => prop_assert!(clear[triangle] < ROUNDING, "missed {triangle}"),
            }
        }
        let nearest = found.iter().flatten().min_by(|a, b| a.t.total_cmp(&b.t));
        prop_assert_eq!(bvh.closest(&ray).map(|hit| hit.t), nearest.map(|hit| hit.t));
        prop_assert_eq!(bvh.occluded(&ray), nearest.is_some());
    }
}

#[test]
fn an_empty_scene_is_hit_by_nothing() {
    let bvh = Bvh::build(&Scene::default());
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    assert_eq!(bvh.closest(&ray), None);
    assert!(!bvh.occluded(&ray));
    bvh.all_hits(&ray, |hit| panic!("{hit:?}"));
}

#[test]
fn one_triangle_is_enough() {
    let bvh = Bvh::build(&scene(&[[Vec3::ZERO, Vec3::X, Vec3::Y]]));
    let hit = bvh.closest(&Ray::new(Vec3::new(0.25, 0.5, 2.0), -Vec3::Z));
    assert_eq!(hit, Some(Hit { t: 2.0, triangle: 0, u: 0.25, v: 0.5 }));
}

/// Triangles whose boxes nest like a nautilus make deep trees.
#[test]
fn deep_hierarchies_do_not_overflow() {
    let corners: Vec<_> = (-120..120)
        .map(|exponent| {
            let size = 1.2_f32.powi(exponent);
            [Vec3::new(size, 0.0, 0.0), Vec3::new(0.0, size, 0.0), Vec3::new(0.0, 0.0, size)]
        })
        .collect();
    let bvh = Bvh::build(&scene(&corners));
    let mut count = 0;
    bvh.all_hits(&Ray::new(Vec3::ZERO, Vec3::ONE), |_| count += 1);
    assert_eq!(count, corners.len());
}

/// A path that leaves a surface must not meet it again, whatever the size of the scene and its
/// distance from the origin.
#[test]
fn shifted_origins_leave_their_surface() {
    for (size, at) in [(1e-3, 0.0), (1.0, 0.0), (1.0, 100.0), (1e4, 0.0)] {
        let corner = Vec3::splat(at);
        let [x, y] = [Vec3::new(1.0, 0.3, 0.1), Vec3::new(-0.2, 1.0, 0.4)].map(|edge| size * edge);
        let quad = [[corner, corner + x, corner + x + y], [corner, corner + x + y, corner + y]];
        let scene = scene(&quad);
        let bvh = Bvh::build(&scene);
        for i in 0..2000_u32 {
            let [u, v, angle, height] = [0.754_877_7, 0.569_840_3, 0.437_016, 0.618_034]
                .map(|step: f32| (i as f32 * step).fract());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let surface = scene.surface(i % 2, u, v, -x.cross(y));
            let (across, along) = surface.geometric_normal.any_orthonormal_pair();
            let (sin, cos) = (std::f32::consts::TAU * angle).sin_cos();
            // Down to a thousandth of a radian above the horizon.
            let direction =
                (1e-3 + height * height) * surface.geometric_normal + cos * across + sin * along;
            let origin = bvh.shifted(surface.position, surface.geometric_normal);
            assert!(!bvh.occluded(&Ray::new(origin, direction)), "size {size} at {at}, ray {i}");
        }
    }
}
