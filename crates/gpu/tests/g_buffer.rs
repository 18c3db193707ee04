//! The rasterised G-buffer against rays.

use glam::Vec3;
use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord};
use manylights_scene::bvh::{Bvh, Ray};
use manylights_scene::{Camera, Scene, SurfacePoint};

/// Same material, and position within 1e-4 of the scene size, at 99.9 % of the pixels.
fn agrees_with_rays(scene: &Scene, camera: &Camera, resolution: [u32; 2]) {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let frame = GpuFrame::new(&gpu, scene, camera, resolution).expect("the scene fits");
    let surfaces: Vec<SurfaceRecord> = gpu.read(frame.surfaces()).expect("read-back");
    let bvh = Bvh::build(scene);
    let size = scene.size();
    let mut differing = 0;
    for (index, surface) in surfaces.iter().enumerate() {
        let (x, y) = (index as u32 % resolution[0], index as u32 / resolution[0]);
        let direction = camera.direction(x, y, resolution);
        let hit = bvh.closest(&Ray::new(camera.position, direction));
        let expected =
            hit.map(|hit| scene.surface(hit.triangle, hit.u, hit.v, direction).facing(-direction));
        if !same(surface, expected, size) {
            differing += 1;
        }
    }
    let share = 1.0 - f64::from(differing) / surfaces.len() as f64;
    println!("{}: {:.4} % of the pixels agree", scene.name, 100.0 * share);
    assert!(share >= 0.999, "{}: {differing} of {} pixels differ", scene.name, surfaces.len());
}

fn same(surface: &SurfaceRecord, expected: Option<SurfacePoint>, size: f32) -> bool {
    let Some(expected) = expected else {
        return surface.triangle == SurfaceRecord::NO_TRIANGLE;
    };
    surface.triangle != SurfaceRecord::NO_TRIANGLE
        && surface.material == expected.material
        && surface.position.distance(expected.position) <= 1e-4 * size
        && surface.normal.distance(expected.normal) <= 1e-3
        && surface.diffuse.distance(expected.brdf.diffuse) <= 1e-3
}

#[test]
fn built_in_scenes() {
    for builtin in manylights_scene::builtin::BUILTINS {
        let scene = (builtin.make)();
        agrees_with_rays(&scene, &scene.cameras[0], [160, 120]);
    }
}

#[test]
fn scenes_of_any_scale() {
    for scale in [1e-3, 1e4] {
        let mut scene = manylights_scene::load("cornell", None).expect("built in");
        for vertex in &mut scene.vertices {
            vertex.position *= scale;
        }
        let mut camera = scene.cameras[0].clone();
        camera.position *= scale;
        agrees_with_rays(&scene, &camera, [160, 120]);
    }
}

/// Of zero length, against the winding, and both in one triangle: what some exporters write.
#[test]
fn bad_vertex_normals() {
    let zero: fn(usize, Vec3) -> Vec3 = |_, _| Vec3::ZERO;
    let flipped: fn(usize, Vec3) -> Vec3 = |_, normal| -normal;
    let mixed: fn(usize, Vec3) -> Vec3 = |i, normal| if i % 2 == 0 { -normal } else { normal };
    for spoil in [zero, flipped, mixed] {
        let mut scene = manylights_scene::load("trio", None).expect("built in");
        for (index, vertex) in scene.vertices.iter_mut().enumerate() {
            vertex.normal = spoil(index, vertex.normal);
        }
        agrees_with_rays(&scene, &scene.cameras[0], [160, 120]);
    }
}

#[test]
fn a_ray_that_leaves_the_scene_finds_nothing() {
    let scene = manylights_scene::load("cornell", None).expect("built in");
    let far = scene.bounds().1 + Vec3::splat(100.0);
    let camera = Camera::look_at("away", far, 2.0 * far, Vec3::Y, 1.0);
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let frame = GpuFrame::new(&gpu, &scene, &camera, [8, 8]).expect("the scene fits");
    let surfaces: Vec<SurfaceRecord> = gpu.read(frame.surfaces()).expect("read-back");
    assert!(surfaces.iter().all(|surface| surface.triangle == SurfaceRecord::NO_TRIANGLE));
}
