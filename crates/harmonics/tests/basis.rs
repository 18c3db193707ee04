//! The basis is orthonormal.

use manylights_harmonics::{Basis, count, quadrature};

#[test]
fn orthonormal() {
    let bands = 12;
    let basis = Basis::<f64>::new(bands);
    let mut values = vec![0.0; count(bands)];
    for i in [0, 1, 2, 3, 7, 40, 100, 143] {
        for j in 0..count(bands) {
            let product = quadrature::sphere(bands, [-1.0, 1.0], |direction| {
                basis.evaluate(direction, &mut values);
                values[i] * values[j]
            });
            let expected = if i == j { 1.0 } else { 0.0 };
            assert!((product - expected).abs() < 1e-12, "<{i}, {j}> = {product}");
        }
    }
}
