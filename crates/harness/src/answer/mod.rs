//! What comes out: rows, statistics, curves, what moved.

pub(crate) mod bias;
pub(crate) mod error_scale;
pub(crate) mod regression;
pub(crate) mod rows;
pub(crate) mod series;
pub(crate) mod statistics;
