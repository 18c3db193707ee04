//! Coefficients of spherical harmonics at the vertices of a regular grid, interpolated between them (thesis
//! 3.3.4; Wu et al. 2020; Annen et al. 2004).
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]
#![forbid(unsafe_code)]

mod bindings;
mod grid;
pub mod oracle;
mod reading;
mod reading_wgsl;
mod scheme;

pub use grid::{Grid, Place};
pub use reading::{Pixels, Reading, Settings, plain_shader};
pub use scheme::{CORNERS, Scheme, Weights};
