//! Panels between two floors, as lights that are no surfaces and as emissive meshes, against closed forms;
//! two-sided ones also against two panels back to back.

mod field_cases;

use std::f64::consts::PI;

use glam::{Vec2, Vec3};
use manylights_path_tracer::{Reference, Settings, render, seen_emission};
use manylights_paths::closed_form::polygon_irradiance;
use manylights_scene::bvh::{Bvh, Ray};
use manylights_scene::{
    AreaLight, Camera, Material, Scene, Transport, Triangle, Vertex, Visibility, content_hash,
};

const RESOLUTION: [u32; 2] = [12, 12];
const RADIANCE: f32 = 3.0;
const ALBEDO: f32 = 0.6;
/// Triangles of both floors, the first of their scenes.
const FLOORS: u32 = 4;
/// Of the panel, between the floors at 0 and 2.
const HEIGHT: f32 = 0.7;
const DIRECT: [Transport; 2] = [
    Transport::Direct { visibility: Visibility::Traced },
    Transport::Direct { visibility: Visibility::Ignored },
];

/// What the panel is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Panel {
    /// No surface of the scene.
    Light,
    Mesh,
}

/// Counter-clockwise seen from above.
fn square(half: f32, height: f32) -> [Vec3; 4] {
    [(-half, -half), (-half, half), (half, half), (half, -half)]
        .map(|(x, z)| Vec3::new(x, height, z))
}

fn add_square(scene: &mut Scene, corners: [Vec3; 4], material: u32) {
    let first = scene.vertices.len() as u32;
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    scene.vertices.extend(corners.map(|position| Vertex { position, normal, uv: Vec2::ZERO }));
    for vertices in [[first, first + 1, first + 2], [first, first + 2, first + 3]] {
        scene.triangles.push(Triangle { vertices, material });
    }
}

/// The floors and no panel, seen from between them.
fn floors(material: Material) -> Scene {
    let dark = Material::lambert("panel", Vec3::ZERO);
    let panel = Material { emission: Vec3::splat(RADIANCE), ..dark };
    let mut scene = Scene { materials: vec![material, panel], ..Scene::default() };
    add_square(&mut scene, square(1.0, 0.0), 0);
    add_square(&mut scene, square(1.0, 2.0), 0);
    let looking = |height: f32, target: f32| {
        let eye = Vec3::new(0.3, height, 2.4);
        Camera::look_at("eye", eye, Vec3::new(0.0, target, 0.0), Vec3::Y, 0.6)
    };
    scene.cameras = vec![looking(1.6, 0.0), looking(0.4, 2.0)];
    scene
}

/// Adds a panel that shines up, or from both sides.
fn add_panel(scene: &mut Scene, panel: Panel, corners: [Vec3; 4], two_sided: bool) {
    match panel {
        Panel::Light => {
            let [a, b, c, d] = corners;
            scene.area_lights.extend([[a, b, c], [a, c, d]].map(|corners| AreaLight::Triangle {
                corners,
                radiance: Vec3::splat(RADIANCE),
                two_sided,
            }));
        }
        Panel::Mesh => {
            scene.materials[1].two_sided = two_sided;
            add_square(scene, corners, 1);
        }
    }
}

fn two_sided(material: Material, panel: Panel) -> Scene {
    let mut scene = floors(material);
    add_panel(&mut scene, panel, square(0.4, HEIGHT), true);
    scene
}

/// One panel up and one down, a hair apart where rays would not know which of them they hit.
fn back_to_back(material: Material, panel: Panel) -> Scene {
    let mut scene = floors(material);
    let half_gap = if panel == Panel::Mesh { 5e-4 } else { 0.0 };
    add_panel(&mut scene, panel, square(0.4, HEIGHT + half_gap), false);
    let mut down = square(0.4, HEIGHT - half_gap);
    down.reverse();
    add_panel(&mut scene, panel, down, false);
    scene
}

fn picture(scene: &Scene, camera: usize, transport: Transport, samples: u32) -> Reference {
    let settings = Settings { transport, resolution: RESOLUTION, seed: 5, samples };
    render(scene, &scene.cameras[camera], &settings, None, &mut |_| {}).expect("a picture")
}

/// Mean of all pixels and its variance.
fn mean(reference: &Reference) -> (f64, f64) {
    let pixels = reference.image.pixels.len() as f64;
    let sum = |pixels: &[[f32; 3]]| pixels.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>();
    (sum(&reference.image.pixels) / pixels, sum(&reference.variance.pixels) / pixels.powi(2))
}

/// What each pixel sees of Lambertian floors under panels of unit radiance in closed form; `None` where it sees
/// a panel or nothing.
fn closed_form(
    scene: &Scene,
    camera: usize,
    panels: &[[Vec3; 4]],
    two_sided: bool,
) -> Vec<Option<f64>> {
    let (bvh, camera) = (Bvh::build(scene), &scene.cameras[camera]);
    let [width, height] = RESOLUTION;
    let pixel = |index: u32| {
        let direction = camera.direction(index % width, index / width, RESOLUTION);
        let hit = bvh.closest(&Ray::new(camera.position, direction))?;
        let point = scene.surface(hit.triangle, hit.u, hit.v, direction);
        let irradiance = |panel: &[Vec3; 4]| {
            let relative =
                panel.map(|corner| (corner.as_dvec3() - point.position.as_dvec3()).to_array());
            let mut turned = relative;
            turned.reverse();
            let normal = point.geometric_normal.as_dvec3().to_array();
            let [front, back] =
                [relative, turned].map(|corners| polygon_irradiance(normal, &corners));
            assert!(front.min(back) < 1e-12, "a point sees one side");
            if two_sided { front + back } else { front }
        };
        let sum = panels.iter().map(irradiance).sum::<f64>();
        (hit.triangle < FLOORS).then_some(f64::from(ALBEDO) * sum / PI)
    };
    (0..width * height).map(pixel).collect()
}

