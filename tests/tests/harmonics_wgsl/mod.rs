//! The WGSL that harmonics generates, on the adapter at hand, against f64.

mod adapter;
mod products;

use adapter::{
    cap_truth, direction, gradients_error, inputs, run, scales_error, values, values_error,
};
use manylights_harmonics::wgsl::Function;
use manylights_harmonics::{Basis, MAX_BANDS, count, even_count, index};

/// The bands of the methods. `examples/harmonics_wgsl_stability.rs` goes to 12; software adapters take a
/// minute to compile 20, which the crate's own tests run on the CPU instead.
const BANDS: [usize; 7] = [1, 2, 3, 4, 5, 6, 9];

#[test]
fn values_keep_five_digits() {
    for bands in BANDS {
        let worst = values_error(bands);
        assert!(worst <= 1e-5, "{bands} bands: {worst:e}");
    }
}

#[test]
fn gradients_keep_five_digits() {
    for bands in BANDS {
        let worst = gradients_error(bands);
        assert!(worst <= 1e-5, "{bands} bands: {worst:e}");
    }
}

#[test]
fn cap_scales_keep_six_digits() {
    for bands in [1, 2, 5, 9, 20, MAX_BANDS] {
        let worst = scales_error(bands);
        assert!(worst <= 1e-6, "{bands} bands: {worst:e}");
    }
}

/// The gather of a light: cap, direction and BRDF vector in one sum; the full and the even one.
#[test]
fn a_cap_meets_a_vector() {
    let inputs = inputs();
    for bands in [1, 2, 5, 9] {
        let brdf: Vec<f32> = (0..count(bands)).map(|i| (1.7 * i as f32).sin()).collect();
        let functions = [
            (Function::CapScales, "cap_scales"),
            (Function::ZonalDot, "sh_zonal_dot"),
            (Function::ZonalDotEven, "sh_zonal_dot_even"),
        ];
        let body = format!(
            "var brdf: array<f32, {}>;
             var half: array<f32, {}>;
             for (var i = 0u; i < {}u; i++) {{ brdf[i] = coefficients[i]; }}
             for (var l = 0u; l < {bands}u; l++) {{
                 for (var m = 0u; m <= l; m++) {{ half[l * (l + 1u) / 2u + m] = brdf[l * (l + 1u) + m]; }}
             }}
             let scales = cap_scales(input.w);
             result[0] = sh_zonal_dot(input.xyz, scales, brdf);
             result[1] = sh_zonal_dot_even(input.xyz, scales, half);",
            count(bands),
            even_count(bands),
            count(bands)
        );
        let result = run(bands, &functions, &body, 2, &inputs, &brdf);
        let basis = Basis::new(bands);
        for (&input, sums) in inputs.iter().zip(result.chunks(2)) {
            let scales = cap_truth(bands, f64::from(input[3]));
            let y = values(&basis, direction(input));
            let mut truth = [0.0; 2];
            for l in 0..bands {
                for m in -(l as isize)..=l as isize {
                    let term = scales[l] * y[index(l, m)] * f64::from(brdf[index(l, m)]);
                    truth[0] += term;
                    truth[1] += if m >= 0 { term } else { 0.0 };
                }
            }
            for (sum, truth) in sums.iter().zip(truth) {
                // Σ |Y b| is below 81 at 9 bands, so 1e-5 is one part in 1e7 of the terms' sum.
                let error = (sum - truth).abs() / scales[0];
                assert!(error <= 1e-5, "{bands} bands at {input:?}: {error:e}");
            }
        }
    }
}
