//! The adapter's gather against the f64 oracle, and the limits that the estimator must have.

use std::sync::LazyLock;

use glam::{DVec3, Quat, Vec3};
use manylights_gpu::{Gpu, RadiusRule, SurfaceRecord, VirtualLight};
use manylights_hvl::{Horizon, Settings, SphericalLight, gather, oracle, rounded};
use manylights_scene::Brdf;

static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

const PLAIN: Settings = Settings {
    lights: 1,
    bands: 5,
    radius: RadiusRule::Fixed,
    scale: 1.0,
    horizon: Horizon::Smooth,
};

fn glossy(roughness: f32) -> Brdf {
    Brdf {
        diffuse: Vec3::new(0.5, 0.3, 0.2),
        f0: Vec3::new(0.06, 0.04, 0.05),
        f90: 1.0,
        alpha: roughness * roughness,
    }
}

fn surface(position: Vec3, normal: Vec3, brdf: Brdf) -> SurfaceRecord {
    let Brdf { diffuse, f0, f90, alpha } = brdf;
    SurfaceRecord { position, alpha, normal, f90, diffuse, triangle: 0, f0, material: 0 }
}

fn sphere(position: Vec3, normal: Vec3, radius: f32, brdf: Brdf) -> SphericalLight {
    let incoming = (normal + 0.5 * normal.any_orthonormal_vector()).normalize();
    let flux = Vec3::ONE;
    let light = VirtualLight { position, geometric_normal: normal, normal, incoming, flux, brdf };
    rounded(&SphericalLight { light, radius })
}

/// An oblique frame, so that no coordinate is exact.
fn oblique(v: Vec3) -> Vec3 {
    Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7) * v
}

/// A direction of a spiral over the sphere.
fn spiral(i: u32, count: u32) -> Vec3 {
    let z = (i as f32 + 0.5) / count as f32 * 2.0 - 1.0;
    let (sin, cos) = (i as f32 * 2.399_963).sin_cos();
    let r = (1.0 - z * z).sqrt();
    Vec3::new(r * cos, r * sin, z)
}

/// Receivers around the origin, where a light shines up.
fn receivers(size: f32, brdf: Brdf) -> Vec<SurfaceRecord> {
    (0..512)
        .map(|i| {
            let place = spiral(i, 512) * (0.2 + 0.01 * i as f32);
            surface(oblique(place) * size, oblique(spiral((i * 197) % 512, 512)), brdf)
        })
        .collect()
}

fn truth(surface: &SurfaceRecord, camera: Vec3, light: &SphericalLight, settings: &Settings) -> DVec3 {
    oracle::radiance(surface, camera.as_dvec3(), &[*light], settings)
}

/// Largest difference to the oracle over all receivers, relative to the largest true radiance.
fn worst(
    surfaces: &[SurfaceRecord],
    camera: Vec3,
    light: &SphericalLight,
    settings: &Settings,
) -> f64 {
    let pixels = gather(&GPU, surfaces, camera, &[*light], settings).expect("a gather");
    let (mut peak, mut worst): (f64, f64) = (0.0, 0.0);
    for (surface, pixel) in surfaces.iter().zip(pixels) {
        let truth = truth(surface, camera, light, settings);
        let pixel = Vec3::from(pixel);
        assert!(pixel.is_finite(), "{surface:?} {light:?}: {pixel}");
        peak = peak.max(truth.abs().max_element());
        worst = worst.max((pixel.as_dvec3() - truth).abs().max_element());
    }
    assert!(peak > 0.0, "nothing arrives");
    worst / peak
}

#[test]
fn the_adapter_agrees_with_the_oracle() {
    let up = oblique(Vec3::Y);
    for (name, receiver, emitter, bands) in [
        ("Lambert", Brdf::lambert(Vec3::splat(0.5)), Brdf::lambert(Vec3::splat(0.7)), 5),
        ("glossy receiver", glossy(0.4), Brdf::lambert(Vec3::splat(0.7)), 5),
        ("glossy both", glossy(0.2), glossy(0.5), 8),
    ] {
        for horizon in [Horizon::Smooth, Horizon::Exact] {
            let settings = Settings { bands, horizon, ..PLAIN };
            let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
            let surfaces: Vec<_> = receivers(1.0, receiver)
                .into_iter()
                .filter(|s| s.normal.dot(camera - s.position) > 0.0)
                .collect();
            let worst = worst(&surfaces, camera, &sphere(Vec3::ZERO, up, 0.4, emitter), &settings);
            println!("{name}, {horizon:?}: {worst:.1e}");
            // Measured: 5e-7, a few roundings of f32.
            assert!(worst < 2e-6, "{name}, {horizon:?}: {worst:e}");
        }
    }
}

