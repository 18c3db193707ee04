//! Values and gradients of the basis at the poles, the axes, around them and between.

use manylights_harmonics::hemispherical::HemisphericalBasis;
use manylights_harmonics::projection::fibonacci;
use manylights_harmonics::thesis::{Polynomials, SphericalGradients, to_cartesian};
use manylights_harmonics::{Basis, count};

use crate::unit::{normalised, unit};
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

/// The forms for a number of bands.
struct Forms {
    polynomials: Option<Polynomials<f32>>,
    spherical: SphericalGradients<f32>,
    stable: Basis<f32>,
    exact: Basis<f64>,
}

/// A table over all directions and bands; `add` compares the forms in one direction, in the order of
/// the columns.
fn compare(
    title: &str,
    about: &str,
    add: impl Fn(&Forms, [f32; 3], &mut [Worst; COLUMNS.len() - 1]),
) -> Table {
    let mut table = Table::new(title, about, &COLUMNS, 1e-5);
    for (family, directions) in families() {
        for bands in [5, 10, 20, 30] {
            let forms = Forms {
                polynomials: (bands <= POLYNOMIAL_BANDS).then(|| Polynomials::new(bands)),
                spherical: SphericalGradients::new(bands),
                stable: Basis::new(bands),
                exact: Basis::new(bands),
            };
            let mut worst = [Worst::default(); COLUMNS.len() - 1];
            directions.iter().for_each(|&direction| add(&forms, direction, &mut worst));
            let [polynomial, rest @ ..] = worst.map(Some);
            let polynomial = polynomial.filter(|_| forms.polynomials.is_some());
            table.row(&format!("{family}, {bands}"), &[&[polynomial], &rest[..]].concat());
        }
    }
    table
}

pub(crate) fn values() -> Table {
    let about = "Worst error relative to the largest value of the band in that direction.";
    compare("Values", about, |forms, direction, worst| {
        let size = count(forms.stable.bands());
        let [mut y, mut theta, mut phi] = [0; 3].map(|_| vec![0.0; size]);
        let mut truth = vec![0.0; size];
        forms.exact.evaluate(normalised(direction.map(f64::from)), &mut truth);
        if let Some(polynomials) = &forms.polynomials {
            polynomials.evaluate(direction, &mut y);
            worst[0].add_bands(&y, &truth);
        }
        forms.spherical.direct(direction, &mut y, &mut theta, &mut phi);
        worst[1].add_bands(&y, &truth);
        forms.spherical.sloans_like(direction, &mut y, &mut theta, &mut phi);
        worst[2].add_bands(&y, &truth);
        forms.stable.evaluate(direction, &mut y);
        worst[3].add_bands(&y, &truth);
    })
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
    compare("Gradients", about, |forms, direction, worst| {
        let size = count(forms.stable.bands());
        let [mut y, mut theta, mut phi] = [0; 3].map(|_| vec![0.0; size]);
        let (mut wide, mut truth) = (vec![0.0; size], [0; 3].map(|_| vec![0.0; size]));
        let mut gradient = [0; 3].map(|_| vec![0.0; size]);
        let slices = truth.each_mut().map(|axis| &mut axis[..]);
        let wide_direction = normalised(direction.map(f64::from));
        forms.exact.evaluate_with_gradient(wide_direction, &mut wide, slices);
        if let Some(polynomials) = &forms.polynomials {
            polynomials.gradient(direction, gradient.each_mut().map(|axis| &mut axis[..]));
            add_gradient(&mut worst[0], &gradient, &truth);
        }
        forms.spherical.direct(direction, &mut y, &mut theta, &mut phi);
        to_cartesian(direction, &theta, &phi, gradient.each_mut().map(|axis| &mut axis[..]));
        add_gradient(&mut worst[1], &gradient, &truth);
        forms.spherical.sloans_like(direction, &mut y, &mut theta, &mut phi);
        to_cartesian(direction, &theta, &phi, gradient.each_mut().map(|axis| &mut axis[..]));
        add_gradient(&mut worst[2], &gradient, &truth);
        let slices = gradient.each_mut().map(|axis| &mut axis[..]);
        forms.stable.evaluate_with_gradient(direction, &mut y, slices);
        add_gradient(&mut worst[3], &gradient, &truth);
    })
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
