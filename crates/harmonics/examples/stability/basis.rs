//! Values and gradients of the basis at the poles, the axes, around them and between.

use manylights_harmonics::hemispherical::HemisphericalBasis;
use manylights_harmonics::projection::fibonacci;
use manylights_harmonics::thesis::{Polynomials, SphericalGradients, to_cartesian};
use manylights_harmonics::{Basis, count};

use crate::{Table, Worst};

/// Largest number of bands of the polynomial form.
const POLYNOMIAL_BANDS: usize = 10;

const COLUMNS: [&str; 5] = ["directions, bands", "polynomial", "Direct", "Sloan's-like", "stable"];

fn families() -> Vec<(&'static str, Vec<[f32; 3]>)> {
    let near = |axes: &[usize], offsets: &[f64]| -> Vec<_> {
        let mut list = Vec::new();
        for &axis in axes {
            for (sign, &offset) in
                [1.0, -1.0].iter().flat_map(|s| offsets.iter().map(move |o| (s, o)))
            {
                for other in [1, 2] {
                    let mut direction = [0.0; 3];
                    direction[axis] = *sign;
                    direction[(axis + other) % 3] = offset;
                    list.push(unit(direction));
                }
            }
        }
        list
    };
    let offsets = [1e-30, 1e-20, 1e-10, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2];
    vec![
        ("poles", near(&[2], &[0.0])),
        ("around the poles", near(&[2], &offsets)),
        ("x and y axes", near(&[0, 1], &[0.0])),
        ("around these axes", near(&[0, 1], &offsets)),
        ("between", fibonacci(200, [-1.0, 1.0]).map(|(d, _): ([f64; 3], f64)| unit(d)).collect()),
    ]
}

/// The direction of f32 components nearest to unit length among some beside the given one: a component
/// off by δ moves band l by up to l(l + 1)/2 δ, which is not what is measured here.
fn unit(direction: [f64; 3]) -> [f32; 3] {
    let largest = direction.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let error = |d: &[f32; 3]| (d.iter().map(|&c| f64::from(c).powi(2)).sum::<f64>() - 1.0).abs();
    let candidates = (0..400).map(|i| {
        let stretch = 1.0 + 1e-5 * f64::from(i);
        let moved = direction.map(|c| if c.abs() < largest { c * stretch } else { c });
        normalised(moved).map(|c| c as f32)
    });
    candidates.min_by(|a, b| error(a).total_cmp(&error(b))).expect("some candidates")
}

fn normalised(direction: [f64; 3]) -> [f64; 3] {
    let length = direction.iter().map(|c| c * c).sum::<f64>().sqrt();
    direction.map(|c| c / length)
}

pub(crate) fn values() -> Table {
    let about = "Worst error relative to the largest value of the band in that direction.";
    let mut table = Table::new("Values", about, &COLUMNS, 1e-5);
    for (family, directions) in families() {
        for bands in [5, 10, 20, 30] {
            let size = count(bands);
            let polynomials = (bands <= POLYNOMIAL_BANDS).then(|| Polynomials::<f32>::new(bands));
            let spherical = SphericalGradients::<f32>::new(bands);
            let (basis, exact) = (Basis::<f32>::new(bands), Basis::<f64>::new(bands));
            let mut worst = [Worst::default(); 4];
            let (mut truth, mut y) = (vec![0.0; size], vec![0.0; size]);
            let (mut theta, mut phi) = (y.clone(), y.clone());
            for &direction in &directions {
                exact.evaluate(normalised(direction.map(f64::from)), &mut truth);
                if let Some(polynomials) = &polynomials {
                    polynomials.evaluate(direction, &mut y);
                    worst[0].add_bands(&y, &truth);
                }
                spherical.direct(direction, &mut y, &mut theta, &mut phi);
                worst[1].add_bands(&y, &truth);
                spherical.sloans_like(direction, &mut y, &mut theta, &mut phi);
                worst[2].add_bands(&y, &truth);
                basis.evaluate(direction, &mut y);
                worst[3].add_bands(&y, &truth);
            }
            let [polynomial, rest @ ..] = worst.map(Some);
            let polynomial = polynomial.filter(|_| polynomials.is_some());
            table.row(&format!("{family}, {bands}"), &[&[polynomial], &rest[..]].concat());
        }
    }
    table
}