#[test]
fn hard_cases_are_finite() {
    let up = oblique(Vec3::Y);
    for size in [1e-3_f32, 1.0, 1e4] {
        let camera = size * oblique(Vec3::new(0.4, 1.0, 0.2));
        for receiver in [Brdf::lambert(Vec3::splat(0.5)), glossy(0.03), glossy(1.0)] {
            // Grazing view, both sides, at and inside of the light.
            let surfaces: Vec<_> = (0..=48)
                .map(|step| size * 10_f32.powf(-0.25 * step as f32))
                .flat_map(|d| [Vec3::Y, Vec3::X, -Vec3::Y, Vec3::new(0.3, 1.0, 0.1)].map(|v| v * d))
                .chain([Vec3::ZERO])
                .flat_map(|place| {
                    let to_camera = (camera - oblique(place)).normalize();
                    let across = to_camera.any_orthonormal_vector();
                    [up, -up, across, (across + 1e-6 * to_camera).normalize()]
                        .map(|normal| surface(oblique(place), normal, receiver))
                })
                .filter(|s| s.normal.dot((camera - s.position).normalize()) >= 0.0)
                .collect();
            for radius in [0.0, 0.1 * size] {
                for horizon in [Horizon::Smooth, Horizon::Exact] {
                    let settings = Settings { horizon, ..PLAIN };
                    let light = sphere(Vec3::ZERO, up, radius, glossy(0.1));
                    let pixels = gather(&GPU, &surfaces, camera, &[light], &settings);
                    for (s, pixel) in surfaces.iter().zip(pixels.expect("a gather")) {
                        assert!(Vec3::from(pixel).is_finite(), "{s:?}, radius {radius}: {pixel:?}");
                    }
                }
            }
        }
    }
}

/// A light well above the horizon, seen from a surface of this reflectance.
fn clear_view(brdf: Brdf, radius: f32) -> (SurfaceRecord, Vec3, SphericalLight) {
    let light = sphere(Vec3::new(0.4, 1.0, 0.1), -Vec3::Y, radius, Brdf::lambert(Vec3::ONE));
    (surface(Vec3::ZERO, Vec3::Y, brdf), Vec3::new(-0.9, 1.0, 0.2), light)
}

#[test]
fn more_bands_approach_the_integral() {
    // Measured: up to 3.6e-3, 2.7e-3, 1.9e-4.
    let bounds = [5e-3, 4e-3, 3e-4];
    for (name, brdf) in [
        ("Lambert", Brdf::lambert(Vec3::splat(0.5))),
        ("GGX 1.0", glossy(1.0)),
        ("GGX 0.6", glossy(0.6)),
    ] {
        let (surface, camera, light) = clear_view(brdf, 0.3);
        let whole = oracle::by_quadrature(&surface, camera.as_dvec3(), &light, Horizon::Exact, 64);
        let errors = [5, 10, 20].map(|bands| {
            let settings = Settings { bands, horizon: Horizon::Exact, ..PLAIN };
            let value = truth(&surface, camera, &light, &settings);
            ((value - whole) / whole).abs().max_element()
        });
        println!("{name}: relative error at 5, 10, 20 bands {errors:?}");
        for (error, bound) in errors.iter().zip(bounds) {
            assert!(*error < bound, "{name}: {errors:?}");
        }
    }
}

#[test]
fn a_vanishing_radius_is_a_point_light() {
    // Φ f_j ⟨n_j·−ω⟩ f cos/d², the reflectance in 20 bands.
    let brdf = glossy(1.0);
    let (surface, camera, light) = clear_view(brdf, 0.0);
    let w = light.light.position.normalize();
    let reflected = brdf.eval(surface.normal, camera.normalize(), w) * w.y;
    let distance2 = light.light.position.length_squared();
    let point = reflected * (w.y * std::f32::consts::FRAC_1_PI / distance2);
    let settings = Settings { bands: 20, ..PLAIN };
    let value = truth(&surface, camera, &light, &settings);
    let error = ((value - point.as_dvec3()) / point.as_dvec3()).abs().max_element();
    println!("radius 0, 20 bands: {error:.1e}");
    // What 20 bands leave of the kink of the cosine at the horizon; measured: 9.3e-4.
    assert!(error < 1.5e-3, "{value} is not {point}");
    let small = sphere(light.light.position, -Vec3::Y, 1e-4, Brdf::lambert(Vec3::ONE));
    let near = truth(&surface, camera, &small, &settings);
    assert!(((near - value) / value).abs().max_element() < 1e-6, "{near} is not {value}");
}
