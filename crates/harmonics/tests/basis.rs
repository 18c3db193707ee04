//! The basis is orthonormal, and Parseval's identity holds.

use crate::common;
use manylights_harmonics::{Basis, MAX_BANDS, count, index, quadrature};
use proptest::prelude::*;

#[test]
fn orthonormal() {
    let basis = Basis::<f64>::new(MAX_BANDS);
    let mut values = vec![0.0; count(MAX_BANDS)];
    // Every order of the first four bands and of the last, and the middle of each.
    let rows: Vec<usize> = (0..count(4))
        .chain(count(MAX_BANDS - 1)..count(MAX_BANDS))
        .chain((4..MAX_BANDS).map(|l| index(l, (l / 2) as isize)))
        .collect();
    let mut products = vec![vec![0.0; count(MAX_BANDS)]; rows.len()];
    for (direction, weight) in quadrature::sphere_nodes(MAX_BANDS, [-1.0, 1.0]) {
        basis.evaluate(direction, &mut values);
        for (products, &row) in products.iter_mut().zip(&rows) {
            let weighted = weight * values[row];
            products.iter_mut().zip(&values).for_each(|(sum, value)| *sum += weighted * value);
        }
    }
    for (products, row) in products.iter().zip(rows) {
        for (i, product) in products.iter().enumerate() {
            let expected = if i == row { 1.0 } else { 0.0 };
            assert!((product - expected).abs() < 1e-12, "<{row}, {i}> = {product}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, ..ProptestConfig::default() })]

    #[test]
    fn parseval(seed in 0..1_000_usize, bands in 1..=MAX_BANDS) {
        let basis = Basis::<f64>::new(bands);
        let [f, g] = [seed, seed + 1].map(|seed| common::coefficients(count(bands), seed));
        let mut values = vec![0.0; count(bands)];
        let [mut square, mut product] = [0.0; 2];
        for (direction, weight) in quadrature::sphere_nodes(bands, [-1.0, 1.0]) {
            basis.evaluate(direction, &mut values);
            let [f, g] = [&f, &g].map(|f| common::dot(f, &values));
            square += weight * f * f;
            product += weight * f * g;
        }
        let norms = common::dot(&f, &f).max(common::dot(&g, &g));
        prop_assert!((square - common::dot(&f, &f)).abs() <= 1e-12 * norms, "{square}");
        prop_assert!((product - common::dot(&f, &g)).abs() <= 1e-12 * norms, "{product}");
    }
}
