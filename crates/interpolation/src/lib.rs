//! Coefficients of spherical harmonics at the vertices of a regular grid, interpolated between them (thesis
//! 3.3.4; Wu et al. 2020; Annen et al. 2004).
//!
//! On the adapter they lie in a buffer of `vec4f`, in the world's frame, all n² of each vertex:
//! - with gradients at ((vertex n² + i) 3 + channel), the value and its three derivatives by a cell, ∂x h_x, ∂y
//!   h_y, ∂z h_z;
//! - without at vertex n² + i, red, green, blue and 0.
//!
//! [`pack`] makes a third of the bytes of them.
//!
//! # Deviations from the papers
//! - The thesis does not say what shape its boxes have. Here a box that is no cube has no more vertices than a
//!   cube, spread so that cells are near to cubes ([`Grid::of_cubes`]).
//! - Lights within two cells of the grid ([`Reach`]), which no scheme follows, are none of its, or smoothed
//!   ([`Near`]).
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]
#![forbid(unsafe_code)]

mod corner_wgsl;
mod extent;
mod grid;
mod light_grid;
mod near;
pub mod oracle;
mod packed_layout;
mod packing;
mod parameters;
mod projection;
mod reading;
mod reading_wgsl;
mod scheme;
mod settings;
mod shader;
mod sorted;
mod sorted_wgsl;
mod view;

pub use grid::{Grid, Place};
pub use light_grid::{Held, LightGrid, Lit};
pub use near::Reach;
pub use packing::pack;
pub use parameters::{Bounds, Interpolation, Near};
pub use projection::{
    GridCoefficients, Loops, ProjectionSettings, ProjectionShader, Projector, SourceShader, project,
};
pub use reading::Reading;
pub use scheme::{CORNERS, Scheme, Weights};
pub use settings::{Order, Settings, Storage};
pub use shader::Shader;
pub use view::Pixels;
