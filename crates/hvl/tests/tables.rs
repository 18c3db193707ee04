//! The tables of lobes, against quadrature.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use manylights_harmonics::quadrature::sphere;
use manylights_harmonics::window::Window;
use manylights_harmonics::zonal::evaluate;
use manylights_harmonics::{Basis, count, even_count, index};
use manylights_hvl::emission::{EmissionTable, reflectance, terms};
use manylights_reflectance::lobes::{ANGLES, LobeTable, NODES};
use manylights_reflectance::zonal::ZonalTable;
use manylights_reflectance::{Damping, diffuse};
use manylights_scene::{Brdf, DBrdf, Lobe};
use manylights_virtual_lights::VirtualLight;
use rayon::prelude::*;

const BANDS: usize = 6;

/// (2l + 1)/4π times the scale of band l about an axis: of A and of B.
fn about(axis: DVec3, row: &[[f64; 2]], l: usize) -> [f64; 2] {
    let basis = Basis::<f64>::new(l + 1);
    let mut values = vec![0.0; count(l + 1)];
    [0, 1].map(|k| {
        let product = |w: [f64; 3]| {
            basis.evaluate(w, &mut values);
            let term = |m: usize| {
                row[manylights_harmonics::even_index(l, m)][k] * values[index(l, m as isize)]
            };
            (0..=l).map(term).sum::<f64>() * legendre(l, axis.dot(w.into()))
        };
        addition(l) * sphere(l + 4, [-1.0, 1.0], product)
    })
}

/// Under Schlick's and under the exact Fresnel term.
fn lobes(alpha: f32) -> [Brdf; 2] {
    let kinds = [Lobe::Schlick { f90: 0.8 }, Lobe::Dielectric { index: 1.5 }];
    kinds.map(|lobe| Brdf { alpha, f0: Vec3::splat(0.3), lobe, ..Brdf::lambert(Vec3::ZERO) })
}

/// Against a quadrature over directions, of the reflectance as the scene has it.
#[test]
fn lobes_are_projections_of_the_reflectance() {
    let basis = Basis::<f64>::new(BANDS);
    for (alpha, bound) in [(0.25_f32, 5e-5), (1.0, 2e-5)] {
        for brdf in lobes(alpha) {
            let table = LobeTable::of(brdf, BANDS, Damping::None);
            let (f90, brdf) = (f64::from(brdf.lobe.f90()), DBrdf::from(brdf));
            for degrees in [0_usize, 40, 80] {
                let view = direction(degrees);
                let row = &table.values()[degrees * even_count(BANDS)..];
                for (l, m) in [(0, 0), (1, 0), (1, 1), (3, 2), (5, 5)] {
                    let mut values = vec![0.0; count(BANDS)];
                    let expected = sphere(200, [0.0, 1.0], |w| {
                        basis.evaluate(w, &mut values);
                        let w = DVec3::from(w);
                        brdf.specular(DVec3::Z, view, w).x * w.z * values[index(l, m)]
                    });
                    let [a, b] = row[manylights_harmonics::even_index(l, m as usize)];
                    let value = brdf.f0.x * a + f90 * b;
                    let error = (value - expected).abs();
                    println!("{brdf:?} {degrees}° ({l}, {m}): {value:.6}, off by {error:.1e}");
                    assert!(error < bound, "{value} {expected}");
                }
            }
        }
    }
}

fn direction(degrees: usize) -> DVec3 {
    let (sin, cos) = (degrees as f64).to_radians().sin_cos();
    DVec3::new(sin, 0.0, cos)
}

#[test]
fn the_quadrature_has_converged() {
    let bands = 20;
    for alpha in [9e-4_f32, 0.01, 0.04, 0.25] {
        let table = |nodes| LobeTable::integrate(alpha, bands, nodes).swap_remove(0);
        let (fine, coarse) = (table(NODES.map(|nodes| 2 * nodes)), table(NODES));
        let worst = |rows: std::ops::Range<usize>| {
            let range = rows.start * even_count(bands)..rows.end * even_count(bands);
            let pairs = fine.values()[range.clone()].iter().zip(&coarse.values()[range]);
            pairs.map(|(f, c)| (f[0] - c[0]).abs().max((f[1] - c[1]).abs())).fold(0.0, f64::max)
        };
        let found = [worst(0..ANGLES - 2), worst(89..90), worst(90..91)];
        println!(
            "α {alpha}: below 89° {:.1e}, at 89° {:.1e}, at 90° {:.1e}",
            found[0], found[1], found[2]
        );
        // Coefficients reach 1. Where the horizon cuts a narrow lobe changes between two sectors: most for
        // α = 0.01, 2.5e-4, 5.4e-4 and 2.0e-3.
        let bounds = [3e-4, 6e-4, 2.5e-3];
        let holds = found.iter().zip(bounds).all(|(found, bound)| *found < bound);
        assert!(holds, "α {alpha}: {found:?}");
        assert_eq!(fine.values().len(), ANGLES * even_count(bands));
    }
}

