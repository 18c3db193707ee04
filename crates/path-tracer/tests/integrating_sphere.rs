//! The inside of a Lambertian sphere: whatever the light's place and direction, its flux Φ makes the
//! k-th bounce ρ^(k+1) Φ / (4π²R²) at every point and in every direction.

use std::f32::consts::PI;

use glam::Vec3;
use manylights_method::{Transport, Visibility};
use manylights_path_tracer::{Reference, Settings, render};
use manylights_scene::builtin::integrating_sphere::{ALBEDO, INTENSITY, RADIUS};
use manylights_scene::{Light, Scene, load};

/// The sphere's facets are flat: radiance is off by up to this, relative (see the built-in scene).
const FACETS: f64 = 5.2e-4;

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

/// The picture's mean is `expected` within three standard errors, each pixel within five of its own,
/// both beside the facets' bias, and the mean within 0.5 %.
fn assert_uniform(reference: &Reference, expected: f32) {
    let expected = f64::from(expected);
    let count = reference.image.pixels.len() as f64;
    for channel in 0..3 {
        let values = || reference.image.pixels.iter().map(|p| f64::from(p[channel]));
        let variances = || reference.variance.pixels.iter().map(|p| f64::from(p[channel]));
        let mean = values().sum::<f64>() / count;
        let standard_error = variances().sum::<f64>().sqrt() / count;
        let error = (mean - expected).abs();
        assert!(
            error <= 3.0 * standard_error + FACETS * expected,
            "mean {mean}, expected {expected} ± {standard_error}"
        );
        assert!(error <= 0.005 * expected, "mean {mean}, expected {expected}");
        // The variance of a pixel is itself estimated from few slices: the picture's mean variance
        // stands in for it.
        let deviation = (variances().sum::<f64>() / count).sqrt();
        let worst = values().map(|value| (value - expected).abs()).fold(0.0, f64::max);
        assert!(
            worst <= 6.0 * deviation + FACETS * expected,
            "a pixel is off by {worst}, standard deviation {deviation}"
        );
    }
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

/// ρ^(k+1) Φ / (4π²R²) for flux in units of that of a point light.
fn bounce(k: i32, flux: f32) -> f32 {
    ALBEDO.powi(k + 1) * flux * INTENSITY / (PI * RADIUS * RADIUS)
}

fn spot_flux() -> f32 {
    (1.0 - 0.300_05_f32.cos()) / 2.0
}

#[test]
fn direct_light_is_exact() {
    let reference = reference(&sphere(centred()), "direct", Visibility::Traced, 32);
    assert_uniform(&reference, bounce(0, 1.0));
    assert_eq!(reference.noise_floor, 0.0);
}

#[test]
fn one_bounce() {
    for visibility in [Visibility::Traced, Visibility::Ignored] {
        for light in [centred(), off_centre()] {
            let reference = reference(&sphere(light), "indirect-1", visibility, 128);
            assert_uniform(&reference, bounce(1, 1.0));
        }
        let reference = reference(&sphere(spot()), "indirect-1", visibility, 256);
        assert_uniform(&reference, bounce(1, spot_flux()));
    }
}

#[test]
fn three_bounces_add_up() {
    let reference = reference(&sphere(off_centre()), "indirect-3", Visibility::Traced, 128);
    assert_uniform(&reference, (1..=3).map(|k| bounce(k, 1.0)).sum());
}

#[test]
fn all_bounces_make_the_geometric_series() {
    let reference = reference(&sphere(centred()), "all", Visibility::Traced, 512);
    assert_uniform(&reference, bounce(0, 1.0) / (1.0 - ALBEDO));
}
