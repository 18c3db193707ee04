//! The tables of lobes, against quadrature.

use glam::{DVec3, Vec3};
use manylights_harmonics::quadrature::sphere;
use manylights_harmonics::window::Window;
use manylights_harmonics::zonal::evaluate;
use manylights_harmonics::{Basis, count, even_count, index};
use manylights_hvl::emission::{EmissionTable, reflectance, terms};
use manylights_hvl::lobes::{ANGLES, LobeTable};
use manylights_hvl::zonal::ZonalTable;
use manylights_hvl::{Damping, diffuse};
use manylights_scene::{Brdf, DBrdf, Lobe};

const BANDS: usize = 6;

/// Against a quadrature over directions, of the reflectance as the scene has it.
#[test]
fn lobes_are_projections_of_the_reflectance() {
    let basis = Basis::<f64>::new(BANDS);
    for (alpha, bound) in [(0.25_f32, 5e-5), (1.0, 2e-5)] {
        let table = LobeTable::of(alpha, BANDS, Damping::None);
        let brdf = Brdf {
            alpha,
            f0: Vec3::splat(0.3),
            lobe: Lobe::Schlick { f90: 0.8 },
            ..Brdf::lambert(Vec3::ZERO)
        };
        let brdf = DBrdf::from(brdf);
        for degrees in [0_usize, 40, 80] {
            let view = (degrees as f64).to_radians();
            let view = DVec3::new(view.sin(), 0.0, view.cos());
            let row = &table.values()[degrees * even_count(BANDS)..];
            for (l, m) in [(0, 0), (1, 0), (1, 1), (3, 2), (5, 5)] {
                let mut values = vec![0.0; count(BANDS)];
                let expected = sphere(200, [0.0, 1.0], |w| {
                    basis.evaluate(w, &mut values);
                    let w = DVec3::from(w);
                    brdf.specular(DVec3::Z, view, w).x * w.z * values[index(l, m)]
                });
                let [a, b] = row[manylights_harmonics::even_index(l, m as usize)];
                let value = 0.3 * a + 0.8 * b;
                let error = (value - expected).abs();
                println!("α {alpha} {degrees}° ({l}, {m}): {value:.6}, off by {error:.1e}");
                assert!(error < bound, "{value} {expected}");
            }
        }
    }
}

#[test]
fn the_quadrature_has_converged() {
    for alpha in [9e-4_f64, 0.04, 1.0] {
        let fine = LobeTable::integrate(alpha, BANDS, [128, 192]);
        let coarse = LobeTable::integrate(alpha, BANDS, [64, 96]);
        let worst = |rows: std::ops::Range<usize>| {
            let range = rows.start * even_count(BANDS)..rows.end * even_count(BANDS);
            let pairs = fine.values()[range.clone()].iter().zip(&coarse.values()[range]);
            pairs.map(|(f, c)| (f[0] - c[0]).abs().max((f[1] - c[1]).abs())).fold(0.0, f64::max)
        };
        let (below, last) = (worst(0..ANGLES - 1), worst(ANGLES - 1..ANGLES));
        println!("α {alpha}: {below:.1e}, at 90° {last:.1e}");
        // Coefficients reach 1. At 90° the lobe ends at the horizon in a step.
        assert!(below < 1e-4 && last < 1e-3, "α {alpha}: {below:e}, {last:e}");
        assert_eq!(fine.values().len(), ANGLES * even_count(BANDS));
    }
}

/// (2l + 1)/4π: the tables of zonal functions bring it.
fn addition(l: usize) -> f64 {
    (2 * l + 1) as f64 / (4.0 * std::f64::consts::PI)
}

/// P_l.
fn legendre(l: usize, x: f64) -> f64 {
    let mut unit = vec![0.0; l + 1];
    unit[l] = 1.0 / addition(l);
    evaluate(&unit, x)
}

#[test]
fn the_diffuse_lobe_is_the_projection_of_its_formula() {
    for (l, [k, g]) in diffuse::lobes(9, Damping::None).into_iter().enumerate() {
        for (value, lobe) in [(k, (|c| c) as fn(f64) -> f64), (g, |c| c * (1.0 - c).powi(5))] {
            let expected = sphere(40, [0.0, 1.0], |[.., z]| lobe(z) * legendre(l, z)) * addition(l);
            assert!((value - expected).abs() < 1e-12, "l = {l}: {value} {expected}");
        }
    }
}

#[test]
fn a_window_weighs_whole_bands() {
    let bands = 5;
    let plain = LobeTable::of(0.1, bands, Damping::None);
    let hann = LobeTable::of(0.1, bands, Damping::Window(Window::Hann));
    for (i, (damped, value)) in hann.values().iter().zip(plain.values()).enumerate() {
        let l = (0..bands).rfind(|&l| even_count(l) <= i % even_count(bands)).expect("a band");
        let weight: f64 = Window::Hann.weight(l, bands as f64);
        assert!((damped[0] - weight * value[0]).abs() < 1e-15, "{i}");
    }
}

