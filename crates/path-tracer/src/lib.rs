//! The CPU path tracer that makes the references.
//!
//! Radiance through pixel centres, for the transports of
//! [`Transport`](manylights_scene::Transport): direct light of point-like lights is summed exactly;
//! emissive triangles and all bounces are sampled.
#![warn(clippy::print_stderr, clippy::print_stdout)]

mod cache;
mod error;
mod method;
mod picture;
mod reference;
mod settings;
mod sums;

pub use cache::REFERENCE_VERSION;
pub use error::Error;
pub use manylights_paths::SLICE;
pub use method::PathTracer;
pub use reference::{Reference, render};
pub use settings::Settings;
