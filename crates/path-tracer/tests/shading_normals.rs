//! Paths from lights and paths from the camera where the shading normal is far from the geometric one: the
//! densities of both strategies are over areas, which the geometric normal measures.

use glam::{Vec2, Vec3};
use manylights_path_tracer::{Reference, Settings, render};
use manylights_scene::{Camera, Light, Material, Scene, Transport, Triangle, Vertex, Visibility};

const LIGHT: Vec3 = Vec3::new(0.8, 1.5, 0.1);

fn add_quad(scene: &mut Scene, corners: [[f32; 3]; 4], normal: Vec3) {
    let first = scene.vertices.len() as u32;
    let vertex = |corner| Vertex { position: Vec3::from_array(corner), normal, uv: Vec2::ZERO };
    scene.vertices.extend(corners.map(vertex));
    for vertices in [[first, first + 1, first + 2], [first, first + 2, first + 3]] {
        scene.triangles.push(Triangle { vertices, material: 0 });
    }
}

/// A floor, all that the camera sees, beside a lit wall whose shading normal leans towards the light by 45°.
fn scene(light: Light) -> Scene {
    let materials = vec![Material::lambert("grey", Vec3::splat(0.8))];
    let mut scene = Scene { materials, exposure: 1.0, ..Scene::default() };
    let floor = [[0.0, 0.0, -2.0], [0.0, 0.0, 2.0], [2.0, 0.0, 2.0], [2.0, 0.0, -2.0]];
    add_quad(&mut scene, floor, Vec3::Y);
    let wall = [[0.0, 0.0, 0.5], [0.0, 0.0, -0.5], [0.0, 1.0, -0.5], [0.0, 1.0, 0.5]];
    add_quad(&mut scene, wall, Vec3::new(1.0, 1.0, 0.0).normalize());
    let (eye, target) = (Vec3::new(0.6, 1.2, 0.0), Vec3::new(0.6, 0.0, 0.0));
    scene.cameras.push(Camera::look_at("eye", eye, target, Vec3::X, 0.6));
    scene.lights = vec![light];
    scene
}

fn one_bounce(light: Light, visibility: Visibility) -> Reference {
    let scene = scene(light);
    let transport = Transport::Indirect { bounces: 1, visibility };
    let settings = Settings { transport, resolution: [16, 16], seed: 5, samples: 4096 };
    render(&scene, &scene.cameras[0], &settings, None, &mut |_| {}).expect("a picture")
}

/// A spot that lights all of the wall alike is followed from both ends, a point light in its place from the
/// camera alone. The floor sends nothing to itself.
#[test]
fn a_spot_is_a_point_light_where_it_lights_all() {
    let intensity = Vec3::splat(3.0);
    let direction = (Vec3::new(0.0, 0.5, 0.0) - LIGHT).normalize();
    let spot = Light::Spot { position: LIGHT, direction, intensity, inner: 0.65, outer: 0.75 };
    for corner in [[0.0, 0.0, 0.5], [0.0, 0.0, -0.5], [0.0, 1.0, -0.5], [0.0, 1.0, 0.5]] {
        assert_eq!(spot.intensity((Vec3::from_array(corner) - LIGHT).normalize()), intensity);
    }
    let point = Light::Point { position: LIGHT, intensity };
    for visibility in [Visibility::Traced, Visibility::Ignored] {
        let [both, camera] = [spot, point].map(|light| one_bounce(light, visibility));
        let sum = |image: &manylights_metrics::RadianceImage| {
            image.pixels.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>()
        };
        let expected = sum(&camera.image);
        let deviation = (sum(&both.variance) + sum(&camera.variance)).sqrt();
        let error = (sum(&both.image) - expected).abs();
        println!("{error} of {expected} ± {deviation}");
        // Sensitive to 1 %, and five standard deviations off by chance never.
        assert!(5.0 * deviation < 0.01 * expected, "{deviation} of {expected}: a weak test");
        assert!(error < 5.0 * deviation, "{error} of {expected} ± {deviation}");
    }
}
