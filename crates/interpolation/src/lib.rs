//! Coefficients of spherical harmonics at the vertices of a regular grid, interpolated between them (thesis
//! 3.3.4; Wu et al. 2020; Annen et al. 2004).
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]
#![forbid(unsafe_code)]

mod grid;
pub mod oracle;
mod reading;
mod reading_wgsl;
mod scheme;
mod settings;
mod shader;
mod sorted;
mod sorted_wgsl;
mod view;

pub use grid::{Grid, Place};
pub use reading::Reading;
pub use scheme::{CORNERS, Scheme, Weights};
pub use settings::{Order, Settings};
pub use shader::Shader;
pub use view::Pixels;
