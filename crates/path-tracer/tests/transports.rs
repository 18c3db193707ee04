//! How the transports make up each other, and what `direct` leaves out where visibility is ignored.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};
use manylights_metrics::RadianceImage;
use manylights_path_tracer::{Error, Reference, Settings, direct_light, render, seen_emission};
use manylights_scene::bvh::{Bvh, Ray};
use manylights_scene::{
    Camera, Light, Material, Scene, Transport, Triangle, Vertex, Visibility, load,
};

const RESOLUTION: [u32; 2] = [16, 12];

fn add_quad(scene: &mut Scene, corners: [Vec3; 4], material: Material) {
    let first = scene.vertices.len() as u32;
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    scene.vertices.extend(corners.map(|position| Vertex { position, normal, uv: Vec2::ZERO }));
    let number = scene.materials.len() as u32;
    scene.materials.push(material);
    for vertices in [[first, first + 1, first + 2], [first, first + 2, first + 3]] {
        scene.triangles.push(Triangle { vertices, material: number });
    }
}

fn rendered(scene: &Scene, transport: Transport, seed: u64, samples: u32) -> Reference {
    let settings = Settings { transport, resolution: RESOLUTION, seed, samples };
    render(scene, &scene.cameras[0], &settings, None, &mut |_| {}).expect("a picture")
}

fn named(name: &str) -> Transport {
    name.parse().expect("a transport")
}

/// Sum over pixels of the green channel.
fn sum(image: &RadianceImage) -> f64 {
    image.pixels.iter().map(|pixel| f64::from(pixel[1])).sum()
}

/// `cornell` with a lamp of two triangles that faces down, and the other lights where they are kept.
fn lamp_room(keep_lights: bool) -> Scene {
    let mut scene = load("cornell", None).expect("a built-in scene");
    if !keep_lights {
        scene.lights.clear();
    }
    let (low, high) = scene.bounds();
    let at = |x: f32, z: f32| low + Vec3::new(x, 0.85, z) * (high - low);
    let corners = [at(0.3, 0.3), at(0.7, 0.3), at(0.7, 0.7), at(0.3, 0.7)];
    let lamp = Material::lambert("lamp", Vec3::ZERO);
    add_quad(&mut scene, corners, Material { emission: Vec3::splat(4.0), ..lamp });
    scene
}

/// Direct light, all bounces and the emission that the camera sees make up everything: within four
/// standard errors of the sum, which are below 2 %, of other seeds.
#[test]
fn parts_make_up_the_whole() {
    let scenes = [
        (load("cornell", None).expect("a built-in scene"), false),
        (load("trio", None).expect("a built-in scene"), false),
        (lamp_room(false), true),
        (lamp_room(true), true),
    ];
    for (scene, shines) in &scenes {
        let all = rendered(scene, Transport::All, 1, 512);
        let direct = rendered(scene, named("direct"), 2, 512);
        let indirect = rendered(scene, named("indirect-64"), 3, 512);
        let emission = seen_emission(scene, &scene.cameras[0], RESOLUTION);
        let pictures = [&all, &direct, &indirect];
        let variance: f64 = pictures.iter().map(|picture| sum(&picture.variance)).sum();
        let whole = sum(&all.image);
        let parts = [sum(&direct.image), sum(&indirect.image), sum(&emission)];
        assert!(4.0 * variance.sqrt() < 0.02 * whole, "{}: {variance} {whole}", scene.name);
        let error = (whole - parts.iter().sum::<f64>()).abs();
        assert!(error < 4.0 * variance.sqrt() + 1e-5 * whole, "{}: {whole} {parts:?}", scene.name);
        // No part is too small to be missed.
        assert!(parts[..2].iter().all(|&part| part > 0.05 * whole), "{}: {parts:?}", scene.name);
        assert_eq!(parts[2] > 0.05 * whole, *shines, "{}: {parts:?}", scene.name);
    }
}

