//! Emissive triangles against closed forms.

use std::f64::consts::PI;

use glam::{DVec3, Vec2, Vec3};
use manylights_path_tracer::{Reference, Settings, render, seen_emission};
use manylights_scene::bvh::{Bvh, Ray};
use manylights_scene::{Camera, Material, Scene, Transport, Triangle, Vertex, Visibility};

const ALBEDO: f32 = 0.6;
const RADIANCE: f32 = 3.0;
const RESOLUTION: [u32; 2] = [12, 12];

fn add_quad(scene: &mut Scene, corners: [Vec3; 4], material: u32) {
    let first = scene.vertices.len() as u32;
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    scene.vertices.extend(corners.map(|position| Vertex { position, normal, uv: Vec2::ZERO }));
    scene.triangles.push(Triangle { vertices: [first, first + 1, first + 2], material });
    scene.triangles.push(Triangle { vertices: [first, first + 2, first + 3], material });
}

/// A quad lamp that faces down, at a height above the floor at which the floor's radiance spans a
/// wide range.
fn lamp(height: f32) -> [Vec3; 4] {
    [(-0.5, -0.4), (0.7, -0.4), (0.7, 0.3), (-0.5, 0.3)].map(|(x, z)| Vec3::new(x, height, z))
}

fn scene(floor: Material, height: f32) -> Scene {
    let mut scene = Scene::default();
    let dark = Material::lambert("lamp", Vec3::ZERO);
    scene.materials = vec![floor, Material { emission: Vec3::splat(RADIANCE), ..dark }];
    let corners = [(-3.0, -3.0), (-3.0, 3.0), (3.0, 3.0), (3.0, -3.0)];
    add_quad(&mut scene, corners.map(|(x, z)| Vec3::new(x, 0.0, z)), 0);
    add_quad(&mut scene, lamp(height), 1);
    let eye = Vec3::new(0.0, 2.5, 4.0);
    scene.cameras.push(Camera::look_at("eye", eye, Vec3::ZERO, Vec3::Y, 0.7));
    scene
}

/// Irradiance of a polygon of unit radiance on a plane (Lambert 1760): ½ Σ θᵢ (Γᵢ · n) over its edges.
fn polygon_irradiance(point: DVec3, normal: DVec3, corners: [Vec3; 4]) -> f64 {
    let directions = corners.map(|corner| (corner.as_dvec3() - point).normalize());
    let edge = |i: usize| {
        let (a, b) = (directions[i], directions[(i + 1) % 4]);
        let cross = a.cross(b);
        0.5 * a.dot(b).acos() * cross.normalize().dot(normal)
    };
    (0..4).map(edge).sum::<f64>().abs()
}

fn direct(scene: &Scene, visibility: Visibility, samples: u32) -> Reference {
    let transport = Transport::Direct { visibility };
    let settings = Settings { transport, resolution: RESOLUTION, seed: 11, samples };
    render(scene, &scene.cameras[0], &settings, None, &mut |_| {}).expect("a picture")
}

/// The light of whole lamps on a white-ish floor of two triangles, all else being black. Each pixel
/// within eight of its own estimated standard deviations (the tails are heavy next to the lamp), or
/// 0.1 %; their sum within three, and within 0.5 %. Gives the sum.
fn assert_lit(scene: &Scene, visibility: Visibility, lamps: &[[Vec3; 4]]) -> f64 {
    let reference = direct(scene, visibility, 4096);
    let bvh = Bvh::build(scene);
    let camera = &scene.cameras[0];
    let mut lit = 0;
    let (mut total, mut expected_total, mut variance) = (0.0, 0.0, 0.0);
    for (index, pixel) in (0..).zip(&reference.image.pixels) {
        let direction = camera.direction(index % RESOLUTION[0], index / RESOLUTION[0], RESOLUTION);
        let expected = match bvh.closest(&Ray::new(camera.position, direction)) {
            None => 0.0,
            Some(hit) if hit.triangle >= 2 => 0.0, // the back of a lamp, or a shade
            Some(hit) => {
                let point = (camera.position + hit.t * direction).as_dvec3();
                let irradiance = |lamp: &[Vec3; 4]| polygon_irradiance(point, DVec3::Y, *lamp);
                f64::from(ALBEDO * RADIANCE) * lamps.iter().map(irradiance).sum::<f64>() / PI
            }
        };
        lit += u32::from(expected > 0.0);
        let pixel_variance = f64::from(reference.variance.pixels[index as usize][0]);
        let error = (f64::from(pixel[0]) - expected).abs();
        let limit = 8.0 * pixel_variance.sqrt() + 1e-3 * expected;
        assert!(
            error <= limit,
            "pixel {index}: {pixel:?}, expected {expected} ± {}",
            pixel_variance.sqrt()
        );
        total += f64::from(pixel[0]);
        expected_total += expected;
        variance += pixel_variance;
    }
    assert!(lit > 50, "the floor is not seen: {lit}");
    let error = (total - expected_total).abs();
    assert!(error <= 3.0 * variance.sqrt() + 1e-6 * expected_total, "{total} {expected_total}");
    assert!(error <= 0.005 * expected_total, "{total} {expected_total}");
    total
}