/// What the weakest window leaves is nowhere negative, but for the tolerance of 1 % of the mean.
#[test]
fn the_weakest_window_stops_the_ringing() {
    let basis = Basis::<f64>::new(BANDS);
    let lowest = |damping| {
        let table = LobeTable::of(0.09, BANDS, damping);
        let row = &table.values()[50 * even_count(BANDS)..][..even_count(BANDS)];
        let mean = (row[0][0] + row[0][1]) / (4.0 * std::f64::consts::PI).sqrt();
        let mut values = vec![0.0; count(BANDS)];
        let directions = manylights_harmonics::quadrature::sphere_nodes(60, [-1.0, 1.0]);
        let lobe = directions.into_iter().map(|(w, _)| {
            basis.evaluate(w, &mut values);
            let orders = (0..BANDS).flat_map(|l| (0..=l).map(move |m| (l, m)));
            let sum = |(l, m)| {
                let [a, b]: [f64; 2] = row[manylights_harmonics::even_index(l, m)];
                (a + b) * values[index(l, m as isize)]
            };
            orders.map(sum).sum::<f64>()
        });
        // The mean of coefficient 0 is itself over √4π.
        lobe.fold(f64::MAX, f64::min) * (4.0 * std::f64::consts::PI).sqrt() / mean
    };
    let [plain, damped] = [Damping::None, Damping::Weakest].map(lowest);
    println!("lowest relative to the mean: {plain}, {damped}");
    assert!(plain < -1.0 && damped > -0.04, "{plain} {damped}");
}

/// The circular lobe keeps the lobe's integral and its share of the square never exceeds one; about its
/// axis it is the projection of the table.
#[test]
fn circular_lobes_are_projections_about_their_axis() {
    let bands = 9;
    for alpha in [0.04_f32, 0.25, 1.0] {
        let lobes = LobeTable::of(alpha, bands, Damping::None);
        let zonal = ZonalTable::of(alpha, bands, Damping::None);
        for degrees in [0_usize, 30, 60, 85] {
            let ([x, z], scales) = zonal.at((degrees as f64).to_radians());
            let row = &lobes.values()[degrees * even_count(bands)..];
            // Band 0 alone has no direction: Y_00 times the coefficient is (1/4π) times the scale.
            let mean = row[0][0] / (4.0 * std::f64::consts::PI).sqrt();
            assert!((scales[0][0] - mean).abs() < 1e-12, "{} {mean}", scales[0][0]);
            let captured = zonal.captured(&lobes, degrees);
            println!("α {alpha} {degrees}°: axis {:.1}°, {captured:.4}", x.atan2(z).to_degrees());
            assert!((0.5..1.0 + 1e-9).contains(&captured), "α {alpha}, {degrees}°: {captured}");
            if degrees == 0 {
                // Seen along the normal the lobe is circular.
                assert!(captured > 1.0 - 1e-6 && x.abs() < 1e-3, "{captured} {x}");
            }
        }
    }
}

/// The expansion of a light's emission against a quadrature of the scene's reflectance, mirrored.
#[test]
fn emissions_are_projections_of_the_reflectance() {
    let bands = 5;
    let basis = Basis::<f64>::new(bands);
    let brdf = DBrdf::from(Brdf {
        alpha: 0.25,
        f0: Vec3::splat(0.3),
        lobe: Lobe::Schlick { f90: 0.8 },
        ..Brdf::lambert(Vec3::ZERO)
    });
    let table = EmissionTable::of(0.25, bands);
    for degrees in [0_usize, 40, 80] {
        let view = (degrees as f64).to_radians();
        let view = DVec3::new(view.sin(), 0.0, view.cos());
        let row = &table.values()[degrees * terms(bands).count()..];
        let mut values = vec![0.0; count(bands)];
        for (&[a, b], (l, m)) in row.iter().zip(terms(bands)) {
            let expected = sphere(200, [0.0, 1.0], |w| {
                basis.evaluate(w, &mut values);
                2.0 * brdf.specular(DVec3::Z, view, DVec3::from(w)).x * values[index(l, m as isize)]
            });
            let error = (0.3 * a + 0.8 * b - expected).abs();
            println!("{degrees}° ({l}, {m}): {expected:.4}, off by {error:.1e}");
            assert!(error < 1e-3, "{degrees}° ({l}, {m}): {error:e}");
        }
    }
}

/// A Lambertian light is one constant at any number of bands; a rough glossy one is approached.
#[test]
fn more_bands_of_emission_approach_the_reflectance() {
    let brdf = Brdf {
        diffuse: Vec3::splat(0.5),
        f0: Vec3::splat(0.04),
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: 0.36,
    };
    let light = manylights_gpu::VirtualLight {
        position: Vec3::ZERO,
        geometric_normal: Vec3::Z,
        normal: Vec3::Z,
        // A whole degree, as the table has it.
        incoming: Vec3::new(30_f32.to_radians().sin(), 0.0, 30_f32.to_radians().cos()),
        flux: Vec3::ONE,
        brdf,
    };
    let error = |bands| {
        let whole = |w: DVec3| reflectance(&light, w, 0).x;
        let part = |w: DVec3| reflectance(&light, w, bands).x;
        // Weighed as it is emitted, with the cosine.
        let square =
            |of: &dyn Fn(DVec3) -> f64| sphere(80, [0.0, 1.0], |w| of(w.into()).powi(2) * w[2]);
        (square(&|w| part(w) - whole(w)) / square(&whole)).sqrt()
    };
    let errors = [1, 3, 5, 9].map(error);
    println!("relative error of 1, 3, 5, 9 bands: {errors:?}");
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0]) && errors[3] < 0.05, "{errors:?}");
    let lambert = manylights_gpu::VirtualLight { brdf: Brdf::lambert(Vec3::splat(0.5)), ..light };
    let w = DVec3::new(0.1, 0.2, 0.9).normalize();
    assert_eq!(reflectance(&lambert, w, 1), reflectance(&lambert, w, 0));
}
