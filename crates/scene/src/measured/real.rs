//! Either precision.

use num_traits::{Float, FloatConst};

/// f32 and f64.
pub(crate) trait Real: Float + FloatConst + From<f32> {
    /// A number that the tables hold.
    fn from_f32(value: f32) -> Self {
        value.into()
    }

    /// A whole number below 2²⁴.
    fn count(value: usize) -> Self {
        (value as f32).into()
    }

    /// 1/2.
    fn half() -> Self {
        0.5.into()
    }
}

impl Real for f32 {}
impl Real for f64 {}
