//! What spheres in the stead of triangles leave of them, in f64: beside what was measured on the same formulas
//! by other code (here "as measured"), to two digits of it.

use crate::study::{Study, equilateral, right_isosceles, sliver};
use manylights_polygonal_light::TriangleForm::{
    self, Compromise, CompromiseRoot, Main, Point, Scaled, SolidAngle, Sphere,
};

/// Forms whose coefficients tend to the triangle's.
const CONVERGENT: [TriangleForm; 5] = [Main, CompromiseRoot, SolidAngle, Scaled, Point];

fn near(found: f64, measured: f64, most: f64, what: &str) {
    println!("{what}: {found:.2e}, as measured {measured:.2e}");
    assert!((found / measured - 1.0).abs() < most, "{what}: {found} for {measured}");
}

/// Of the equilateral triangle at 1, 2, 5, 10 and 30 sizes.
#[test]
fn coefficients_of_the_equilateral_triangle() {
    let of_three = [
        (Main, [0.17, 0.044, 0.007, 0.0017, 1.9e-4]),
        (Compromise, [0.54, 0.53, 0.52, 0.52, 0.52]),
        (CompromiseRoot, [0.17, 0.041, 0.006, 0.0016, 1.8e-4]),
        (SolidAngle, [0.12, 0.029, 0.0044, 0.0011, 1.2e-4]),
        (Scaled, [0.12, 0.028, 0.0044, 0.0011, 1.2e-4]),
        (Point, [0.15, 0.034, 0.0053, 0.0013, 1.5e-4]),
    ];
    let of_five = [
        (Main, [0.25, 0.066, 0.011, 0.0026, 2.9e-4]),
        (Compromise, [0.54, 0.52, 0.52, 0.52, 0.52]),
        (CompromiseRoot, [0.24, 0.058, 0.009, 0.0022, 2.5e-4]),
        (SolidAngle, [0.23, 0.055, 0.0086, 0.0021, 2.4e-4]),
        (Scaled, [0.21, 0.053, 0.0084, 0.0021, 2.3e-4]),
        (Point, [0.35, 0.079, 0.012, 0.0030, 3.4e-4]),
    ];
    let of_nine = [
        (Main, [0.44, 0.13, 0.022, 0.0054, 6e-4]),
        (Compromise, [0.56, 0.51, 0.52, 0.52, 0.52]),
        (CompromiseRoot, [0.43, 0.12, 0.019, 0.0048, 5.3e-4]),
        (SolidAngle, [0.45, 0.13, 0.020, 0.0051, 5.6e-4]),
        (Scaled, [0.42, 0.12, 0.019, 0.0048, 5.4e-4]),
        (Point, [1.0, 0.24, 0.036, 0.0089, 9.8e-4]),
    ];
    for (bands, forms) in [(3, of_three), (5, of_five), (9, of_nine)] {
        let study = Study::new(bands);
        for (form, errors) in forms {
            for (distance, measured) in [1.0, 2.0, 5.0, 10.0, 30.0].into_iter().zip(errors) {
                let found = study.error(form, equilateral(), distance);
                near(found, measured, 0.08, &format!("{form:?} {bands} {distance}"));
            }
        }
    }
}

/// Shape, not solid angle, is what is missing of them.
#[test]
fn solid_angles_and_coefficients_of_slivers() {
    let study = Study::new(5);
    let distances = [1.0, 2.0, 5.0, 10.0];
    let of_main = [[0.40, 0.81], [0.20, 0.42], [0.037, 0.082], [0.0095, 0.021]];
    for (distance, measured) in distances.into_iter().zip(of_main) {
        let found = study.solid_angle_error(Main, sliver(), distance);
        near(found, measured[0], 0.08, &format!("solid angle at {distance}"));
        near(study.error(Main, sliver(), distance), measured[1], 0.08, &format!("at {distance}"));
    }
    for (distance, measured) in distances.into_iter().zip([0.83, 0.41, 0.074, 0.019]) {
        let found = study.error(SolidAngle, sliver(), distance);
        near(found, measured, 0.08, &format!("solid angle at {distance}"));
    }
}

