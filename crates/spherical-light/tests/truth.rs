//! What the estimator is: quadrature of its coefficients, and what it must come to with many bands.

use std::f64::consts::PI;

use crate::common::{
    SETTINGS, by_quadrature, dielectric, glossy, mirror_like, oblique, spiral, surface, view,
};
use glam::{DVec3, Vec3};
use manylights_harmonics::quadrature::{sphere, sphere_nodes};
use manylights_harmonics::{Basis, count, even_count, even_index, index};
use manylights_paths::closed_form::sphere_irradiance;
use manylights_reflectance::lobes::LobeTable;
use manylights_reflectance::{Damping, diffuse};
use manylights_scene::{Brdf, DBrdf};
use manylights_spherical_light::{Settings, SphereLight, oracle};

/// A light of radiance one and this half-angle at a distance of two.
fn light(toward: DVec3, half_angle: f64) -> SphereLight {
    SphereLight::new(2.0 * toward.as_vec3(), 2.0 * half_angle.sin() as f32, Vec3::ONE)
}

fn radiance(brdf: Brdf, view: DVec3, light: SphereLight, bands: usize) -> DVec3 {
    let surface = surface(Vec3::ZERO, Vec3::Z, brdf);
    oracle::radiance(&surface, view, &[light], &Settings { bands, ..SETTINGS })
}

/// Harmonics of the cap by quadrature over it, the Lambertian lobe by quadrature over the hemisphere, and
/// the table of the specular lobe, which `lobes_are_projections_of_the_reflectance` of hvl holds to a
/// quadrature of its own.
#[test]
fn the_oracle_is_the_product_of_its_coefficients() {
    let bands = 9;
    let basis = Basis::<f64>::new(bands);
    let mut values = vec![0.0; count(bands)];
    for (brdf, degrees) in
        [(Brdf::lambert(Vec3::splat(0.7)), 20), (glossy(0.5), 40), (dielectric(0.7), 70)]
    {
        let view = view(f64::from(degrees));
        let exact = DBrdf::from(brdf);
        let specular = exact.has_specular().then(|| LobeTable::of(brdf, bands, Damping::None));
        for toward in [spiral(3, 30, -0.5), spiral(17, 30, -0.5), spiral(28, 30, -0.5)] {
            for half_angle in [1e-3, 0.2, 1.2] {
                let light = light(toward, half_angle);
                // As the light has them in f32.
                let toward = light.center.as_dvec3();
                let cosine = (1.0 - (f64::from(light.radius) / toward.length()).powi(2)).sqrt();
                let toward = toward.normalize();
                let (a, b) = toward.any_orthonormal_pair();
                let mut of_light = vec![0.0; count(bands)];
                for ([x, y, z], weight) in sphere_nodes(24, [cosine, 1.0]) {
                    basis.evaluate((x * a + y * b + z * toward).to_array(), &mut values);
                    of_light.iter_mut().zip(&values).for_each(|(sum, y)| *sum += weight * y);
                }
                let of_lambert = |l: usize| {
                    sphere(24, [0.0, 1.0], |w| {
                        basis.evaluate(w, &mut values);
                        w[2] * exact.transmission(w[2]) * values[index(l, 0)]
                    })
                };
                let lambert: Vec<_> = (0..bands).map(of_lambert).collect();
                let lambert: f64 =
                    lambert.iter().enumerate().map(|(l, k)| k * of_light[index(l, 0)]).sum();
                let mut truth = exact.diffuse * (lambert / PI * exact.transmission(view.z));
                if let Some(table) = &specular {
                    let row = &table.values()[degrees as usize * even_count(bands)..];
                    for l in 0..bands {
                        for m in 0..=l {
                            let [f0, f90] = row[even_index(l, m)];
                            let f = exact.f0 * f0 + DVec3::splat(f64::from(exact.lobe.f90()) * f90);
                            truth += f * of_light[index(l, m as isize)];
                        }
                    }
                }
                let value = radiance(brdf, view, light, bands);
                let error = (value - truth).abs().max_element() / truth.abs().max_element();
                println!("{brdf:?} {half_angle}: {error:.1e}");
                assert!(error < 1e-10, "{brdf:?} {half_angle}: {value} {truth}");
            }
        }
    }
}

/// π A_l/π of the Lambertian lobe is what the formula of the head says.
#[test]
fn the_lambertian_lobe_is_the_clamped_cosine() {
    let mut scales = [0.0; 5];
    manylights_harmonics::clamped_cosine::scales(&mut scales);
    for (l, [k, _]) in diffuse::lobes(5, Damping::None).into_iter().enumerate() {
        assert!((k - scales[l] * (2 * l + 1) as f64 / (4.0 * PI)).abs() < 1e-14, "{l}");
    }
}

/// Measured on the same formulas by other code: 7.7, 3.2, 0.8 %, each to its last digit.
#[test]
fn lambertian_surfaces_under_a_lamp() {
    let (half_angle, normals) = (0.2_f64, 2000);
    for (bands, bound) in [(3, 0.0775), (5, 0.0325), (9, 0.0085)] {
        let mut sums = [0.0; 2];
        for i in 0..normals {
            // Uniform normals: their cosines to the light are.
            let c = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(normals);
            let toward = DVec3::new((1.0 - c * c).sqrt(), 0.0, c);
            let truth = sphere_irradiance(c, half_angle.sin()) / PI;
            let brdf = Brdf::lambert(Vec3::ONE);
            let value = radiance(brdf, DVec3::Z, light(toward, half_angle), bands).x;
            sums[0] += (value - truth).powi(2);
            sums[1] += truth.powi(2);
        }
        let error = (sums[0] / sums[1]).sqrt();
        println!("{bands} bands: {:.3} %", 100.0 * error);
        assert!(error < bound, "{bands} bands: {error}");
    }
}

/// In the limit of many bands each rough receiver meets the integral over the light, seen or cut by the
/// horizon.
#[test]
fn many_bands_meet_the_integral() {
    let camera = view(40.0);
    for brdf in [Brdf::lambert(Vec3::splat(0.5)), mirror_like(1.0), glossy(0.6), dielectric(0.7)] {
        for toward in [oblique(Vec3::Z).as_dvec3(), view(95.0), view(-30.0)] {
            let largest = by_quadrature(brdf, camera, view(-35.0), 0.4, 60).max_element();
            // Of a light as f32 has it.
            let light = light(toward, 0.4);
            let half_angle = (f64::from(light.radius / light.center.length())).asin();
            let nodes = if toward.z < 0.4 { 800 } else { 100 };
            let toward = light.center.as_dvec3().normalize();
            let whole = by_quadrature(brdf, camera, toward, half_angle, nodes);
            let errors = [5, 9, 15, 30].map(|bands| {
                let value = radiance(brdf, camera, light, bands);
                (value - whole).abs().max_element() / largest
            });
            println!("{brdf:?} {toward}: {errors:?}");
            assert!(errors[3] < 1e-4, "{brdf:?} {toward}: {errors:?}");
            assert!(errors[3] < 0.02 * errors[0], "{brdf:?} {toward}: {errors:?}");
        }
    }
}
