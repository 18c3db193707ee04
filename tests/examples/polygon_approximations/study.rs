//! Errors of spheres in the stead of triangles, in f64: coefficients of two-sided triangles beside the exact
//! ones.

use std::f64::consts::PI;

use manylights_harmonics::polygon::PolygonProjection;
use manylights_harmonics::zonal::{TriangleForm, TriangleSighting, rotate};
use manylights_harmonics::{Basis, clamped_cosine, count, index};

pub(crate) type Corners = [[f64; 3]; 3];

/// Equilateral.
pub(crate) fn equilateral() -> Corners {
    let corner = |turn: f64| {
        let (sin, cos) = (2.0 * PI * turn / 3.0).sin_cos();
        [cos, sin, 0.0]
    };
    normalized([0.0, 1.0, 2.0].map(corner))
}

/// Half of a square.
pub(crate) fn right_isosceles() -> Corners {
    normalized([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
}

/// Isosceles, ten times as wide as high.
pub(crate) fn sliver() -> Corners {
    normalized([[-5.0, 0.0, 0.0], [5.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
}

/// The same triangle in the plane z = 0 with its centroid at the origin and √(2 area) = 1: one size.
fn normalized(corners: Corners) -> Corners {
    let [a, b, c] = corners;
    let twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let center = [0, 1, 2].map(|axis| (a[axis] + b[axis] + c[axis]) / 3.0);
    corners.map(|v| [0, 1, 2].map(|axis| (v[axis] - center[axis]) / twice_area.sqrt()))
}

/// Uniform directions of the half sphere with cosines above 0.1 to the triangle's normal, where errors are
/// taken.
pub(crate) fn directions(many: u32) -> impl Iterator<Item = [f64; 3]> {
    (0..many).map(move |i| {
        let z = 1.0 - 0.9 * (f64::from(i) + 0.5) / f64::from(many);
        let (sin, cos) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
        let r = ((1.0 - z) * (1.0 + z)).sqrt();
        [r * cos, r * sin, z]
    })
}

pub(crate) fn seen_from(corners: Corners, point: [f64; 3]) -> Corners {
    corners.map(|corner| [0, 1, 2].map(|axis| corner[axis] - point[axis]))
}

/// Coefficients of a number of bands.
pub(crate) struct Study {
    pub(crate) bands: usize,
    basis: Basis<f64>,
    exact: PolygonProjection<f64>,
}

impl Study {
    pub(crate) fn new(bands: usize) -> Self {
        Self { bands, basis: Basis::new(bands), exact: PolygonProjection::new(bands) }
    }

    /// Of a triangle as a point sees it, from either side.
    pub(crate) fn exact(&self, corners: Corners) -> Vec<f64> {
        let mut sums = self.exact.zero();
        self.exact.add(&corners, 1.0, &mut sums);
        let mut values = vec![0.0; count(self.bands)];
        let mut gradients = vec![[0.0; 3]; count(self.bands)];
        self.exact.coefficients(&sums, &mut values, &mut gradients);
        // The first of them is the solid angle's.
        let side = values[0].signum();
        values.into_iter().map(|value| side * value).collect()
    }

    /// Of its form.
    pub(crate) fn of(&self, form: TriangleForm, corners: Corners) -> Vec<f64> {
        let seen = TriangleSighting::new(corners, true, [0.0, 0.0, 1.0]).expect("a triangle");
        let (mut scales, mut values) = (vec![0.0; self.bands], vec![0.0; count(self.bands)]);
        seen.scales(form, &mut scales);
        rotate(&self.basis, &scales, seen.direction, &mut values);
        values
    }

    /// Irradiance of a receiver whose normal is z, in these bands.
    pub(crate) fn irradiance(&self, coefficients: &[f64]) -> f64 {
        let mut scales = vec![0.0; self.bands];
        clamped_cosine::scales(&mut scales);
        // A zonal function's coefficient of m = 0 about its own axis.
        let term = |(l, scale): (usize, &f64)| {
            scale * ((2 * l + 1) as f64 / (4.0 * PI)).sqrt() * coefficients[index(l, 0)]
        };
        scales.iter().enumerate().map(term).sum()
    }

    /// Root of the mean squared relative error of the coefficients, over directions at a distance in sizes.
    pub(crate) fn error(&self, form: TriangleForm, triangle: Corners, distance: f64) -> f64 {
        self.errors(form, triangle, distance, |found, truth| {
            norm(&difference(found, truth)) / norm(truth)
        })
    }

    /// The same of the solid angle.
    pub(crate) fn solid_angle_error(
        &self,
        form: TriangleForm,
        triangle: Corners,
        distance: f64,
    ) -> f64 {
        self.errors(form, triangle, distance, |found, truth| found[0] / truth[0] - 1.0)
    }

    /// The same of one band, relative to all.
    pub(crate) fn band_error(
        &self,
        form: TriangleForm,
        triangle: Corners,
        (distance, l): (f64, usize),
    ) -> f64 {
        let range = l * l..(l + 1) * (l + 1);
        self.errors(form, triangle, distance, |found, truth| {
            norm(&difference(&found[range.clone()], &truth[range.clone()])) / norm(truth)
        })
    }

    fn errors(
        &self,
        form: TriangleForm,
        triangle: Corners,
        distance: f64,
        error: impl Fn(&[f64], &[f64]) -> f64,
    ) -> f64 {
        const MANY: u32 = 200;
        let square = |direction: [f64; 3]| {
            let corners = seen_from(triangle, direction.map(|axis| distance * axis));
            error(&self.of(form, corners), &self.exact(corners)).powi(2)
        };
        (directions(MANY).map(square).sum::<f64>() / f64::from(MANY)).sqrt()
    }

    /// A square of side 1 at a height, cut into 2k² triangles, over 13 × 13 points of 3 × 3 of a plane that
    /// faces it: the root of the mean squared error of the summed coefficients over that of the true ones, and
    /// the mean error of the irradiance over its largest.
    pub(crate) fn square_errors(&self, form: TriangleForm, k: u32, height: f64) -> [f64; 2] {
        let (triangles, whole) = (square(k), square(1));
        let (mut squares, mut errors, mut largest) = ([0.0; 2], 0.0, 0.0_f64);
        for i in 0..169 {
            let place = [i % 13, i / 13].map(|step| f64::from(step) / 4.0 - 1.5);
            let point = [place[0], place[1], -height];
            let sum = |of: &dyn Fn(Corners) -> Vec<f64>, triangles: &[Corners]| {
                let mut sum = vec![0.0; count(self.bands)];
                for &triangle in triangles {
                    let values = of(seen_from(triangle, point));
                    sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
                }
                sum
            };
            let found = sum(&|corners| self.of(form, corners), &triangles);
            let truth = sum(&|corners| self.exact(corners), &whole);
            squares[0] += norm(&difference(&found, &truth)).powi(2);
            squares[1] += norm(&truth).powi(2);
            let [found, truth] = [found, truth].map(|values| self.irradiance(&values));
            errors += (found - truth).abs();
            largest = largest.max(truth);
        }
        [(squares[0] / squares[1]).sqrt(), errors / 169.0 / largest]
    }
}

/// A square of side 1 in the plane z = 0 about the origin, in 2k² triangles.
pub(crate) fn square(k: u32) -> Vec<Corners> {
    let at = |i: u32| f64::from(i) / f64::from(k) - 0.5;
    let cells = (0..k * k).map(|cell| [cell % k, cell / k]);
    cells
        .flat_map(|[i, j]| {
            let corner = |di: u32, dj: u32| [at(i + di), at(j + dj), 0.0];
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            [[a, b, d], [b, c, d]]
        })
        .collect()
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}
