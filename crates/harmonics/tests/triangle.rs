//! Gradients of triangles by spheres against differences.

use manylights_harmonics::zonal::{TriangleForm, TriangleSighting, rotate};
use manylights_harmonics::{Basis, count};

type Corners = [[f64; 3]; 3];

const TRIANGLE: Corners = [[-0.4, 0.05, -0.3], [0.02, 0.07, 0.6], [0.5, -0.02, -0.2]];

fn seen_from(point: [f64; 3], two_sided: bool) -> TriangleSighting<f64> {
    let corners = TRIANGLE.map(|corner| [0, 1, 2].map(|axis| corner[axis] - point[axis]));
    TriangleSighting::new(corners, two_sided, [0.0, 0.0, 1.0]).expect("has an area")
}

fn coefficients(form: TriangleForm, bands: usize, seen: &TriangleSighting<f64>) -> Vec<f64> {
    let (mut scales, mut values) = (vec![0.0; bands], vec![0.0; count(bands)]);
    seen.scales(form, &mut scales);
    rotate(&Basis::new(bands), &scales, seen.direction, &mut values);
    values
}

fn gradients(form: TriangleForm, bands: usize, seen: &TriangleSighting<f64>) -> Vec<[f64; 3]> {
    let mut values = vec![0.0; count(bands)];
    let [mut x, mut y, mut z] = [values.clone(), values.clone(), values.clone()];
    Basis::new(bands).evaluate_with_gradient(seen.direction, &mut values, [&mut x, &mut y, &mut z]);
    let mut gradients: Vec<_> = x.into_iter().zip(y).zip(z).map(|((x, y), z)| [x, y, z]).collect();
    seen.coefficient_gradients(form, &values, &mut gradients);
    gradients
}

/// Of all coefficients with respect to the point along an axis, by six points.
fn differences(form: TriangleForm, bands: usize, point: [f64; 3], axis: usize) -> Vec<f64> {
    const STEP: f64 = 1e-3;
    let mut sum = vec![0.0; count(bands)];
    for (steps, weight) in [(1.0, 0.75), (2.0, -0.15), (3.0, 1.0 / 60.0)] {
        for side in [1.0, -1.0] {
            let mut moved = point;
            moved[axis] += side * steps * STEP;
            let values = coefficients(form, bands, &seen_from(moved, true));
            for (sum, value) in sum.iter_mut().zip(values) {
                *sum += side * weight * value / STEP;
            }
        }
    }
    sum
}

/// In front and behind, near and far, oblique.
const POINTS: [[f64; 3]; 4] =
    [[0.3, 1.4, -0.2], [-1.1, -0.9, 0.5], [2.0, 0.8, 3.0], [0.2, -11.0, 8.0]];

#[test]
fn gradients_are_those_of_differences() {
    for form in TriangleForm::ALL {
        for bands in [1, 5, 15] {
            for point in POINTS {
                let found = gradients(form, bands, &seen_from(point, true));
                let largest = found.as_flattened().iter().fold(0.0_f64, |m, c| m.max(c.abs()));
                for axis in 0..3 {
                    let truth = differences(form, bands, point, axis);
                    for (i, (found, truth)) in found.iter().zip(truth).enumerate() {
                        let error = (found[axis] - truth).abs() / largest;
                        assert!(error < 1e-9, "{form:?} {bands} {point:?} {i} {axis}: {error:e}");
                    }
                }
            }
        }
    }
}

/// The lit side of a one-sided triangle is that from which its corners run counter-clockwise; the other sees
/// nothing.
#[test]
fn one_sided_triangles_shine_to_their_front() {
    for form in TriangleForm::ALL {
        for [x, y, z] in POINTS {
            for height in [y.abs(), -y.abs()] {
                let both = seen_from([x, height, z], true);
                let one = seen_from([x, height, z], false);
                let lit = coefficients(form, 5, &one);
                let slopes = gradients(form, 5, &one);
                if height > 0.0 {
                    assert_eq!(lit, coefficients(form, 5, &both), "{form:?}");
                    assert_eq!(slopes, gradients(form, 5, &both), "{form:?}");
                } else {
                    assert!(lit.iter().all(|&value| value == 0.0), "{form:?} {lit:?}");
                    assert!(slopes.as_flattened().iter().all(|&c| c == 0.0), "{form:?} {slopes:?}");
                }
            }
        }
    }
}

#[test]
fn a_triangle_without_area_is_none() {
    for corners in [[[1.0, 2.0, 3.0]; 3], [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [4.0, 0.0, 0.0]]] {
        assert_eq!(TriangleSighting::new(corners, true, [0.0, 0.0, 1.0]), None);
    }
}

/// In the plane and a rounding beside it no form knows less than that.
#[test]
fn forms_are_finite_in_the_plane() {
    let [a, b, c] = TRIANGLE;
    for i in 0..2000 {
        let (s, t) = (f64::from(i % 50) * 0.1 - 2.0, f64::from(i / 50) * 0.1 - 2.0);
        let point = [0, 1, 2].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]));
        let seen = seen_from(point, true);
        for form in TriangleForm::ALL {
            let mut scales = [0.0; 9];
            seen.scales(form, &mut scales);
            assert!(scales.iter().all(|scale| scale.is_finite()), "{form:?} {point:?}: {scales:?}");
        }
    }
}
