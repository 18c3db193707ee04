//! Coefficients of spherical harmonics at the vertices of a regular grid, interpolated between them (thesis
//! 3.3.4; Wu et al. 2020; Annen et al. 2004).
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]
#![forbid(unsafe_code)]

mod grid;
mod scheme;

pub use grid::{Grid, Place};
pub use scheme::{CORNERS, Scheme, Weights};
