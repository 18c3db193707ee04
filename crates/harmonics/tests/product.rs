//! Products of functions against quadrature of the functions themselves.

use crate::common;
use crate::common::{coefficients, difference, dot, turn};
use manylights_harmonics::clamped_cosine::{self, Folded, Local};
use manylights_harmonics::product::{self, Product};
use manylights_harmonics::rotation::Zxzxz;
use manylights_harmonics::{Basis, convolution, count, quadrature, zonal};
use proptest::prelude::*;

/// Coefficients of a function by quadrature over 0 ≤ |z| ≤ 1 in halves, exact for polynomials.
fn project(bands: usize, nodes: usize, mut f: impl FnMut([f64; 3]) -> f64) -> Vec<f64> {
    let basis = Basis::<f64>::new(bands);
    let mut values = vec![0.0; count(bands)];
    let mut sums = vec![0.0; count(bands)];
    for (i, sum) in sums.iter_mut().enumerate() {
        for half in [[-1.0, 0.0], [0.0, 1.0]] {
            *sum += quadrature::sphere(nodes, half, |direction| {
                basis.evaluate(direction, &mut values);
                values[i] * f(direction)
            });
        }
    }
    sums
}

/// The value of an expansion.
fn value(basis: &Basis<f64>, coefficients: &[f64], direction: [f64; 3]) -> f64 {
    let mut values = vec![0.0; coefficients.len()];
    basis.evaluate(direction, &mut values);
    dot(&values, coefficients)
}

#[test]
fn the_product_is_the_projection_of_the_product() {
    for bands in 1..=6 {
        let basis = Basis::<f64>::new(bands);
        let [f, g, h] = [1, 2, 3].map(|seed| coefficients(count(bands), seed));
        let truth = project(bands, 2 * bands, |w| value(&basis, &f, w) * value(&basis, &g, w));
        let table = Product::<f64>::new(bands);
        let mut product = vec![0.0; count(bands)];
        table.apply(&f, &g, &mut product);
        assert!(difference(&product, &truth) < 1e-12, "{bands} bands");
        let double = product::double(&f, &g);
        assert!((product::diffuse_from_specular(&product) - double).abs() < 1e-12);
        let triple = table.triple(&f, &g, &h, &mut product);
        assert!((triple - dot(&truth, &h)).abs() < 1e-12);
    }
}

/// The counts that the documentation tells.
#[test]
fn tables_hold_as_many_integrals() {
    assert_eq!(Product::<f64>::new(3).integrals(), 52);
    assert_eq!(Product::<f64>::new(9).integrals(), 12_057);
    // No scale of the cosine is zero in 3 bands.
    assert_eq!(Folded::<f64>::new(3, 3).integrals(), 83);
}

#[test]
fn one_is_the_unit_of_the_product() {
    let bands = 9;
    let f = coefficients(count(bands), 4);
    let mut one = vec![0.0; count(bands)];
    one[0] = 2.0 * std::f64::consts::PI.sqrt();
    let mut product = vec![0.0; count(bands)];
    Product::new(bands).apply(&one, &f, &mut product);
    assert!(difference(&product, &f) < 1e-12);
}

#[test]
fn the_product_is_commutative_and_where_nothing_is_cut_associative() {
    // Three functions of degree 2 make one of degree 6.
    let bands = 7;
    let table = Product::<f64>::new(bands);
    let [f, g, h] = [1, 2, 3].map(|seed| {
        let mut function = coefficients(count(bands), seed);
        function[count(3)..].fill(0.0);
        function
    });
    let product = |f: &[f64], g: &[f64]| {
        let mut product = vec![0.0; count(bands)];
        table.apply(f, g, &mut product);
        product
    };
    assert!(difference(&product(&f, &g), &product(&g, &f)) < 1e-15);
    assert!(difference(&product(&product(&f, &g), &h), &product(&f, &product(&g, &h))) < 1e-12);
}

