//! What the errors are, for people and programs.

use crate::Errors;

/// A metric as tables and lists show it.
#[derive(Clone, Copy, Debug)]
pub struct MetricInfo {
    /// Its name in files and on the command line, that of the field of [`Errors`].
    pub id: &'static str,
    /// Its name in headings.
    pub title: &'static str,
    /// What it computes, with x the image and r the reference.
    pub formula: &'static str,
    /// Whether a smaller value is a better picture.
    pub smaller_is_better: bool,
    /// Whether it is of what a display shows alone, and never known of radiance.
    pub display_alone: bool,
    /// Its value, where it is known.
    pub value: fn(&Errors) -> Option<f64>,
}

/// Every metric, in the order of the tables.
pub const METRICS: &[MetricInfo] = &[
    MetricInfo {
        id: "rmse",
        title: "RMSE",
        formula: "sqrt(mean((x - r)^2))",
        smaller_is_better: true,
        display_alone: false,
        value: |errors| Some(errors.rmse),
    },
    MetricInfo {
        id: "mse",
        title: "MSE",
        formula: "mean((x - r)^2)",
        smaller_is_better: true,
        display_alone: false,
        value: |errors| Some(errors.mse),
    },
    MetricInfo {
        id: "mae",
        title: "MAE",
        formula: "mean(|x - r|)",
        smaller_is_better: true,
        display_alone: false,
        value: |errors| Some(errors.mae),
    },
    MetricInfo {
        id: "psnr",
        title: "PSNR",
        formula: "10 log10(range^2 / mse) dB; range = largest component of r (linear), 1 (display)",
        smaller_is_better: false,
        display_alone: false,
        value: |errors| Some(errors.psnr),
    },
    MetricInfo {
        id: "ssim",
        title: "SSIM",
        formula: "Wang et al. 2004, Gaussian 11x11, sigma = 1.5, K1 = 0.01, K2 = 0.03, per component, \
                  mean of the valid region",
        smaller_is_better: false,
        display_alone: false,
        value: |errors| Some(errors.ssim),
    },
    MetricInfo {
        id: "rel_mse",
        title: "relMSE",
        formula: "mean((x - r)^2 / (r^2 + 0.01))",
        smaller_is_better: true,
        display_alone: false,
        value: |errors| Some(errors.rel_mse),
    },
    MetricInfo {
        id: "smape",
        title: "SMAPE",
        formula: "mean(|x - r| / (|x| + |r|)), 0/0 = 0",
        smaller_is_better: true,
        display_alone: false,
        value: |errors| Some(errors.smape),
    },
    MetricInfo {
        id: "rel_p999",
        title: "p99.9 relative",
        formula: "99.9th percentile, nearest rank, of |x - r| / sqrt(r^2 + 0.01)",
        smaller_is_better: true,
        display_alone: false,
        value: |errors| Some(errors.rel_p999),
    },
    MetricInfo {
        id: "rel_mse_trimmed",
        title: "relMSE trimmed",
        formula: "rel_mse without the largest 0.1 % of its terms",
        smaller_is_better: true,
        display_alone: false,
        value: |errors| errors.rel_mse_trimmed,
    },
    MetricInfo {
        id: "flip",
        title: "FLIP",
        formula: "mean FLIP difference (Andersson et al. 2020) at 67 pixels a degree",
        smaller_is_better: true,
        display_alone: true,
        value: |errors| errors.flip,
    },
];