/// A table is made on rayon's threads, and may be asked for from them.
#[test]
fn a_table_may_be_asked_for_while_it_is_made() {
    let width = |i: u32| 0.31 + 0.01 * (i % 2) as f32;
    let tables: Vec<_> =
        (0..8).into_par_iter().map(|i| LobeTable::of(width(i), 3, Damping::Weakest)).collect();
    for (i, table) in tables.iter().enumerate() {
        assert!(Arc::ptr_eq(table, &tables[i % 2]), "{i}");
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

/// What the weakest window leaves, without the Fresnel term and of a dielectric, is nowhere negative,
/// but for the tolerance of 1 % of the mean.
#[test]
fn the_weakest_window_stops_the_ringing() {
    let basis = Basis::<f64>::new(BANDS);
    let directions = manylights_harmonics::quadrature::sphere_nodes(60, [-1.0, 1.0]);
    let lowest = |alpha, degrees: usize, f0, damping| {
        let table = LobeTable::of(alpha, BANDS, damping);
        let row = &table.values()[degrees * even_count(BANDS)..][..even_count(BANDS)];
        let row: Vec<_> = row.iter().map(|[a, b]| f0 * a + b).collect();
        let mut values = vec![0.0; count(BANDS)];
        let lobe = directions.iter().map(|&(w, _)| {
            basis.evaluate(w, &mut values);
            let orders = (0..BANDS).flat_map(|l| (0..=l).map(move |m| (l, m)));
            let term = |(l, m)| {
                let value: f64 = row[manylights_harmonics::even_index(l, m)];
                value * values[index(l, m as isize)]
            };
            orders.map(term).sum::<f64>()
        });
        // The mean of coefficient 0 is itself over √4π.
        lobe.fold(f64::MAX, f64::min) * (4.0 * std::f64::consts::PI).sqrt() / row[0]
    };
    for alpha in [0.09, 0.25] {
        for degrees in [0, 50, 85] {
            for f0 in [1.0, 0.04] {
                let [plain, damped] =
                    [Damping::None, Damping::Weakest].map(|d| lowest(alpha, degrees, f0, d));
                println!("α {alpha} {degrees}° f0 {f0}, lowest over mean: {plain}, {damped}");
                assert!(plain < -0.1 && damped > -0.0101, "{plain} {damped}");
            }
        }
    }
}

/// The circular lobe is the projection of the table about its axis, by quadrature, and no axis a degree
/// away holds more of the lobe.
#[test]
fn circular_lobes_are_projections_about_their_axis() {
    let bands = 9;
    for alpha in [0.04_f32, 0.25, 1.0] {
        let lobes = LobeTable::of(alpha, bands, Damping::None);
        let zonal = ZonalTable::of(alpha, bands, Damping::None);
        for degrees in [0_usize, 30, 60, 85] {
            let ([x, z], scales) = zonal.at((degrees as f64).to_radians());
            let row = &lobes.values()[degrees * even_count(bands)..];
            let held = |angle: f64| {
                let axis = DVec3::new(angle.sin(), 0.0, angle.cos());
                let scales: Vec<_> = (0..bands).map(|l| about(axis, row, l)).collect();
                let squares = scales.iter().enumerate();
                let held: f64 = squares.map(|(l, [a, b])| (a + b).powi(2) / addition(l)).sum();
                (scales, held)
            };
            let (angle, step) = (x.atan2(z), 1_f64.to_radians());
            let (expected, most) = held(angle);
            for (found, expected) in scales.as_flattened().iter().zip(expected.as_flattened()) {
                assert!((found - expected).abs() < 1e-9, "{found} {expected}");
            }
            for other in [angle - step, angle + step] {
                assert!(held(other).1 <= most, "α {alpha} {degrees}°");
            }
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

/// The expansion of a light's emission against a quadrature of the scene's reflectance, mirrored, times
/// what gives band 0 … 4 the flux of the lobe without its Fresnel term, or of a dielectric's.
#[test]
fn emissions_are_projections_of_the_reflectance() {
    let bands = 5;
    let basis = Basis::<f64>::new(bands);
    for brdf in lobes(0.25) {
        let table = EmissionTable::of(brdf, bands);
        let f90 = f64::from(brdf.lobe.f90());
        let white = match brdf.lobe {
            Lobe::Schlick { .. } => Lobe::Schlick { f90: 1.0 },
            other => other,
        };
        let [white, brdf] = [Brdf { f0: Vec3::ONE, lobe: white, ..brdf }, brdf].map(DBrdf::from);
        for degrees in [0_usize, 40, 80] {
            let view = direction(degrees);
            let row = &table.values()[degrees * terms(bands).count()..];
            let projected = |brdf: &DBrdf, (l, m): (usize, usize)| {
                let mut values = vec![0.0; count(bands)];
                sphere(200, [0.0, 1.0], |w| {
                    basis.evaluate(w, &mut values);
                    let value = values[index(l, m as isize)];
                    2.0 * brdf.specular(DVec3::Z, view, DVec3::from(w)).x * value
                })
            };
            let flux =
                sphere(200, [0.0, 1.0], |w| white.specular(DVec3::Z, view, w.into()).x * w[2]);
            let zonal = |l: usize| {
                let mut values = vec![0.0; count(bands)];
                projected(&white, (l, 0))
                    * sphere(40, [0.0, 1.0], |w| {
                        basis.evaluate(w, &mut values);
                        w[2] * values[index(l, 0)]
                    })
            };
            let scale = flux / (0..bands).step_by(2).map(zonal).sum::<f64>();
            for (&[a, b], term) in row.iter().zip(terms(bands)) {
                let expected = scale * projected(&brdf, term);
                let error = (brdf.f0.x * a + f90 * b - expected).abs();
                println!("{degrees}° {term:?}: {expected:.4}, off by {error:.1e}");
                // 1.7e-6 measured: the quadrature's step at the horizon.
                assert!(error < 5e-6, "{degrees}° {term:?}: {error:e}");
            }
        }
    }
}

/// However few the bands, a white light emits its albedo.
#[test]
fn the_expanded_emission_keeps_the_flux() {
    for alpha in [0.01_f32, 0.09, 1.0] {
        let lobes = LobeTable::of(alpha, 1, Damping::None);
        let lobe = Lobe::Schlick { f90: 1.0 };
        let brdf = Brdf { f0: Vec3::ONE, lobe, alpha, ..Brdf::lambert(Vec3::ZERO) };
        for degrees in [0, 20, 40, 60, 80, 85, 89] {
            let [a, b] = lobes.values()[degrees];
            let albedo = (a + b) * (4.0 * std::f64::consts::PI).sqrt();
            let light = light(degrees as f32, brdf);
            for bands in [1, 3, 5, 9] {
                let emitted = |w: [f64; 3]| w[2] * reflectance(&light, w.into(), bands).x;
                let flux = sphere(bands + 4, [0.0, 1.0], emitted);
                // Both tables have the same nodes.
                let error = (flux / albedo - 1.0).abs();
                println!("α {alpha} {degrees}° {bands}: flux off by {error:.1e}");
                assert!(error < 1e-12, "α {alpha} {degrees}° {bands}: {flux} {albedo}");
            }
        }
    }
}

/// A light at the origin that is lit from this angle.
fn light(degrees: f32, brdf: Brdf) -> VirtualLight {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (position, flux, normal) = (Vec3::ZERO, Vec3::ONE, Vec3::Z);
    let incoming = Vec3::new(sin, 0.0, cos);
    VirtualLight { position, geometric_normal: normal, normal, incoming, flux, brdf }
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
    // A whole degree, as the table has it.
    let light = light(30.0, brdf);
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
    let lambert = VirtualLight { brdf: Brdf::lambert(Vec3::splat(0.5)), ..light };
    let w = DVec3::new(0.1, 0.2, 0.9).normalize();
    assert_eq!(reflectance(&lambert, w, 1), reflectance(&lambert, w, 0));
}