/// Each pixel within six of its own standard deviations or 0.1 %, none noisier than `noise` of its value (or of
/// the brightest's twentieth), and more than 30 of them lit.
fn assert_agrees(what: &str, reference: &Reference, expected: &[Option<f64>], noise: f64) {
    let brightest = expected.iter().flatten().fold(0.0, |most: f64, &value| most.max(value));
    let mut lit = 0;
    for (index, expected) in expected.iter().enumerate() {
        let value = f64::from(reference.image.pixels[index][0]);
        // The panel itself reflects nothing.
        let expected = f64::from(RADIANCE) * expected.unwrap_or(0.0);
        let deviation = f64::from(reference.variance.pixels[index][0]).sqrt();
        lit += u32::from(expected > 0.0);
        let limit = 6.0 * deviation + 1e-3 * expected;
        assert!(
            (value - expected).abs() <= limit,
            "{what}, pixel {index}: {value}, expected {expected} ± {deviation}"
        );
        let quiet = noise * expected.max(0.05 * f64::from(RADIANCE) * brightest);
        assert!(deviation <= quiet, "{what}, pixel {index}: {expected} ± {deviation}");
    }
    assert!(lit > 30, "{what}: {lit}");
}

#[test]
fn both_floors_have_the_irradiance_of_closed_forms() {
    for panel in [Panel::Light, Panel::Mesh] {
        let scene = two_sided(Material::lambert("floor", Vec3::splat(ALBEDO)), panel);
        for camera in 0..2 {
            let expected = closed_form(&scene, camera, &[square(0.4, HEIGHT)], true);
            for transport in DIRECT {
                let reference = picture(&scene, camera, transport, 1024);
                let what = format!("{panel:?}, camera {camera}, {transport}");
                assert_agrees(&what, &reference, &expected, 0.05);
            }
        }
    }
}

/// The same light by all light paths: by points on the panel, by directions that find its back, by solid
/// angle, and after bounces.
#[test]
fn a_panel_of_two_sides_is_two_panels_of_one() {
    let indirect = "indirect-1".parse().expect("a transport");
    let floors = [
        Material::lambert("floor", Vec3::splat(ALBEDO)),
        Material::metal("floor", Vec3::splat(0.8), 0.3),
    ];
    for material in floors {
        for (panel, transports) in [
            (Panel::Light, DIRECT.to_vec()),
            (Panel::Mesh, [&DIRECT[..], &[indirect, Transport::All]].concat()),
        ] {
            let scenes = [two_sided, back_to_back].map(|make| make(material.clone(), panel));
            for transport in transports {
                for camera in 0..2 {
                    let samples = if transport == indirect { 4096 } else { 2048 };
                    let pictures = [0, 1].map(|i| picture(&scenes[i], camera, transport, samples));
                    let [(own, a), (other, b)] = [mean(&pictures[0]), mean(&pictures[1])];
                    let deviation = (a + b).sqrt();
                    let what = format!("{panel:?}, {transport}, camera {camera}");
                    println!("{what}: {own} {other} ± {deviation}");
                    assert!(deviation < 0.05 * own, "{what}: {deviation} of {own}");
                    // The gap of the meshes moves them by 0.1 % of their distance.
                    let limit = 4.0 * deviation + 2e-3 * own;
                    assert!((own - other).abs() < limit, "{what}: {own} {other} ± {deviation}");
                }
            }
        }
    }
}

#[test]
fn cameras_see_the_back_of_an_emitter_of_two_sides() {
    let mut scene = two_sided(Material::lambert("floor", Vec3::ZERO), Panel::Mesh);
    for height in [0.2, 1.5] {
        let eye = Vec3::new(0.1, height, 0.0);
        let target = Vec3::new(0.1, HEIGHT, 1e-3);
        scene.cameras = vec![Camera::look_at("eye", eye, target, Vec3::X, 0.1)];
        let seen = picture(&scene, 0, Transport::All, 32);
        assert!(seen.image.pixels.iter().all(|&pixel| pixel == [RADIANCE; 3]), "{height}");
        assert_eq!(seen_emission(&scene, &scene.cameras[0], RESOLUTION), seen.image);
    }
}

/// The content of a picture, where it shines: else all references of old files would be made again.
#[test]
fn sides_count_in_the_content_where_they_shine() {
    let material = || Material::lambert("floor", Vec3::ONE);
    let hash = |scene: &Scene| content_hash(scene, &scene.cameras[0]);
    for panel in [Panel::Light, Panel::Mesh] {
        let mut scene = two_sided(material(), panel);
        let both = hash(&scene);
        scene.materials[1].two_sided = false;
        for light in &mut scene.area_lights {
            let AreaLight::Triangle { two_sided, .. } = light else { panic!("{light:?}") };
            *two_sided = false;
        }
        assert_ne!(hash(&scene), both, "{panel:?}");
        let before = hash(&scene);
        scene.materials[0].two_sided = true;
        assert_eq!(hash(&scene), before, "a dark material");
    }
}