/// One component of a gradient, all coefficients, relative to the largest component of the band.
fn add_gradient(worst: &mut Worst, gradient: &[Vec<f32>; 3], truth: &[Vec<f64>; 3]) {
    for l in 1..truth[0].len().isqrt() {
        let band = l * l..(l + 1) * (l + 1);
        let values: Vec<_> = gradient.iter().flat_map(|axis| axis[band.clone()].to_vec()).collect();
        let truths: Vec<_> = truth.iter().flat_map(|axis| axis[band.clone()].to_vec()).collect();
        worst.add_all(&values, &truths);
    }
}

pub(crate) fn gradients() -> Table {
    let about = "Cartesian components of the tangential gradient; Direct and Sloan's-like through \
                 thesis 3.15. Worst error relative to the largest component of the band in that \
                 direction.";
    let mut table = Table::new("Gradients", about, &COLUMNS, 1e-5);
    for (family, directions) in families() {
        for bands in [5, 10, 20, 30] {
            let size = count(bands);
            let polynomials = (bands <= POLYNOMIAL_BANDS).then(|| Polynomials::<f32>::new(bands));
            let spherical = SphericalGradients::<f32>::new(bands);
            let (basis, exact) = (Basis::<f32>::new(bands), Basis::<f64>::new(bands));
            let mut worst = [Worst::default(); 4];
            let [mut y, mut theta, mut phi] = [0; 3].map(|_| vec![0.0; size]);
            let mut wide = vec![0.0; size];
            let mut truth = [0; 3].map(|_| vec![0.0; size]);
            let mut gradient = [0; 3].map(|_| vec![0.0; size]);
            for &direction in &directions {
                let slices = truth.each_mut().map(|axis| &mut axis[..]);
                exact.evaluate_with_gradient(
                    normalised(direction.map(f64::from)),
                    &mut wide,
                    slices,
                );
                if let Some(polynomials) = &polynomials {
                    polynomials.gradient(direction, gradient.each_mut().map(|axis| &mut axis[..]));
                    add_gradient(&mut worst[0], &gradient, &truth);
                }
                spherical.direct(direction, &mut y, &mut theta, &mut phi);
                let slices = gradient.each_mut().map(|axis| &mut axis[..]);
                to_cartesian(direction, &theta, &phi, slices);
                add_gradient(&mut worst[1], &gradient, &truth);
                spherical.sloans_like(direction, &mut y, &mut theta, &mut phi);
                let slices = gradient.each_mut().map(|axis| &mut axis[..]);
                to_cartesian(direction, &theta, &phi, slices);
                add_gradient(&mut worst[2], &gradient, &truth);
                let slices = gradient.each_mut().map(|axis| &mut axis[..]);
                basis.evaluate_with_gradient(direction, &mut y, slices);
                add_gradient(&mut worst[3], &gradient, &truth);
            }
            let [polynomial, rest @ ..] = worst.map(Some);
            let polynomial = polynomial.filter(|_| polynomials.is_some());
            table.row(&format!("{family}, {bands}"), &[&[polynomial], &rest[..]].concat());
        }
    }
    table
}

pub(crate) fn hemispherical() -> Table {
    let about = "Worst error relative to the largest value of the band in that direction.";
    let columns = ["directions, bands", "stable"];
    let mut table = Table::new("Hemispherical harmonics", about, &columns, 1e-5);
    for (family, height) in
        [("at the horizon", 0.0), ("around the horizon", 1e-6), ("between", 1.0)]
    {
        for bands in [5, 10, 20] {
            let (basis, exact) =
                (HemisphericalBasis::<f32>::new(bands), HemisphericalBasis::<f64>::new(bands));
            let (mut h, mut truth) = (vec![0.0; count(bands)], vec![0.0; count(bands)]);
            let mut worst = Worst::default();
            for (direction, _) in fibonacci::<f64>(200, [0.0, height]) {
                let direction = unit(direction);
                basis.evaluate(direction, &mut h);
                exact.evaluate(normalised(direction.map(f64::from)), &mut truth);
                worst.add_bands(&h, &truth);
            }
            table.row(&format!("{family}, {bands}"), &[Some(worst)]);
        }
    }
    table
}
