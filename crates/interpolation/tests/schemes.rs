//! What each scheme reproduces, how fast its error falls, and whether it is continuous.

use manylights_harmonics::zonal::{Sighting, cap_rate_stable, cap_stable, light_gradient};
use manylights_harmonics::{Basis, count};
use manylights_interpolation::{Grid, Scheme};

const SCHEMES: [Scheme; 4] =
    [Scheme::Trilinear, Scheme::Taylor, Scheme::HermiteFlat, Scheme::Hermite];

/// Value and gradient at a point of several fields.
type Field<'a> = &'a dyn Fn([f64; 3]) -> Vec<[f64; 4]>;

/// A field that is read from the vertices of a grid.
struct Sampled {
    grid: Grid<f64>,
    vertices: Vec<Vec<[f64; 4]>>,
}

impl Sampled {
    fn new(field: Field, vertices: usize) -> Self {
        let grid = Grid::over([[-1.0; 3], [1.0; 3]], [vertices; 3]);
        let per_cell = |point| {
            let mut samples = field(point);
            for sample in &mut samples {
                for i in 0..3 {
                    sample[i + 1] *= grid.spacing[i];
                }
            }
            samples
        };
        Self { grid, vertices: grid.positions().map(per_cell).collect() }
    }

    fn read(&self, scheme: Scheme, point: [f64; 3]) -> Vec<f64> {
        let place = self.grid.place(point);
        let mut sums = vec![0.0; self.vertices[0].len()];
        let corners = self.grid.corners(place.cell);
        for (corner, weights) in corners.into_iter().zip(scheme.weights(place.local)) {
            for (sum, sample) in sums.iter_mut().zip(&self.vertices[corner]) {
                *sum += (0..4).map(|i| weights[i] * sample[i]).sum::<f64>();
            }
        }
        sums
    }
}

/// Points all over the box, low-discrepancy.
fn points(number: usize) -> impl Iterator<Item = [f64; 3]> {
    let steps = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_960_3];
    (1..=number).map(move |i| steps.map(|step: f64| 2.0 * (i as f64 * step).fract() - 1.0))
}

fn largest_error(field: Field, scheme: Scheme) -> f64 {
    let sampled = Sampled::new(field, 4);
    points(200).fold(0.0, |worst: f64, point| {
        let (read, truth) = (sampled.read(scheme, point), field(point));
        read.iter()
            .zip(truth)
            .fold(worst, |worst, (read, [truth, ..])| worst.max((read - truth).abs()))
    })
}

#[test]
fn each_scheme_reproduces_its_polynomials() {
    let linear = |[x, y, z]: [f64; 3]| vec![[2.0 + x - 3.0 * y + 0.5 * z, 1.0, -3.0, 0.5]];
    let cube =
        |[x, y, z]: [f64; 3]| vec![[x.powi(3) + y.powi(3) - z, 3.0 * x * x, 3.0 * y * y, -1.0]];
    let mixed = |[x, y, z]: [f64; 3]| vec![[x * y - y * z, y, x - z, -y]];
    let exact = |field: Field| SCHEMES.map(|scheme| largest_error(field, scheme) < 1e-13);
    assert_eq!(exact(&linear), [true; 4]);
    assert_eq!(exact(&cube), [false, false, true, true]);
    assert_eq!(exact(&mixed), [true, true, false, true]);
    // (x − h01(x))(y − h01(y)) of the cell's area: 0.0093 at most, for each of the two products.
    let flat = largest_error(&mixed, Scheme::HermiteFlat);
    assert!(flat > 1e-3 && flat < 2.0 * 0.0093 * (2.0_f64 / 3.0).powi(2), "{flat:e}");
}

/// 25 coefficients of twelve spheres, half a side of the box to a whole one outside.
fn lights(point: [f64; 3]) -> Vec<[f64; 4]> {
    const BANDS: usize = 5;
    let basis = Basis::new(BANDS);
    let mut sums = vec![[0.0; 4]; count(BANDS)];
    for i in 0..12 {
        let (z, turn) = ((2 * i + 1) as f64 / 12.0 - 1.0, i as f64 * 2.399_963_229_728_653);
        let ring = (1.0 - z * z).sqrt();
        let towards = [ring * turn.cos(), ring * turn.sin(), z];
        let most = towards.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
        let distance = 2.0 + (i % 3) as f64 * 0.5;
        let center = towards.map(|c| distance * c / most);
        let offset = [0, 1, 2].map(|k| center[k] - point[k]);
        let sighting = Sighting::of_sphere(offset, 0.15).expect("outside");
        let (mut scales, mut rates) = ([0.0; BANDS], [0.0; BANDS]);
        cap_stable(sighting.cap, &mut scales);
        cap_rate_stable(sighting.cap, sighting.cosine_rate, &mut rates);
        let mut values = vec![0.0; count(BANDS)];
        let mut gradients = [(); 3].map(|()| vec![0.0; count(BANDS)]);
        let [x, y, z] = &mut gradients;
        basis.evaluate_with_gradient(sighting.direction, &mut values, [x, y, z]);
        light_gradient(&sighting, &scales, &rates, &values, [x, y, z]);
        for (j, sum) in sums.iter_mut().enumerate() {
            let l = (j as f64).sqrt() as usize;
            sum[0] += scales[l] * values[j];
            (0..3).for_each(|k| sum[k + 1] += gradients[k][j]);
        }
    }
    sums
}

fn relative_error(scheme: Scheme, vertices: usize) -> f64 {
    let sampled = Sampled::new(&lights, vertices);
    let (mut error, mut truth) = (0.0, 0.0);
    for point in points(400) {
        for (read, [value, ..]) in sampled.read(scheme, point).iter().zip(lights(point)) {
            error += (read - value).powi(2);
            truth += value * value;
        }
    }
    (error / truth).sqrt()
}

/// Of a smooth field, from 9³ to 17³ vertices.
#[test]
fn errors_fall_by_the_order_of_the_scheme() {
    let ranges = [1.9..2.1, 1.9..2.1, 2.2..4.0, 3.0..4.0];
    let bounds = [0.03, 0.03, 2.5e-3, 1.5e-3];
    for ((scheme, range), bound) in SCHEMES.into_iter().zip(ranges).zip(bounds) {
        let [coarse, fine] = [9, 17].map(|vertices| relative_error(scheme, vertices));
        let order = (coarse / fine).log2();
        println!("{scheme:?}: {coarse:.2e} {fine:.2e}, order {order:.2}");
        assert!(range.contains(&order), "{scheme:?}: {order}");
        assert!(coarse <= bound, "{scheme:?}: {coarse:e}");
    }
}

/// Across the faces of cells.
#[test]
fn values_do_not_jump() {
    let sampled = Sampled::new(&lights, 5);
    let most = points(100).flat_map(lights).fold(0.0, |most: f64, [v, ..]| most.max(v.abs()));
    for scheme in SCHEMES {
        for [_, y, z] in points(50) {
            let [below, above] = [-1e-10, 1e-10].map(|x| sampled.read(scheme, [x, y, z]));
            let jump = below.iter().zip(&above).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(jump < 1e-6 * most, "{scheme:?}: {jump:e}");
        }
    }
}