#[test]
fn the_cosine_has_these_scales() {
    let bands = 30;
    let mut scales = vec![0.0; bands];
    clamped_cosine::scales(&mut scales);
    let basis = Basis::<f64>::new(bands);
    let mut values = vec![0.0; count(bands)];
    for (l, &scale) in scales.iter().enumerate() {
        let zonal = quadrature::sphere(bands, [0.0, 1.0], |w| {
            basis.evaluate(w, &mut values);
            w[2] * values[l * (l + 1)]
        });
        let truth = zonal * (4.0 * std::f64::consts::PI / (2 * l + 1) as f64).sqrt();
        assert!((scale - truth).abs() < 1e-12, "l = {l}: {scale} {truth}");
    }
}

#[test]
fn the_local_product_holds_the_cosine_itself() {
    for bands in [1, 2, 3, 5, 8] {
        let basis = Basis::<f64>::new(bands);
        let light = coefficients(count(bands), 5);
        let truth = project(bands, 2 * bands, |w| w[2].max(0.0) * value(&basis, &light, w));
        let local = Local::<f64>::new(bands);
        let mut product = vec![0.0; count(bands)];
        local.apply(&light, &mut product);
        assert!(difference(&product, &truth) < 1e-12, "{bands} bands");
        // Fewer multiplications than the blocks of equal m hold.
        let blocks: usize =
            (0..bands).map(|m| (bands - m).pow(2) * if m > 0 { 2 } else { 1 }).sum();
        assert!(local.non_zeros() <= blocks, "{} of {blocks}", local.non_zeros());
        if bands == 5 {
            // Of 85 in the blocks.
            assert_eq!((local.non_zeros(), blocks), (77, 85));
        }
    }
}

#[test]
fn irradiance_is_the_convolution_with_the_cosine() {
    let bands = 7;
    let basis = Basis::<f64>::new(bands);
    let mut light = coefficients(count(bands), 6);
    let normal = [0.48, -0.6, 0.64];
    let mut cosine = vec![0.0; bands];
    clamped_cosine::scales(&mut cosine);
    let mut about_normal = vec![0.0; count(bands)];
    zonal::rotate(&basis, &cosine, normal, &mut about_normal);
    let truth = product::double(&light, &about_normal);
    convolution::convolve(&cosine, &mut light);
    assert!((value(&basis, &light, normal) - truth).abs() < 1e-12);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    /// Table 4.1: the variants that expand the cosine agree with each other; the two that hold the
    /// cosine itself agree with each other.
    #[test]
    fn variants_with_the_same_cosine_agree(q in common::rotation(), bands in 3..7_usize) {
        let basis = Basis::<f64>::new(bands);
        let light = coefficients(count(bands), 8);
        let normal = q.map(|row| row[2]);
        let mut product = vec![0.0; count(bands)];
        for cosine_bands in [3, bands] {
            let mut cosine = vec![0.0; bands];
            clamped_cosine::scales(&mut cosine[..cosine_bands]);
            let mut about_normal = vec![0.0; count(bands)];
            zonal::rotate(&basis, &cosine, normal, &mut about_normal);
            Product::<f64>::new(bands).apply(&light, &about_normal, &mut product);
            let truth = product.clone();
            let mut values = vec![0.0; count(bands)];
            basis.evaluate(normal, &mut values);
            let folded = Folded::new(bands, cosine_bands);
            folded.apply(&light, &values[..count(cosine_bands)], &mut product);
            prop_assert!(difference(&product, &truth) < 1e-12);
        }
        let to_local = [0, 1, 2].map(|row| [0, 1, 2].map(|column| q[column][row]));
        let mut turned = light.clone();
        let local = Local::new(bands);
        local.apply_turned(&Zxzxz::new(bands), to_local, &mut turned, &mut product);
        let truth = project(bands, 2 * bands, |w| {
            let cosine = w[2].max(0.0);
            cosine * value(&basis, &light, turn(&q, w))
        });
        prop_assert!(difference(&product, &truth) < 1e-12);
    }
}