#[test]
fn errors_fall_with_the_square_of_the_distance() {
    for bands in [5, 9] {
        let study = Study::new(bands);
        for triangle in [equilateral(), right_isosceles(), sliver()] {
            for form in CONVERGENT {
                let [at_20, at_60] = [20.0, 60.0].map(|d| study.error(form, triangle, d));
                near(at_60 * 9.0, at_20, 0.02, &format!("{form:?} {bands}"));
            }
            for form in [Sphere, Compromise] {
                let error = study.error(form, triangle, 60.0);
                assert!(error > 0.5, "{form:?}: {error}");
            }
        }
    }
}

/// Bounds that the form of the thesis has to meet.
#[test]
fn the_main_form_is_as_good_as_it_is_held_to_be() {
    let study = Study::new(5);
    for (distance, most) in [(2.0, 0.08), (10.0, 4e-3)] {
        let error = study.error(Main, equilateral(), distance);
        assert!(error <= most, "{error} at {distance}");
    }
}

/// Growth is quadratic in the band (figure 4.10d).
#[test]
fn errors_grow_with_the_band() {
    let study = Study::new(9);
    let of_main = [4e-3, 9e-3, 1.6e-2, 2.4e-2, 3.4e-2, 4.6e-2, 5.9e-2, 7.4e-2, 9.1e-2];
    let of_scaled = [5e-3, 1.1e-2, 1.9e-2, 2.9e-2, 4.1e-2, 5.4e-2, 6.9e-2, 8.5e-2];
    for (l, measured) in of_main.into_iter().enumerate() {
        let found = study.band_error(Main, equilateral(), (2.0, l));
        near(found, measured, 0.16, &format!("band {l} of main"));
    }
    for (l, measured) in (1..9).zip(of_scaled) {
        let found = study.band_error(Scaled, equilateral(), (2.0, l));
        near(found, measured, 0.16, &format!("band {l} of scaled"));
    }
    let [second, eighth] = [2, 8].map(|l| study.band_error(Main, equilateral(), (10.0, l)));
    assert!(eighth / second > 6.0 && eighth / second < 16.0, "{second} {eighth}");
}

/// A square of side 1 at height 1 in 2, 18, 72, 288 and 648 triangles.
#[test]
fn a_square_in_many_triangles() {
    let of_form = [
        (Sphere, [[0.48, 0.11], [0.40, 0.10], [0.40, 0.10], [0.40, 0.10], [0.40, 0.10]]),
        (
            Main,
            [[0.19, 0.022], [0.014, 2.2e-3], [0.0035, 5.3e-4], [8.7e-4, 1.3e-4], [3.8e-4, 5.9e-5]],
        ),
        (
            SolidAngle,
            [[0.17, 0.0091], [0.015, 1.0e-3], [0.0036, 2.6e-4], [9.1e-4, 6.6e-5], [4.0e-4, 2.9e-5]],
        ),
        (
            Scaled,
            [[0.16, 0.011], [0.014, 1.2e-3], [0.0035, 3.0e-4], [8.8e-4, 7.5e-5], [3.9e-4, 3.3e-5]],
        ),
        (Compromise, [[0.28, 0.074], [0.24, 0.067], [0.24, 0.067], [0.24, 0.067], [0.24, 0.067]]),
        (
            CompromiseRoot,
            [[0.20, 0.022], [0.015, 2.2e-3], [0.0037, 5.3e-4], [9.2e-4, 1.3e-4], [4.1e-4, 5.9e-5]],
        ),
        (
            Point,
            [[0.28, 0.0078], [0.020, 7e-4], [0.0050, 1.8e-4], [0.0012, 4.4e-5], [5.5e-4, 1.9e-5]],
        ),
    ];
    let study = Study::new(5);
    for (form, errors) in of_form {
        for (k, measured) in [1, 3, 6, 12, 18].into_iter().zip(errors) {
            let found = study.square_errors(form, k, 1.0);
            for (what, (found, measured)) in
                ["coefficients", "irradiance"].into_iter().zip(found.into_iter().zip(measured))
            {
                near(found, measured, 0.1, &format!("{form:?}, {} triangles, {what}", 2 * k * k));
            }
        }
    }
    for form in CONVERGENT {
        let [coefficients, irradiance] = study.square_errors(form, 18, 1.0);
        assert!(coefficients <= 6e-4 && irradiance <= 1e-4, "{form:?}");
    }
}
