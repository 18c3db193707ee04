use glam::Vec3;
use manylights_path_tracer::{Settings, render};
use manylights_scene::builtin::integrating_sphere::*;
use manylights_scene::{Light, load};
#[test]
fn debug() {
    let mut scene = load("integrating-sphere", None).expect("x");
    for light in [Vec3::ZERO, Vec3::new(0.5, -0.7, 0.4)] {
        scene.lights = vec![Light::Point { position: light, intensity: Vec3::splat(INTENSITY) }];
        let settings = Settings { transport: "indirect-1".parse().expect("t"), resolution: [24, 16], seed: 7, samples: 128 };
        let r = render(&scene, &scene.cameras[0], &settings, None, &mut |_| {}).expect("p");
        let mut v: Vec<_> = r.image.pixels.iter().zip(&r.variance.pixels).enumerate().map(|(i, (p, v))| (p[0] - 0.25, v[0].sqrt(), i)).collect();
        v.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        println!("{:?} {:?} floor {}", light, &v[v.len() - 6..], r.noise_floor);
    }
}
