//! What comes out: rows, statistics, curves, what moved.

pub(crate) mod across;
pub(crate) mod bias;
#[cfg(test)]
mod coverage_test;
pub(crate) mod error_column;
pub(crate) mod error_scale;
pub(crate) mod ranks;
pub(crate) mod regression;
pub(crate) mod rows;
pub(crate) mod series;
pub(crate) mod significance;
pub(crate) mod statistics;
