//! The columns of a table.

use serde::Deserialize;

/// A column beside rank and method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Column {
    /// What the method counted.
    Counts,
    /// Median time of the work.
    Time,
    /// First and third quartile of the time.
    Quartiles,
    /// Time of what the frames were baked from; in every table of a scene where something is baked.
    Bake,
    /// Time of each pass by the processor's own clock; in no table that does not ask for it.
    Passes,
    /// Time as a multiple of the baseline's.
    TimeRatio,
    /// RMSE of sRGB values, without the noise of the reference.
    Rmse,
    /// 95 % interval of the RMSE; in every table that has the RMSE, where it is known.
    Interval,
    /// RMSE as a multiple of the baseline's.
    RmseRatio,
    /// Root of the squared bias, of sRGB values, with its interval.
    Bias,
    /// Standard deviation over seeds, of sRGB values, with its interval.
    Deviation,
    /// PSNR of sRGB values.
    Psnr,
    /// SSIM of sRGB values.
    Ssim,
    /// RMSE of radiance, without the noise of the reference.
    RmseLinear,
    /// Mean absolute error of sRGB values; this and the three below in no table that does not ask for them.
    Mae,
    /// Mean FLIP difference.
    Flip,
    /// Relative mean squared error of radiance.
    RelMse,
    /// The same without the largest 0.1 % of its terms.
    RelMseTrimmed,
    /// 99.9th percentile of the relative error of radiance: spikes.
    Spikes,
}

impl Column {
    /// Those of an experiment that names none, in their order.
    pub(crate) const ALL: [Self; 14] = [
        Self::Counts,
        Self::Time,
        Self::Quartiles,
        Self::Bake,
        Self::TimeRatio,
        Self::Rmse,
        Self::Interval,
        Self::RmseRatio,
        Self::Bias,
        Self::Deviation,
        Self::Psnr,
        Self::Ssim,
        Self::RmseLinear,
        Self::Spikes,
    ];

    /// Heading.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::Counts => "counts",
            Self::Time => "time ms",
            Self::Quartiles => "quartiles",
            Self::Bake => "bake ms",
            Self::Passes => "passes ms",
            Self::TimeRatio | Self::RmseRatio => "÷ base",
            Self::Rmse => "RMSE",
            Self::Interval => "95 %",
            Self::Bias => "bias",
            Self::Deviation => "deviation",
            Self::Psnr => "PSNR dB",
            Self::Ssim => "SSIM",
            Self::RmseLinear => "RMSE linear",
            Self::Mae => "MAE",
            Self::Flip => "FLIP",
            Self::RelMse => "relMSE",
            Self::RelMseTrimmed => "relMSE trimmed",
            Self::Spikes => "p99.9 relative",
        }
    }
}