#[test]
fn a_floor_under_a_lamp() {
    for height in [1.0, 0.05] {
        let scene = scene(Material::lambert("floor", Vec3::splat(ALBEDO)), height);
        assert_lit(&scene, Visibility::Traced, &[lamp(height)]);
    }
}

/// A lamp above the lamp, and a shade below both: without shadows each lights the floor as if it were
/// alone, whether its points are drawn or found.
#[test]
fn nothing_hides_a_lamp_where_visibility_is_ignored() {
    for height in [1.0, 0.3] {
        let mut scene = scene(Material::lambert("floor", Vec3::splat(ALBEDO)), height);
        assert_lit(&scene, Visibility::Ignored, &[lamp(height)]);
        add_quad(&mut scene, lamp(1.5 * height), 1);
        scene.materials.push(Material::lambert("shade", Vec3::ZERO));
        add_quad(&mut scene, lamp(0.5 * height), 2);
        let both = [lamp(height), lamp(1.5 * height)];
        let shaded = assert_lit(&scene, Visibility::Ignored, &both);
        let traced = direct(&scene, Visibility::Traced, 64);
        let total: f64 = traced.image.pixels.iter().map(|pixel| f64::from(pixel[0])).sum();
        assert!(total < 0.8 * shaded, "the shade takes light: {total} of {shaded}");
    }
}

/// Seen from its front a lamp shows its radiance where everything counts, from its back none; direct
/// light is without it.
#[test]
fn lamps_emit_from_their_front() {
    let mut scene = scene(Material::lambert("floor", Vec3::ZERO), 1.0);
    for (eye, expected) in [(0.1, RADIANCE), (2.0, 0.0)] {
        let eye = Vec3::new(0.1, eye, 0.0);
        let target = Vec3::new(0.1, 1.0, 0.001);
        scene.cameras = vec![Camera::look_at("eye", eye, target, Vec3::X, 0.1)];
        let black = direct(&scene, Visibility::Traced, 32);
        assert!(black.image.pixels.iter().all(|&pixel| pixel == [0.0; 3]));
        let settings =
            Settings { transport: Transport::All, resolution: RESOLUTION, seed: 11, samples: 32 };
        let camera = &scene.cameras[0];
        let all = render(&scene, camera, &settings, None, &mut |_| {}).expect("a picture");
        assert!(all.image.pixels.iter().all(|&pixel| pixel == [expected; 3]));
        assert_eq!(seen_emission(&scene, camera, RESOLUTION), all.image);
    }
}

/// An emitter that fills the sky above a glossy floor: each of the two strategies fails somewhere on
/// it alone. Its picture is the floor's albedo times the radiance where the lamp covers all; where
/// visibility is ignored, behind a cloud, too.
#[test]
fn a_glossy_floor_under_a_sky() {
    let floor = Material::metal("floor", Vec3::ONE, 0.3);
    let mut scene = Scene::default();
    let dark = Material::lambert("sky", Vec3::ZERO);
    scene.materials = vec![floor, Material { emission: Vec3::splat(RADIANCE), ..dark }];
    let square = |size: f32, height: f32| {
        [(-size, -size), (-size, size), (size, size), (size, -size)]
            .map(|(x, z)| Vec3::new(x, height, z))
    };
    add_quad(&mut scene, square(1.0, 0.0), 0);
    let mut sky = square(1000.0, 1.0);
    sky.reverse();
    add_quad(&mut scene, sky, 1);
    let eye = Vec3::new(0.0, 0.9, 0.0);
    scene.cameras.push(Camera::look_at("eye", eye, Vec3::ZERO, Vec3::X, 0.05));
    assert_albedo(&direct(&scene, Visibility::Traced, 4096));
    scene.materials.push(Material::lambert("cloud", Vec3::ZERO));
    add_quad(&mut scene, square(1000.0, 0.95), 2);
    assert_albedo(&direct(&scene, Visibility::Ignored, 4096));
    let hidden = direct(&scene, Visibility::Traced, 4096).image;
    assert_eq!(hidden.pixels, [[0.0; 3]; 144]);
}

fn assert_albedo(reference: &Reference) {
    let mean = reference.image.pixels.iter().map(|p| f64::from(p[0])).sum::<f64>() / 144.0;
    let variance: f64 = reference.variance.pixels.iter().map(|p| f64::from(p[0])).sum();
    // The white-furnace albedo at normal view for this roughness, see the tests of the BRDF.
    let expected = f64::from(RADIANCE) * 0.990_665_5;
    let error = (mean - expected).abs();
    assert!(error <= 3.0 * variance.sqrt() / 144.0 + 1e-3 * expected, "{mean} {expected}");
}
