//! The inside of a Lambertian sphere: whatever the light's place and direction, its flux Φ makes the
//! k-th bounce ρ^(k+1) Φ / (4π²R²) at every point and in every direction.

use std::f32::consts::PI;

use glam::Vec3;
use manylights_path_tracer::{Reference, Settings, render};
use manylights_scene::builtin::integrating_sphere::{ALBEDO, INTENSITY, RADIUS};
use manylights_scene::{Light, Scene, load};
use manylights_scene::{Transport, Visibility};

/// Bound of the relative error that flat facets cause. Their centres are nearer to the light than R
/// by δ, which raises its irradiance by 2δ/R; and of the light that the smooth normal gathers, the
/// part below the plane of the facet is lost: θ²/4 where the normals differ by θ = √(2δ/R).
fn facets(scene: &Scene) -> f64 {
    let distance =
        |triangle| scene.geometric_normal(triangle).dot(scene.corners(triangle)[0]).abs();
    let nearest = (0..scene.triangles.len() as u32).map(distance).fold(RADIUS, f32::min);
    2.5 * f64::from(1.0 - nearest / RADIUS)
}

fn sphere(light: Light) -> Scene {
    let mut scene = load("integrating-sphere", None).expect("a built-in scene");
    scene.lights = vec![light];
    scene
}

fn reference(scene: &Scene, transport: &str, visibility: Visibility, samples: u32) -> Reference {
    let transport = match transport.parse().expect("a transport") {
        Transport::Indirect { bounces, .. } => Transport::Indirect { bounces, visibility },
        other => other,
    };
    let settings = Settings { transport, resolution: [24, 16], seed: 7, samples };
    render(scene, &scene.cameras[0], &settings, None, &mut |_| {}).expect("a picture")
}

/// The picture's mean is `expected` within three standard errors beside the facets' bias, and within
/// 0.5 %. The RMSE of the pixels is what the noise floor says, within 12 %: 16 slices or more, but of
/// heavy-tailed samples, are off by up to 7 %.
fn assert_uniform(scene: &Scene, reference: &Reference, expected: f32) {
    let expected = f64::from(expected);
    let bias = facets(scene) * expected;
    let count = reference.image.pixels.len() as f64;
    let mut squares = 0.0;
    for channel in 0..3 {
        let values = || reference.image.pixels.iter().map(|p| f64::from(p[channel]));
        let variances = reference.variance.pixels.iter().map(|p| f64::from(p[channel]));
        let mean = values().sum::<f64>() / count;
        let standard_error = variances.sum::<f64>().sqrt() / count;
        let error = (mean - expected).abs();
        assert!(
            error <= 3.0 * standard_error + bias,
            "mean {mean}, expected {expected} ± {standard_error} ± {bias}"
        );
        assert!(error <= 0.005 * expected, "mean {mean}, expected {expected}");
        squares += values().map(|value| (value - expected).powi(2)).sum::<f64>();
    }
    let rmse = (squares / (3.0 * count)).sqrt();
    let floor = reference.noise_floor;
    assert!(rmse <= 1.12 * floor + bias, "RMSE {rmse}, noise floor {floor}, bias {bias}");
    assert!(rmse >= 0.88 * floor, "RMSE {rmse}, noise floor {floor}");
}

fn centred() -> Light {
    Light::Point { position: Vec3::ZERO, intensity: Vec3::splat(INTENSITY) }
}

fn off_centre() -> Light {
    Light::Point { position: Vec3::new(0.5, -0.7, 0.4), intensity: Vec3::splat(INTENSITY) }
}

/// A narrow spot with a hard edge, so that its flux is exactly 2π(1 − cos θ) I.
fn spot() -> Light {
    Light::Spot {
        position: Vec3::new(-0.3, 0.6, 0.2),
        direction: Vec3::new(1.0, -2.0, 0.5).normalize(),
        intensity: Vec3::splat(INTENSITY),
        inner: 0.3,
        outer: 0.3001,
    }
}

/// All but a half space in shadow. From the centre the densities of both strategies are alike everywhere:
/// paths that start at the light carry two thirds of the weight, so a density that is off by 3 % makes
/// the picture wrong by 0.7 %.
fn wide_spot() -> Light {
    let (inner, outer) = (WIDE, WIDE + 1e-4);
    let (position, direction) = (Vec3::ZERO, Vec3::new(0.2, -1.0, 0.4).normalize());
    Light::Spot { position, direction, intensity: Vec3::splat(INTENSITY), inner, outer }
}

const WIDE: f32 = 1.5;

/// ρ^(k+1) Φ / (4π²R²) for flux in units of that of a point light.
fn bounce(k: i32, flux: f32) -> f32 {
    ALBEDO.powi(k + 1) * flux * INTENSITY / (PI * RADIUS * RADIUS)
}

fn spot_flux() -> f32 {
    (1.0 - 0.300_05_f32.cos()) / 2.0
}

fn wide_spot_flux() -> f32 {
    (1.0 - (WIDE + 5e-5).cos()) / 2.0
}

#[test]
fn direct_light_is_exact() {
    let scene = sphere(centred());
    let reference = reference(&scene, "direct", Visibility::Traced, 32);
    assert_uniform(&scene, &reference, bounce(0, 1.0));
    assert_eq!(reference.noise_floor, 0.0);
}

#[test]
fn one_bounce() {
    for visibility in [Visibility::Traced, Visibility::Ignored] {
        for (light, flux) in [
            (centred(), 1.0),
            (off_centre(), 1.0),
            (spot(), spot_flux()),
            (wide_spot(), wide_spot_flux()),
        ] {
            let scene = sphere(light);
            let reference = reference(&scene, "indirect-1", visibility, 256);
            assert_uniform(&scene, &reference, bounce(1, flux));
        }
    }
}

#[test]
fn three_bounces_add_up() {
    for (light, flux) in [(off_centre(), 1.0), (spot(), spot_flux())] {
        let scene = sphere(light);
        let reference = reference(&scene, "indirect-3", Visibility::Traced, 256);
        assert_uniform(&scene, &reference, (1..=3).map(|k| bounce(k, flux)).sum());
    }
}

#[test]
fn all_bounces_make_the_geometric_series() {
    let scene = sphere(centred());
    let reference = reference(&scene, "all", Visibility::Traced, 512);
    assert_uniform(&scene, &reference, bounce(0, 1.0) / (1.0 - ALBEDO));
}
