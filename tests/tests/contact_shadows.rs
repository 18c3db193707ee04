//! Shadows of what stands next to a surface: shadow rays start as near to it as they may.

use glam::{Vec2, Vec3};
use manylights_gpu::{Center, Shadows};
use manylights_path_tracer::Settings;
use manylights_scene::bvh::Bvh;
use manylights_scene::{Camera, Light, Material, Scene, Transport, Triangle, Vertex, Visibility};
use manylights_tests::Stage;

/// Of the fin, in units of the scene's largest coordinate: 52 times the distance at which rays start.
const HEIGHT: f32 = 1e-4;
/// Just above the floor, so that the shadow of the fin is a hundred times as long as the fin is high.
const LIGHT: Vec3 = Vec3::new(-1.0, 0.01, 0.0);

fn quad(scene: &mut Scene, corners: [[f32; 3]; 4], normal: Vec3) {
    let first = scene.vertices.len() as u32;
    let vertex = |corner| Vertex { position: Vec3::from_array(corner), normal, uv: Vec2::ZERO };
    scene.vertices.extend(corners.map(vertex));
    for vertices in [[first, first + 1, first + 2], [first, first + 2, first + 3]] {
        scene.triangles.push(Triangle { vertices, material: 0 });
    }
}

/// A floor, a fin on it in the plane x = 0, and a view of the floor 1 to 9 mm behind the fin.
fn scene(fin: bool) -> Scene {
    let materials = vec![Material::lambert("grey", Vec3::splat(0.5))];
    let mut scene = Scene { materials, exposure: 1.0, ..Scene::default() };
    let [low, high] = [-1.0, 1.0];
    quad(
        &mut scene,
        [[low, 0.0, low], [low, 0.0, high], [high, 0.0, high], [high, 0.0, low]],
        Vec3::Y,
    );
    if fin {
        let corners = [[0.0, 0.0, low], [0.0, 0.0, high], [0.0, HEIGHT, high], [0.0, HEIGHT, low]];
        quad(&mut scene, corners, Vec3::X);
    }
    let (eye, target) = (Vec3::new(0.005, 0.5, 0.0), Vec3::new(0.005, 0.0, 0.0));
    scene.cameras.push(Camera::look_at("eye", eye, target, Vec3::X, 0.016));
    scene.lights = vec![Light::Point { position: LIGHT, intensity: Vec3::ONE }];
    scene
}

/// By the host, by the adapter and along light paths alike: all is lit, and behind the fin nothing is.
#[test]
fn a_low_fin_shades_what_is_behind_it() {
    for fin in [false, true] {
        let stage = Stage::new(scene(fin), [12, 12]);
        let (scene, surfaces) = (&stage.scene, stage.surfaces());
        let bvh = Bvh::build(scene);
        assert!(surfaces.iter().all(|s| (0.0009..0.0091).contains(&s.position.x)));
        let unseen = surfaces.iter().map(|s| !bvh.sees([s.position, Vec3::Y], [LIGHT, Vec3::X]));
        assert!(unseen.into_iter().all(|unseen| unseen == fin), "on the host, fin: {fin}");

        let shadows = Shadows::new(&stage.on_gpu, scene).expect("the hierarchy fits");
        let occluded = shadows.occluded_lights(&[Center::new(LIGHT, Vec3::X)]);
        let occluded = occluded.expect("a pass");
        assert!(occluded.iter().all(|&occluded| occluded == fin), "on the adapter, fin: {fin}");

        let resolution = stage.on_gpu.resolution();
        let settings = Settings {
            transport: Transport::Direct { visibility: Visibility::Traced },
            resolution,
            seed: 0,
            samples: 16,
        };
        let direct =
            manylights_path_tracer::render(scene, &scene.cameras[0], &settings, None, &mut |_| {});
        let pixels = direct.expect("a picture").image.pixels;
        assert!(pixels.iter().all(|pixel| (pixel[0] == 0.0) == fin), "along paths, fin: {fin}");
    }
}

/// A light that lies just behind a wall is occluded, one on it is not: the far end of a shadow ray.
#[test]
fn a_wall_hides_what_lies_close_behind_it() {
    let stage = Stage::new(scene(true), [4, 4]);
    let bvh = Bvh::build(&stage.scene);
    let shadows = Shadows::new(&stage.on_gpu, &stage.scene).expect("the hierarchy fits");
    for (depth, visible) in [(0.0, true), (1e-5, false), (1e-4, false)] {
        let light = Vec3::new(-depth, 0.5 * HEIGHT, 0.0);
        let seen =
            |s: &manylights_gpu::SurfaceRecord| bvh.sees([s.position, Vec3::Y], [light, Vec3::X]);
        assert!(stage.surfaces().iter().all(|s| seen(s) == visible), "on the host, {depth} m");
        let occluded = shadows.occluded_lights(&[Center::new(light, Vec3::X)]);
        let occluded = occluded.expect("a pass");
        assert!(occluded.iter().all(|occluded| *occluded != visible), "on the adapter, {depth} m");
    }
}
