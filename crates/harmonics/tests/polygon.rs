//! Polygons against quadrature, their gradients against differences.

use std::sync::LazyLock;

use crate::common::{derivative, difference, largest};
use manylights_harmonics::polygon::{MAX_BANDS, PolygonProjection, solid_angle};
use manylights_harmonics::{Basis, Real, count, quadrature};
use proptest::prelude::*;

fn vector(range: f64) -> impl Strategy<Value = [f64; 3]> {
    [-range..range, -range..range, -range..range]
}

/// A triangle of about unit size at a distance of `near` or more, on either side.
fn triangle(near: f64) -> impl Strategy<Value = [[f64; 3]; 3]> {
    let corners = [vector(0.8), vector(0.8), vector(0.8)];
    (corners, vector(1.0), near..near + 2.0).prop_filter_map("a triangle", move |(c, d, r)| {
        let length = d.iter().map(|c| c * c).sum::<f64>().sqrt();
        let normal = plane(&c);
        let area = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
        let place = |corner: [f64; 3]| [0, 1, 2].map(|i| corner[i] + d[i] / length * (r + 1.4));
        (length > 0.1 && area > 0.05).then(|| c.map(place))
    })
}

/// Twice the area along the normal.
fn plane([a, b, c]: &[[f64; 3]; 3]) -> [f64; 3] {
    let [u, v] = [b, c].map(|p| [0, 1, 2].map(|i| p[i] - a[i]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// ∫ Y_lm (n·ω)/r² dA over a triangle, by Gauss in both directions of the unit square.
fn by_quadrature(corners: &[[f64; 3]; 3], bands: usize) -> Vec<f64> {
    let basis = Basis::new(bands);
    let nodes = quadrature::gauss_legendre(48);
    let normal = plane(corners);
    let (mut sum, mut values) = (vec![0.0; count(bands)], vec![0.0; count(bands)]);
    for (x, wx) in &nodes {
        for (y, wy) in &nodes {
            let (u, v) = (0.5 * (x + 1.0), 0.5 * (y + 1.0));
            let at = [1.0 - u, u * (1.0 - v), u * v];
            let point = [0, 1, 2].map(|i| (0..3).map(|k| at[k] * corners[k][i]).sum::<f64>());
            let distance = point.iter().map(|c| c * c).sum::<f64>().sqrt();
            basis.evaluate(point.map(|c| c / distance), &mut values);
            let facing: f64 = (0..3).map(|i| normal[i] * point[i]).sum();
            let weight = 0.25 * wx * wy * u * facing / distance.powi(3);
            sum.iter_mut().zip(&values).for_each(|(sum, value)| *sum += weight * value);
        }
    }
    sum
}

static MOST_BANDS: LazyLock<PolygonProjection<f64>> =
    LazyLock::new(|| PolygonProjection::new(MAX_BANDS));

fn projected<R: Real>(bands: usize, corners: &[[R; 3]]) -> (Vec<R>, Vec<[R; 3]>) {
    project(&PolygonProjection::new(bands), corners)
}

fn project<R: Real>(
    projection: &PolygonProjection<R>,
    corners: &[[R; 3]],
) -> (Vec<R>, Vec<[R; 3]>) {
    let bands = projection.bands();
    let mut sums = projection.zero();
    projection.add(corners, R::one(), &mut sums);
    let mut values = vec![R::zero(); count(bands)];
    let mut gradients = vec![[R::zero(); 3]; count(bands)];
    projection.coefficients(&sums, &mut values, &mut gradients);
    (values, gradients)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn coefficients_are_those_of_quadrature(corners in triangle(0.3), bands in 1..=MAX_BANDS) {
        let (values, _) = projected(bands, &corners);
        let error = difference(&values, &by_quadrature(&corners, bands));
        prop_assert!(error < 1e-11, "{bands} bands: {error:e}");
    }

    #[test]
    fn gradients_are_differences(corners in triangle(0.3)) {
        let (_, gradients) = project(&MOST_BANDS, &corners);
        for axis in 0..3 {
            for (lm, gradient) in gradients.iter().enumerate().step_by(7) {
                // The point moves, and with it every corner the other way.
                let moved = derivative(0.0, 1e-3, |t| {
                    let corners = corners.map(|mut corner| {
                        corner[axis] -= t;
                        corner
                    });
                    project(&MOST_BANDS, &corners).0[lm]
                });
                prop_assert!((gradient[axis] - moved).abs() < 1e-7, "{lm}: {gradient:?} {moved}");
            }
        }
    }

    #[test]
    fn the_other_order_has_the_other_sign(corners in triangle(0.3)) {
        let [a, b, c] = corners;
        let [(one, _), (other, _)] = [[a, b, c], [a, c, b]].map(|order| projected::<f64>(9, &order));
        let sum: Vec<_> = one.iter().zip(&other).map(|(a, b)| a + b).collect();
        prop_assert!(largest(&sum) < 1e-13);
    }

    /// Sums over edges cancel for far polygons: what the head of the module states.
    #[test]
    fn single_precision_loses_digits_with_the_distance(corners in triangle(0.3)) {
        for (away, bound) in [(0.0, 1e-5), (10.0, 1.5e-4), (100.0, 1e-2)] {
            let towards: f64 = corners[0].iter().map(|c| c * c).sum::<f64>().sqrt();
            let shift = corners[0].map(|c| c / towards * away);
            let single = corners.map(|c| [0, 1, 2].map(|i| (c[i] + shift[i]) as f32));
            let exact = single.map(|corner| corner.map(f64::from));
            let (found, _) = projected(9, &single);
            let (truth, _) = projected(9, &exact);
            let found: Vec<_> = found.into_iter().map(f64::from).collect();
            // Of a slender or tilted polygon little is left of the edges' sums: what a square metre facing
            // the point covers is the measure.
            let most = (towards + away).powi(-2) / (4.0 * std::f64::consts::PI).sqrt();
            let error = difference(&found, &truth) / most;
            println!("{away}: {error:.1e}");
            prop_assert!(error < bound, "{away} away: {error:e}");
        }
    }
}

/// The outline is what counts: a square cut into triangles is the square.
#[test]
fn parts_add_up_to_the_whole() {
    let square = [[-1.0, -1.0, 1.5], [-1.0, 1.0, 1.5], [1.0, 1.0, 1.5], [1.0, -1.0, 1.5]];
    let [a, b, c, d] = square;
    let (whole, _) = projected(15, &square);
    let halves = [[a, b, c], [a, c, d]].map(|half| projected::<f64>(15, &half).0);
    let sum: Vec<_> = halves[0].iter().zip(&halves[1]).map(|(a, b)| a + b).collect();
    assert!(difference(&whole, &sum) < 1e-13);
    let solid_angle = solid_angle(&square);
    assert!(solid_angle < 0.0, "counter-clockwise as the point sees it");
    assert!((whole[0] * (4.0 * std::f64::consts::PI).sqrt() - solid_angle).abs() < 1e-13);
}

/// The point on an edge's line and in the plane, outside and inside; at a corner; a needle; no area.
#[test]
fn degenerate_polygons_have_their_limits() {
    let solid = |corners: &[[f64; 3]]| {
        let (values, gradients) = projected(9, corners);
        let all = values.iter().chain(gradients.as_flattened());
        assert!(all.copied().all(f64::is_finite), "{corners:?}: {values:?} {gradients:?}");
        (values[0] * (4.0 * std::f64::consts::PI).sqrt(), largest(&values))
    };
    // Outside, in the plane, on the line of an edge: nothing is seen.
    let (angle, largest) = solid(&[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0]]);
    assert!(angle.abs() < 1e-15 && largest < 1e-14);
    // On the line of an edge of a polygon that is seen: what a hair beside it sees.
    let corners = [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 1.0]];
    let beside = corners.map(|[x, y, z]| [x, y + 1e-7, z - 1e-7]);
    assert!((solid(&corners).0 - solid(&beside).0).abs() < 1e-6);
    // At a corner: the fan that its edges span has no area, and the far edge closes it.
    solid(&[[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]);
    let needle = solid(&[[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.5, 1.0 + 1e-9]]);
    assert!(needle.0.abs() < 1e-8 && needle.1 < 1e-7, "{needle:?}");
    let point = solid(&[[1.0, 0.0, 1.0]; 3]);
    assert_eq!(point, (0.0, 0.0));
}
