//! Rotations turn functions, keep their norms, and agree with each other.

use crate::common;
use crate::common::{coefficients, difference, dot, largest, rotation, turn};
use manylights_harmonics::rotation::{Blocks, Matrix, Zxzxz, rotate_z};
use manylights_harmonics::{Basis, MAX_BANDS, Real, count};
use proptest::prelude::*;

/// The exact turned function by both ways, in `R` but from f64 input.
fn turned<R: Real>(bands: usize, matrix: &Matrix<f64>, input: &[f64]) -> [Vec<f64>; 2] {
    let matrix = matrix.map(|row| row.map(R::of));
    let input: Vec<R> = input.iter().map(|&value| R::of(value)).collect();
    let mut blocks = Blocks::new(bands);
    blocks.set(matrix);
    let mut by_blocks = vec![R::zero(); count(bands)];
    blocks.apply(&input, &mut by_blocks);
    let mut by_turns = input.clone();
    Zxzxz::new(bands).apply(matrix, &mut by_turns, &mut vec![R::zero(); count(bands)]);
    [by_blocks, by_turns].map(|values| values.into_iter().map(Real::to_f64).collect())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn basis_functions_turn_with_their_direction(
        q in rotation(),
        w in common::direction(),
        bands in 1..=MAX_BANDS,
    ) {
        let basis = Basis::<f64>::new(bands);
        let [mut here, mut there] = [vec![0.0; count(bands)], vec![0.0; count(bands)]];
        basis.evaluate(w, &mut here);
        basis.evaluate(turn(&q, w), &mut there);
        for way in turned::<f64>(bands, &q, &here) {
            prop_assert!(difference(&way, &there) < 1e-12, "{}", difference(&way, &there));
        }
    }

    #[test]
    fn norms_of_bands_and_products_stay(q in rotation()) {
        let bands = MAX_BANDS;
        let [f, g] = [1, 2].map(|seed| coefficients(count(bands), seed));
        let [turned_f, turned_g] = [&f, &g].map(|c| turned::<f64>(bands, &q, c));
        for (way_f, way_g) in turned_f.iter().zip(&turned_g) {
            for l in 0..bands {
                let band = l * l..(l + 1) * (l + 1);
                let [before, after] = [[&f, &g], [way_f, way_g]].map(|[f, g]| {
                    dot(&f[band.clone()], &g[band.clone()])
                });
                prop_assert!((before - after).abs() < 1e-12, "band {l}: {before} {after}");
            }
        }
    }

    /// 30 bands in f32. The rounded matrix alone turns by some 1e-7 too much or too little, which
    /// band 29 feels 29 times; the rest is the recurrence and the running powers of the turns.
    #[test]
    fn single_precision_holds(q in rotation()) {
        let input = coefficients(count(MAX_BANDS), 3);
        let exact = turned::<f64>(MAX_BANDS, &q, &input);
        let errors: Vec<f64> = turned::<f32>(MAX_BANDS, &q, &input)
            .iter()
            .zip(&exact)
            .map(|(way, exact)| difference(way, exact) / largest(exact))
            .collect();
        prop_assert!(errors.iter().all(|&error| error < 2e-5), "{errors:?}");
    }
}

#[test]
fn quarter_and_half_turns_and_the_identity_are_exact() {
    let bands = MAX_BANDS;
    let input = coefficients(count(bands), 5);
    let [o, i] = [0.0, 1.0];
    for q in [
        [[i, o, o], [o, i, o], [o, o, i]],
        [[i, o, o], [o, -i, o], [o, o, -i]],
        [[-i, o, o], [o, i, o], [o, o, -i]],
        [[o, o, i], [i, o, o], [o, i, o]],
        [[o, -i, o], [i, o, o], [o, o, i]],
        common::about([0.6, 0.0, 0.8], 1e-7),
        common::about([0.6, 0.8, 0.0], 1e-9),
        // Squares of these underflow in f32, of the last in f64.
        common::about([0.8, -0.6, 0.0], 1e-20),
        common::about([0.8, -0.6, 0.0], 1e-21),
        common::about([0.8, -0.6, 0.0], 1e-22),
        common::about([0.8, -0.6, 0.0], 1e-161),
    ] {
        let [blocks, turns] = turned::<f64>(bands, &q, &input);
        assert!(difference(&blocks, &turns) < 1e-12, "{q:?}: {}", difference(&blocks, &turns));
        let single = turned::<f32>(bands, &q, &input);
        for way in &single {
            assert!(difference(way, &blocks) < 1e-5, "{q:?}: {}", difference(way, &blocks));
        }
    }
}

#[test]
fn turns_about_z_agree_with_the_general_rotation() {
    let bands = MAX_BANDS;
    for angle in [0.3_f64, -2.0, 3.1] {
        let mut about_z = coefficients(count(bands), 7);
        let q = common::about([0.0, 0.0, 1.0], angle);
        let [blocks, _] = turned::<f64>(bands, &q, &about_z);
        rotate_z(bands, [angle.sin(), angle.cos()], &mut about_z);
        assert!(difference(&blocks, &about_z) < 1e-12);
    }
}
