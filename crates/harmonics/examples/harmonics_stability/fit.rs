//! Least squares as the number of samples M comes near the number of coefficients N.

use manylights_harmonics::projection::{Filter, LeastSquares, fibonacci};
use manylights_harmonics::{Basis, count};

use crate::{Table, Worst};

pub(crate) fn conditions() -> Table {
    let about = "Fit of an expansion of unit coefficients to its own samples at spherical Fibonacci \
                 points, in f32: worst error of a coefficient, unfiltered and with singular values \
                 below 0.1 of the largest cut off (which, near M = N, leaves out what the samples \
                 hardly see). Condition as in thesis figure 5.18.";
    let columns = ["bands, M/N", "M", "condition", "truncated at 0.1", "plain"];
    let mut table = Table::new("Least squares", about, &columns, 1e-3);
    for bands in [5, 10, 15] {
        for share in [4.0, 2.0, 1.5, 1.2, 1.1, 1.05, 1.0] {
            let samples = (share * count(bands) as f64).ceil() as usize;
            let nodes: Vec<_> = fibonacci(samples, [-1.0, 1.0]).map(|(d, _)| d).collect();
            let basis = Basis::<f32>::new(bands);
            let fit = LeastSquares::new(&basis, &nodes);
            let mut y = vec![0.0; count(bands)];
            let given: Vec<_> =
                (0..count(bands)).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
            let seen: Vec<f32> = nodes
                .iter()
                .map(|&node| {
                    basis.evaluate(node, &mut y);
                    y.iter().zip(&given).map(|(&y, &c): (&f32, &f64)| y * c as f32).sum()
                })
                .collect();
            let mut error = |filter| {
                fit.fit(&seen, filter, &mut y);
                let mut worst = Worst::default();
                worst.add_all(&y, &given);
                Some(worst)
            };
            let errors = [error(Filter::Truncated(0.1)), error(Filter::Truncated(0.0))];
            let case = format!("{bands}, {share} | {samples} | {:.1}", fit.condition());
            table.row(&case, &errors);
        }
    }
    table
}
