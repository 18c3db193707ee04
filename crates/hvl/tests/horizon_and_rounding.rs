//! The share of a cap above the horizon, and the rounding of glossy lights.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::Vec3;
use manylights_harmonics::zonal::Cap;
use manylights_hvl::horizon::above;
use manylights_hvl::{Horizon, VirtualSphere, rounded};
use manylights_scene::{Brdf, Lobe};
use manylights_virtual_lights::VirtualLight;

fn cap(a: f64) -> Cap<f64> {
    Cap { sine: a.sin(), cosine: a.cos() }
}

/// Oat and Sander 2007 as `acos` of three angles.
fn three_angles(d: f64, a: f64) -> f64 {
    if d <= FRAC_PI_2 - a {
        return 1.0;
    }
    if d >= FRAC_PI_2 + a {
        return 0.0;
    }
    let dihedral = (d.cos() / a.sin()).clamp(-1.0, 1.0).acos();
    let span = (-d.cos() * a.cos() / (d.sin() * a.sin())).clamp(-1.0, 1.0).acos();
    (PI - dihedral - span * a.cos()) / (PI * (1.0 - a.cos()))
}

#[test]
fn the_exact_share_is_that_of_intersecting_caps() {
    for a in [0.01, 0.05, 0.3, 1.0, 1.4, 1.57] {
        for i in 0..=200 {
            let d = f64::from(i) / 200.0 * PI;
            let share = above(Horizon::Exact, d.cos(), cap(a));
            // The three angles lose 1e-16/a².
            assert!((share - three_angles(d, a)).abs() < 1e-11, "a {a} d {d}: {share}");
        }
    }
}

#[test]
fn the_smooth_share_is_near_the_exact_one() {
    // Measured: 0.040 at a = 0.05 to 0.081 at 1.4; the slip in thesis 5.8 gives −7727.
    for (a, bound) in [(0.05, 0.041), (0.2, 0.041), (0.5, 0.045), (1.0, 0.059), (1.4, 0.082)] {
        let worst = (0..=400)
            .map(|i| (f64::from(i) / 400.0 * PI).cos())
            .map(|c| {
                let [smooth, exact] =
                    [Horizon::Smooth, Horizon::Exact].map(|h| above(h, c, cap(a)));
                (smooth - exact).abs()
            })
            .fold(0.0, f64::max);
        assert!(worst < bound && worst > 0.9 * bound, "a {a}: {worst}");
    }
}

/// Step of 1/index: 1/65535, of index: its square times as large.
#[test]
fn indices_of_refraction_are_rounded_once() {
    for step in 1..1500_u16 {
        let index = 1.0 + f32::from(step) * 0.01;
        let brdf = Brdf { lobe: Lobe::Dielectric { index }, ..Brdf::lambert(Vec3::ONE) };
        let (position, incoming, flux) = (Vec3::ZERO, Vec3::Z, Vec3::ONE);
        let normals = [Vec3::Z; 2];
        let [geometric_normal, normal] = normals;
        let light = VirtualLight { position, geometric_normal, normal, incoming, flux, brdf };
        let once = rounded(&VirtualSphere { light, radius: 0.1 });
        assert_eq!(rounded(&once).light.brdf, once.light.brdf);
        let Lobe::Dielectric { index: found } = once.light.brdf.lobe else {
            panic!("{index}: {:?}", once.light.brdf);
        };
        assert!((found - index).abs() < 8e-6 * index * index, "{index} {found}");
    }
}

#[test]
fn rounding_is_small_and_happens_once() {
    let brdf = Brdf {
        diffuse: Vec3::splat(0.3),
        f0: Vec3::splat(0.04),
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: 0.1,
    };
    let mut worst: f32 = 0.0;
    for i in 0..10_000 {
        let z = (i as f32 + 0.5) / 5000.0 - 1.0;
        let (sin, cos) = (i as f32 * 2.4).sin_cos();
        let r = (1.0 - z * z).sqrt();
        let unit = Vec3::new(r * cos, r * sin, z).normalize();
        let light = VirtualLight {
            position: Vec3::ZERO,
            geometric_normal: unit,
            normal: unit,
            incoming: unit,
            flux: Vec3::ONE,
            brdf,
        };
        let once = rounded(&VirtualSphere { light, radius: 0.1 }).light;
        let twice = rounded(&VirtualSphere { light: once, radius: 0.1 }).light;
        assert_eq!(once.normal, twice.normal, "{unit}");
        assert_eq!(once.brdf, twice.brdf);
        worst = worst.max((once.normal - unit).length());
        assert!((once.brdf.f0 - brdf.f0).abs().max_element() < 8e-6);
    }
    println!("worst direction {worst:.1e}");
    // Half a step of 1/32767 in x and y moves z by their sum: √6 half steps on the octahedron, which
    // the sphere stretches up to √3 times.
    assert!(worst < 6.5e-5, "{worst}");
}