/// `direct+indirect-1` is the exact direct light and the same estimate of one bounce, bit for bit.
#[test]
fn direct_light_is_added_to_one_bounce() {
    let scene = load("trio", None).expect("a built-in scene");
    for visibility in [Visibility::Traced, Visibility::Ignored] {
        let both = Transport::DirectAndIndirect { visibility };
        let one = rendered(&scene, both, 1, 64);
        let direct = rendered(&scene, named("direct"), 1, 64).image;
        let indirect = rendered(&scene, both.estimated(), 1, 64);
        assert!(sum(&direct) > 0.0);
        assert_eq!(direct_light(&scene, &scene.cameras[0], RESOLUTION).expect("exact"), direct);
        assert_eq!(one.variance, indirect.variance);
        let parts = direct.pixels.iter().zip(&indirect.image.pixels);
        for (pixel, (direct, indirect)) in one.image.pixels.iter().zip(parts) {
            for channel in 0..3 {
                let expected = direct[channel] + indirect[channel];
                assert!((pixel[channel] - expected).abs() <= 2.0 * f32::EPSILON * expected);
            }
        }
    }
    let settings = Settings {
        transport: named("direct+indirect-1"),
        resolution: RESOLUTION,
        seed: 1,
        samples: 32,
    };
    let lamps = lamp_room(true);
    let refused = render(&lamps, &lamps.cameras[0], &settings, None, &mut |_| {});
    let error = refused.expect_err("emissive triangles are not exact");
    assert!(matches!(&error, Error::Settings(reason) if reason.contains("emissive triangles")));
}

const ALBEDO: f32 = 0.6;
const INTENSITY: f32 = 5.0;
const LIGHT: Vec3 = Vec3::new(0.2, 1.0, -0.1);
/// Half of the side of a square board at half of the light's height.
const BOARD: f32 = 0.25;

/// A floor under a point light, with a black board between where asked for.
fn floor(board: bool) -> Scene {
    let square = |half: f32, height: f32| {
        [(-half, -half), (-half, half), (half, half), (half, -half)]
            .map(|(x, z)| Vec3::new(x, height, z))
    };
    let mut scene = Scene::default();
    add_quad(&mut scene, square(3.0, 0.0), Material::lambert("floor", Vec3::splat(ALBEDO)));
    if board {
        add_quad(&mut scene, square(BOARD, 0.5), Material::lambert("board", Vec3::ZERO));
    }
    scene.lights.push(Light::Point { position: LIGHT, intensity: Vec3::splat(INTENSITY) });
    let eye = Vec3::new(0.0, 2.5, 3.0);
    scene.cameras.push(Camera::look_at("eye", eye, Vec3::ZERO, Vec3::Y, 0.5));
    scene
}

/// Where the board's shadow falls the difference is the light that it blocks, ρ I cos θ / (π d²),
/// elsewhere nothing.
#[test]
fn ignored_visibility_gives_back_the_light_that_is_blocked() {
    let direct = |scene: &Scene, visibility| {
        rendered(scene, Transport::Direct { visibility }, 1, 1).image.pixels
    };
    let open = floor(false);
    assert_eq!(direct(&open, Visibility::Ignored), direct(&open, Visibility::Traced));
    let scene = floor(true);
    let (traced, ignored) =
        (direct(&scene, Visibility::Traced), direct(&scene, Visibility::Ignored));
    let bvh = Bvh::build(&scene);
    let camera = &scene.cameras[0];
    let (mut shadowed, mut lit) = (0, 0);
    for (index, (traced, ignored)) in (0..).zip(traced.iter().zip(&ignored)) {
        let direction = camera.direction(index % RESOLUTION[0], index / RESOLUTION[0], RESOLUTION);
        let hit = bvh.closest(&Ray::new(camera.position, direction));
        let Some(hit) = hit.filter(|hit| hit.triangle < 2) else {
            assert_eq!((*traced, *ignored), ([0.0; 3], [0.0; 3]));
            continue;
        };
        let point = camera.position + hit.t * direction;
        let offset = LIGHT - point;
        let d2 = offset.length_squared();
        let unblocked = ALBEDO * INTENSITY * (offset.y / d2.sqrt()) / (PI * d2);
        let crossing = point + 0.5 * offset;
        let blocked = crossing.x.abs().max(crossing.z.abs()) < BOARD;
        let expected = if blocked { unblocked } else { 0.0 };
        let difference = ignored[0] - traced[0];
        assert!((difference - expected).abs() <= 1e-5 * unblocked, "pixel {index}: {difference}");
        assert!((ignored[0] - unblocked).abs() <= 1e-5 * unblocked, "pixel {index}: {ignored:?}");
        *(if blocked { &mut shadowed } else { &mut lit }) += 1;
    }
    assert!(shadowed >= 10 && lit >= 50, "{shadowed} {lit}");
}
