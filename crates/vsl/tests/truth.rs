//! The estimator against f64 quadrature over the cone, and against point lights where it shrinks.

use std::f64::consts::PI;

use crate::common::{GPU, SETTINGS, glossy, light, render};
use glam::{DVec2, DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_scene::Brdf;
use manylights_vsl::oracle::Receiver;
use manylights_vsl::{Sampling, Settings, VirtualSphere, gather, oracle};

const CAMERA: Vec3 = Vec3::new(0.6, 1.0, -0.2);
const SAMPLINGS: [Sampling; 3] = [Sampling::Brdf, Sampling::Cone, Sampling::Both];

/// Φ/(πr²) times the integral over the cone, by the midpoint rule on `side`² cells.
fn quadrature(surface: &SurfaceRecord, sphere: &VirtualSphere, side: u32) -> DVec3 {
    let receiver = Receiver::new(surface, CAMERA.as_dvec3());
    let Some(cone) = receiver.cone(sphere) else { return DVec3::ZERO };
    let middle = |index: u32| (f64::from(index) + 0.5) / f64::from(side);
    let mut sum = DVec3::ZERO;
    for ring in 0..side {
        for sector in 0..side {
            let around = DVec2::from_angle(middle(sector) * std::f64::consts::TAU);
            sum += receiver.integrand(&sphere.light, cone.direction(middle(ring), around));
        }
    }
    sum * (cone.falloff / f64::from(side * side))
}

/// Pairs of a surface and a light that faces it: outside the sphere, near its edge, inside it.
fn pairs() -> Vec<(String, SurfaceRecord, VirtualSphere)> {
    let materials = [("Lambert", Brdf::lambert(Vec3::splat(0.5))), ("GGX 0.6", glossy(0.6))];
    let places = [
        ("far", Vec3::new(-0.9, 1.2, 0.3), 0.5),
        ("edge", Vec3::new(-0.3, 0.4, 0.1), 0.5),
        ("inside", Vec3::new(-0.1, 0.3, 0.05), 0.6),
        ("across the horizon", Vec3::new(-0.9, 0.1, 0.3), 0.5),
    ];
    let mut pairs = Vec::new();
    for (of, brdf) in materials {
        for (by, emitter) in materials {
            for (place, position, radius) in places {
                let toward = (Vec3::new(0.2, 0.0, 0.1) - position).normalize();
                let name = format!("{of} by {by}, {place}");
                let sphere = light(position, toward, emitter, radius);
                pairs.push((name, SurfaceRecord::new(Vec3::ZERO, Vec3::Y, brdf), sphere));
            }
        }
    }
    pairs
}

/// Many samples on the adapter: 16 pixels with 16 384 samples each.
#[test]
fn many_samples_approach_the_quadrature() {
    for (name, surface, sphere) in pairs() {
        let truth = quadrature(&surface, &sphere, 512).x;
        for sampling in SAMPLINGS {
            let settings = Settings { directions: 16_384, sampling, ..SETTINGS };
            let pixels =
                gather(&GPU, &[surface; 16], CAMERA, &[sphere], &settings, 0).expect("a gather");
            let mean = pixels.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / 16.0;
            println!("{name} {sampling:?}: {:+.1e}", mean / truth - 1.0);
            // 16 lattices of 16 384 samples. Over the cone the integrand is smooth. For samples of the
            // lobes the rim is a jump, and few of them meet the cone across the horizon: independent
            // ones would be off by 7e-3 there (one standard deviation, from the next test's).
            let bound = match sampling {
                Sampling::Cone => 5e-5,
                Sampling::Both => 5e-4,
                Sampling::Brdf => 3e-3,
            };
            assert!((mean / truth - 1.0).abs() < bound, "{name} {sampling:?}: {mean}, {truth}");
        }
    }
}

/// Lambertian surfaces, the whole cone above both horizons: with C = cos a, m = −n_j and c the cone's
/// axis, ∫ (n_x·ω)(m·ω) dω = A n_x·m + B (n_x·c)(m·c), A = π(2 − 3C + C³)/3, B = 2π(1 − C³)/3 − A. Needs
/// nothing of the oracle.
#[test]
fn lambert_has_a_closed_form() {
    let brdf = Brdf::lambert(Vec3::splat(0.5));
    let settings = Settings { directions: 4096, sampling: Sampling::Cone, ..SETTINGS };
    for radius in [1e-3, 0.2, 0.6] {
        let place = Vec3::new(-0.4, 1.2, 0.3);
        let sphere = light(place, Vec3::new(0.1, -1.0, 0.2).normalize(), brdf, radius);
        let surface = SurfaceRecord::new(Vec3::ZERO, Vec3::Y, brdf);
        let found = gather(&GPU, &[surface], CAMERA, &[sphere], &settings, 0).expect("a gather");
        let [n, m] = [Vec3::Y, -sphere.light.geometric_normal].map(|normal| normal.as_dvec3());
        let axis = place.as_dvec3().normalize();
        let r2 = f64::from(radius).powi(2);
        let cosine = (1.0 - r2 / place.as_dvec3().length_squared()).sqrt();
        let a = PI * (2.0 - 3.0 * cosine + cosine.powi(3)) / 3.0;
        let b = 2.0 * PI * (1.0 - cosine.powi(3)) / 3.0 - a;
        let integral = a * n.dot(m) + b * n.dot(axis) * m.dot(axis);
        let expected = 0.25 / PI.powi(3) / r2 * integral;
        let error = f64::from(found[0][0]) / expected - 1.0;
        assert!(error.abs() < 1e-4, "radius {radius}: {error:e}");
    }
}

/// A light whose primary light is on its normal has no tangent of its own.
#[test]
fn normal_incidence_on_a_light() {
    let receiver = SurfaceRecord::new(Vec3::ZERO, Vec3::Y, Brdf::lambert(Vec3::splat(0.5)));
    let settings = Settings { directions: 1, scale: 0.0, ..SETTINGS };
    for index in 0..64 {
        let (sin, cos) = (index as f32).sin_cos();
        let normal = Vec3::new(0.3 * sin, -1.0, 0.3 * cos).normalize();
        let mut sphere = light(Vec3::new(0.2, 1.0, 0.1), normal, glossy(0.2), 0.0);
        let off = 1e-7 * (index % 3) as f32 * sphere.light.normal.any_orthonormal_vector();
        sphere.light.incoming = (sphere.light.normal + off).normalize();
        let found = gather(&GPU, &[receiver], CAMERA, &[sphere], &settings, 0).expect("a gather");
        let eye = CAMERA.as_dvec3();
        let truth = oracle::radiance(0, &receiver, eye, &[sphere], &settings, 0).x;
        let error = f64::from(found[0][0]) / truth - 1.0;
        assert!(error.abs() < 1e-5, "{index}: {error:e}");
    }
}

/// Few samples are unbiased: the mean over many pixels is the quadrature.
#[test]
fn nine_samples_are_right_on_average() {
    for (name, surface, sphere) in pairs() {
        let truth = quadrature(&surface, &sphere, 512).x;
        for sampling in SAMPLINGS {
            let settings = Settings { sampling, ..SETTINGS };
            let pixels = gather(&GPU, &vec![surface; 1 << 16], CAMERA, &[sphere], &settings, 3)
                .expect("a gather");
            let count = pixels.len() as f64;
            let values = pixels.iter().map(|pixel| f64::from(pixel[0]));
            let mean = values.clone().sum::<f64>() / count;
            let variance = values.map(|value| (value - mean).powi(2)).sum::<f64>() / count;
            let sigma = (variance / count).sqrt();
            println!("{name} {sampling:?}: {:+.1e} of {:.1e}", mean / truth - 1.0, sigma / truth);
            // Five standard deviations of the mean, and the rounding of f32.
            assert!((mean - truth).abs() < 5.0 * sigma + 1e-6 * truth, "{name} {sampling:?}");
        }
    }
}

/// Both strategies together save what either alone is bad at: lobes that rarely meet a narrow cone,
/// cones that rarely meet a narrow lobe. (The lattice makes cone samples of smooth integrands nearly
/// exact, better than both.)
#[test]
fn the_balance_heuristic_saves_either_strategy() {
    let deviation = |brdf: Brdf, sphere: &VirtualSphere, sampling| {
        let settings = Settings { sampling, ..SETTINGS };
        let surfaces = [SurfaceRecord::new(Vec3::ZERO, Vec3::Y, brdf); 4096];
        let pixels = gather(&GPU, &surfaces, CAMERA, &[*sphere], &settings, 0).expect("a gather");
        let mean = pixels.iter().map(|pixel| pixel[0]).sum::<f32>() / 4096.0;
        let square = pixels.iter().map(|pixel| (pixel[0] / mean - 1.0).powi(2)).sum::<f32>();
        (square / 4096.0).sqrt()
    };
    // Towards the camera's mirror image.
    let (place, emitter) = (Vec3::new(-0.9, 1.5, 0.3), Brdf::lambert(Vec3::ONE));
    let narrow = light(place, Vec3::NEG_Y, emitter, 0.05);
    let [lobes, cone, both] = SAMPLINGS.map(|sampling| deviation(glossy(0.5), &narrow, sampling));
    println!("narrow cone: lobes {lobes}, cone {cone}, both {both}");
    assert!(both < 0.01 * lobes);
    let metal = Brdf { diffuse: Vec3::ZERO, f0: Vec3::splat(0.9), ..glossy(0.15) };
    let wide = light(place, Vec3::NEG_Y, emitter, 1.0);
    let [lobes, cone, both] = SAMPLINGS.map(|sampling| deviation(metal, &wide, sampling));
    println!("narrow lobe: lobes {lobes}, cone {cone}, both {both}");
    assert!(both < 0.1 * cone);
}

/// Radius → 0: the picture of point lights, and at 0 exactly that, whatever is sampled.
#[test]
fn small_spheres_are_point_lights() {
    let plain = manylights_vpl::Settings { lights: 256, clamp: None, attenuation_radius: None };
    for sampling in SAMPLINGS {
        let settings = Settings { sampling, scale: 0.0, ..SETTINGS };
        // One flat scene, one with interpolated normals.
        for scene in ["cornell-glossy", "trio"] {
            let picture = render(scene, [32, 24], &settings, 0);
            let points: Vec<_> = picture.lights.iter().map(|sphere| sphere.light).collect();
            let truth: Vec<_> = picture
                .surfaces
                .iter()
                .map(|s| manylights_vpl::oracle::radiance(s, picture.eye, &points, &plain))
                .collect();
            let peak = truth.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
            for (pixel, truth) in picture.image.pixels.iter().zip(&truth) {
                let error = (Vec3::from(*pixel).as_dvec3() - truth).abs().max_element();
                // Nine equal terms are summed: the rounding of point lights, largest where lobes are
                // narrow (α = 0.04 on the trio).
                assert!(error < 2e-5 * peak, "{scene} {sampling:?}: {pixel:?}, {truth}");
            }
        }
    }
}

/// The error of the limit falls with r² (formula of |Ω|/(πr²), symmetric cones).
#[test]
fn the_limit_is_of_second_order() {
    let plain = manylights_vpl::Settings { lights: 1, clamp: None, attenuation_radius: None };
    let surface = SurfaceRecord::new(Vec3::ZERO, Vec3::Y, glossy(0.6));
    let error = |radius| {
        let sphere = light(Vec3::new(-0.9, 1.2, 0.3), Vec3::NEG_Y, glossy(0.8), radius);
        let point =
            manylights_vpl::oracle::radiance(&surface, CAMERA.as_dvec3(), &[sphere.light], &plain);
        (quadrature(&surface, &sphere, 256).x / point.x - 1.0).abs()
    };
    let [coarse, fine] = [0.02, 0.01].map(error);
    println!("relative errors {coarse:e}, {fine:e}");
    assert!(fine < 1e-3 && (coarse / fine - 4.0).abs() < 0.1);
}

/// The oracle's estimate with many samples is the quadrature too: the truth does not lean on WGSL.
#[test]
fn the_oracle_integrates() {
    for (name, surface, sphere) in pairs() {
        let truth = quadrature(&surface, &sphere, 512).x;
        for sampling in SAMPLINGS {
            let settings = Settings { directions: 65_536, sampling, ..SETTINGS };
            let eye = CAMERA.as_dvec3();
            let value = oracle::radiance(0, &surface, eye, &[sphere], &settings, 0).x;
            // One lattice of 65 536; see `many_samples_approach_the_quadrature`.
            let bound = if sampling == Sampling::Cone { 5e-5 } else { 5e-3 };
            assert!((value / truth - 1.0).abs() < bound, "{name} {sampling:?}: {value}, {truth}");
        }
    }
}
